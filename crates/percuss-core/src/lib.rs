//! Core of [percuss](https://docs.rs/percuss): units, materials, a case in SI units, the time loop and the results of impact models.
//!
//! Depend on `percuss`, which has all of it under stable paths. Public items that `percuss` does not re-export serve its other crates.

pub mod bisection;
pub mod check;
pub mod document;
pub mod error;
pub mod fragments;
pub mod history;
pub mod input_file;
pub mod lanes;
pub mod ledger;
pub mod material;
pub mod minimum;
pub mod options;
pub mod outcome;
pub mod power;
pub mod problem;
pub mod quote;
pub mod random;
mod refusal;
pub mod regime;
pub mod resistance;
pub mod richardson;
pub mod scenario;
pub mod shapes;
pub mod solver;
pub mod statistics;
pub mod units;
pub mod validity;

pub use error::{Error, InputError, NumericalError, Subject};
pub use refusal::Refusal;
pub use scenario::Scenario;
