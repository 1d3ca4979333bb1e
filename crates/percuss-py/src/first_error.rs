//! The first error that a law written in Python raises.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pyo3::PyErr;

/// What the first law that failed raised.
#[derive(Debug, Clone, Default)]
pub struct FirstError(Arc<Mutex<Option<PyErr>>>);

impl FirstError {
    /// Takes note of an error, unless there was one before.
    pub fn set(&self, error: PyErr) {
        self.lock().get_or_insert(error);
    }

    /// Whether there was one.
    pub fn is_set(&self) -> bool {
        self.lock().is_some()
    }

    /// Takes it out.
    pub fn take(&self) -> Option<PyErr> {
        self.lock().take()
    }

    fn lock(&self) -> MutexGuard<'_, Option<PyErr>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
