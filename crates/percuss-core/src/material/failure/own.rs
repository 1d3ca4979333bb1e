//! A failure law that a program brings along.

use std::{fmt, ptr, sync::Arc};

use super::FailureLaw;

/// A law of the caller's own. No file can name it, and it equals itself only.
#[derive(Clone)]
pub struct OwnFailure(pub Arc<dyn FailureLaw + Send + Sync>);

impl PartialEq for OwnFailure {
    fn eq(&self, other: &Self) -> bool {
        ptr::addr_eq(Arc::as_ptr(&self.0), Arc::as_ptr(&other.0))
    }
}

impl fmt::Debug for OwnFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a failure law of the caller's own")
    }
}
