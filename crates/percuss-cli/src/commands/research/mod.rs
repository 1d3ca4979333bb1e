//! Commands of the project's own research.

mod benchmark;
mod reproduce;

pub use benchmark::Benchmark;
pub use reproduce::Reproduce;
