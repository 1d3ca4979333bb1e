//! Failure law: failure at once where the tension reaches a stress.

use percuss::{
    check::Check,
    material::{FailureLaw, FailureState, Material, PreparedFailure},
};

/// Failure at a tension.
#[derive(Debug, Clone, Copy)]
pub struct LargestTension {
    /// Axial stress at failure, tension positive [Pa].
    pub stress: f64,
}

impl FailureLaw for LargestTension {
    fn prepare(&self, _: &Material) -> Option<Box<dyn PreparedFailure>> {
        Some(Box::new(*self))
    }

    fn record_key(&self) -> &'static str {
        "spall_strength"
    }

    fn check(&self, _: &mut Check<'_>) {}

    fn fingerprint(&self) -> Option<String> {
        Some(format!("{self:?}"))
    }
}

impl PreparedFailure for LargestTension {
    fn damage(&self, before: f64, state: &FailureState, _: f64) -> f64 {
        match state.tension >= self.stress {
            true => 1.0,
            false => before,
        }
    }
}
