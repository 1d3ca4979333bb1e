//! Estimate of the model error of a depth of penetration, from stored benchmark results.

mod contender;
pub mod design;
mod expectation;
mod result;
mod verdict;

pub use contender::{Contender, contenders};
pub use expectation::{Expectation, expectation, verdicts};
pub(crate) use result::expected_error;
pub use verdict::Verdict;
