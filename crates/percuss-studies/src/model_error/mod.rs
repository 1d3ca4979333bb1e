//! Estimate of the model error of a depth of penetration, from stored benchmark results.

mod candidate;
pub mod design;
mod error_record;
mod estimate;
mod result;

pub use candidate::{Candidate, candidates};
pub use error_record::ErrorRecord;
pub use estimate::{ModelErrorEstimate, estimate_error, records};
pub(crate) use result::expected_error;
