//! Estimate of the model error of a depth of penetration, from stored benchmark results.

mod candidate;
mod conformal;
pub mod design;
mod error_record;
mod estimate;
mod features;
mod result;

pub use candidate::{Candidate, candidates};
pub use conformal::Coverage;
pub use error_record::ErrorRecord;
pub use estimate::{ModelErrorEstimate, coverage, estimate_error, records};
pub use features::ratios;
pub(crate) use result::expected_error;
