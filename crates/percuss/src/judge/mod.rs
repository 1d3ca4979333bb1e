//! Every depth model against the axisymmetric reference, over a design of experiments.

mod contender;
pub mod design;
mod expectation;
mod judgement;
pub mod reference;

pub use contender::{Contender, contenders};
pub use design::{Shot, shots};
pub use expectation::{Expectation, expectation, quantile, verdicts};
pub use judgement::{Verdict, finest, judge};
pub use reference::Reference;
