//! Studies of [percuss](https://docs.rs/percuss): many runs of a case, and runs against measurements.
//!
//! Depend on `percuss`, which re-exports what users need.

pub mod axisymmetric;
pub mod calibrate;
pub mod compare;
pub mod converge;
pub mod cost;
pub mod experiments;
mod jobs;
pub mod limit;
mod limit_choice;
mod limit_error;
#[cfg(test)]
mod made_up;
pub mod measured_curves;
pub mod mesh_choice;
pub mod model_error;
pub mod summary;
pub mod sweep;
pub mod uncertainty;
pub mod v50;
pub mod validate;

// What the studies use of the layers below.
#[cfg(test)]
use percuss_core::NumericalError;
use percuss_core::{
    Error, Refusal, Scenario, bisection, check, document, error, fragments, history, lanes,
    material, minimum, options, outcome, problem, regime, richardson, scenario, solver, statistics,
    units, validity,
};
use percuss_input::{case, csv_table, inputs};
use percuss_models::{analytic, axi, chain, model};
