//! The native half of the Python package `percuss`: cases, runs and sweeps, and the results of commands as JSON.
//!
//! It knows no option by name: cases, sweeps and command lines pass through it as data.

mod case;
mod command;
mod errors;
mod field;
mod first_error;
mod fork;
mod history;
mod law;
mod monitor;
mod resistance;
mod response;
mod run;
mod sweep;
mod tables;

/// The module that the package's Python files import.
#[pyo3::pymodule]
mod _percuss {
    #[pymodule_export]
    use crate::{
        case::Case,
        command::command,
        field::{Field, element_columns, in_units, result_fields, sample_columns, units},
        history::Column,
        response::{Response, execute},
        run::{RunResult, run},
        sweep::{Sweep, SweepFolder, compute_sweep},
        tables::toml_text,
    };

    #[pymodule_init]
    fn init(_module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        crate::fork::remember_process();
        Ok(())
    }

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    const MOST_THREADS: u16 = percuss_cli::MOST_THREADS;
}
