//! The program: its command line, and the answers of its commands.

use std::{ffi::OsString, process::ExitCode};

use pyo3::prelude::*;

use crate::{case::Case, watch::watched};

/// Runs a command line, whose first word is the name of the program; returns the exit code.
#[pyfunction]
pub fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
    let code = py.detach(|| percuss_cli::main(words));
    // An exit code tells nothing but whether it equals another one.
    (0..=u8::MAX)
        .find(|byte| ExitCode::from(*byte) == code)
        .unwrap_or(1)
}

/// What a command line prints with --json.
#[pyfunction]
#[pyo3(signature = (words, case=None, progress=None))]
pub fn answer(
    py: Python<'_>,
    words: Vec<OsString>,
    case: Option<&Bound<'_, Case>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let scenario = case.map(|case| case.get().scenario.clone());
    watched(py, progress.as_ref(), |board| {
        let hear = &mut |fraction: f64, words: &str| board.hear(fraction, words);
        percuss_cli::answer(words, scenario.as_deref(), hear)
    })
}
