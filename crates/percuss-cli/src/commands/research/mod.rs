//! Commands of the project's research: benchmark and reproduction.

mod benchmark;
mod reproduce;

pub use benchmark::Benchmark;
pub use reproduce::Reproduce;
