//! Case files of [percuss](https://docs.rs/percuss), and the numbers of a case that studies vary.
//!
//! Depend on `percuss`, which re-exports what users need.

pub mod case;
pub mod csv_table;
pub mod inputs;
pub mod lsdyna;
pub mod material_tables;

// What the input uses of the layers below.
use percuss_core::{
    Refusal, bisection, check, document, error, history, input_file, material, options, problem,
    scenario, units,
};
use percuss_models::chain;
