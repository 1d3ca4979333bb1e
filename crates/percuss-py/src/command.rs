//! Command line of the program.

use std::{ffi::OsString, process::ExitCode};

use pyo3::prelude::*;

use crate::fork::with_threads;

/// Runs a command line, whose first word is the name of the program; returns the exit code.
#[pyfunction]
pub fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
    let code = py.detach(|| with_threads(|| percuss_cli::main(words)));
    // An exit code tells nothing but whether it equals another one.
    (0..=u8::MAX)
        .find(|byte| ExitCode::from(*byte) == code)
        .unwrap_or(1)
}
