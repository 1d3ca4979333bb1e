//! A strength law that a program brings along.

use std::{fmt, ptr, sync::Arc};

use super::StrengthLaw;

/// A law of the caller's own. No file can name it, and it equals itself only.
///
/// ```
/// use std::sync::Arc;
/// use percuss::material::{OwnLaw, PerfectlyPlastic, Strength};
///
/// let law = PerfectlyPlastic { flow_stress: percuss::units::Pressure::new(300e6) };
/// let own = Strength::Own(OwnLaw(Arc::new(law)));
/// assert_eq!(own.law().equation(), "σ = Y");
/// assert_eq!(own, own.clone());
/// ```
#[derive(Clone)]
pub struct OwnLaw(pub Arc<dyn StrengthLaw + Send + Sync>);

impl PartialEq for OwnLaw {
    fn eq(&self, other: &Self) -> bool {
        ptr::addr_eq(Arc::as_ptr(&self.0), Arc::as_ptr(&other.0))
    }
}

impl fmt::Debug for OwnLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:?}", self.0.equation(), self.0.parameters())
    }
}
