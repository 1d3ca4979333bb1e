//! First-order impact and penetration mechanics: what strikes what, how fast, how deep it goes, and how far to trust that.
//!
//! A [`Scenario`] comes from a case file; a [`model::Model`] computes it; a [`outcome::RunResult`] carries the numbers, the
//! energy and momentum balances and the warnings. Everything inside is in SI units, compression positive.
//!
//! ```
//! use percuss::{case, model::{self, Control}};
//!
//! let scenario = case::load_str("example", r#"
//!     projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
//!     target = { material = "aluminium-2024-t351", thickness = "25 mm" }
//! "#)?;
//! let result = model::run(model::model("chain")?, &scenario, &mut Control::default())?;
//! let depth_mm = result.depth_of_penetration.unwrap() * 1e3;
//! assert!(depth_mm > 0.2 && depth_mm < 0.25);
//! assert!(result.numerics().energy_residual < 1e-3 && result.numerics().momentum_residual < 1e-12);
//! # Ok::<(), percuss::Error>(())
//! ```
//!
//! A case is also built without a text: [`case::Case::scenario`]. A model, a strength law, a failure law or a resistance law of your own
//! implements [`model::Model`], [`material::StrengthLaw`], [`material::FailureLaw`] or [`resistance::ResistanceLaw`]; the options of
//! such a model stand in the case under `extensions`. The folder `examples/own-model` of the repository has one of each of the first three.

pub mod analytic;
pub mod axi;
pub mod calibrate;
pub mod case;
pub mod chain;
pub mod check;
pub mod compare;
pub mod converge;
pub mod document;
mod error;
pub mod fdm;
pub mod fragments;
pub mod guard;
pub mod history;
pub mod inputs;
mod lanes;
pub mod ledger;
pub mod limit;
#[cfg(test)]
mod made_up;
pub mod material;
pub mod model;
pub mod model_error;
pub mod options;
pub mod outcome;
pub mod power;
pub mod problem;
mod refusal;
pub mod regime;
pub mod resistance;
pub mod richardson;
pub mod scenario;
pub mod shapes;
pub mod shots;
pub mod solver;
pub mod statistics;
pub mod summary;
pub mod sweep;
pub mod uncertainty;
pub mod units;
pub mod v50;
pub mod validate;

pub use error::{Error, InputError, NumericalError, Subject};
pub use refusal::Refusal;
pub use scenario::Scenario;
pub use solver::{checkpoint, frames};

/// The README's library example, run from the folder that it stands in.
#[cfg(doctest)]
mod readme {
    #![doc = include_str!("../../../README.md")]
}
