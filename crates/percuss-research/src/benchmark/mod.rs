//! Benchmark of every depth model against the axisymmetric model, over a design of experiments.

mod case;
mod compare;
mod estimate;
mod findings;
pub mod reference;
pub mod resume;
mod statistics;

pub use case::{BenchmarkCase, DIAMETER, Design, PAIRS, SPREAD_PAIRS, cases};
pub use compare::{compare, to_csv};
pub use estimate::{
    CheckedReference, Estimate, Refusal, RefusedReference, check_references, depth_of,
};
pub use findings::findings;
pub use reference::Reference;
pub use statistics::{CLOSE, Errors, Group, Grouping, SHARP, is_sharp, pair_name, statistics};
