//! Every depth model against the axisymmetric reference, over a design of experiments.

pub mod ablation;
mod contender;
pub mod design;
mod estimate;
mod expectation;
mod findings;
mod judgement;
pub mod reference;
mod result;
mod resume;
mod statistics;
pub mod study;

pub use contender::{Contender, contenders};
pub use design::{Shot, shots};
pub use estimate::{
    CheckedReference, Estimate, Refusal, RefusedReference, check_references, depth_of,
};
pub use expectation::{Expectation, expectation, quantile, verdicts};
pub use findings::findings;
pub use judgement::{SHARP, Verdict, judge, to_csv};
pub use reference::Reference;
pub(crate) use result::expected_error;
pub use resume::Report;
pub use statistics::{CLOSE, Errors, Group, Grouping, pair_name, statistics};
