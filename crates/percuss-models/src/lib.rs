//! Models of [percuss](https://docs.rs/percuss), and their list.
//!
//! Depend on `percuss`, which re-exports what users need.

pub mod analytic;
pub mod axi;
pub mod chain;
pub mod fdm;
pub mod model;
pub mod particles;
mod solid;

// What the models use of the core.
#[cfg(test)]
use percuss::{case, compare, summary};
use percuss_core::{
    Error, Refusal, Scenario, bisection, check, error, fragments, history, lanes, ledger, material,
    minimum, options, outcome, power, problem, quote, random, regime, resistance, scenario, shapes,
    solver, units, validity,
};
