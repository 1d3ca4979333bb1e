//! percuss
pub mod case;
pub mod chain;
pub mod check;
mod error;
pub mod history;
pub mod ledger;
pub mod material;
pub mod model;
pub mod outcome;
pub mod scenario;
pub mod units;
pub use error::{Error, InputError, NumericalError};
pub use scenario::Scenario;
