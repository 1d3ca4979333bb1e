//! Commands of the project's own research.

mod judge;
mod reproduce;

pub use judge::Judge;
pub use reproduce::Reproduce;
