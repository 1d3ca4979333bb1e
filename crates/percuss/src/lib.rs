//! percuss
pub mod case;
pub mod check;
mod error;
pub mod material;
pub mod scenario;
pub mod units;
pub use error::{Error, InputError, NumericalError};
pub use scenario::Scenario;
