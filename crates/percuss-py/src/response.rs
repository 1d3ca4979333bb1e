//! Results of commands: JSON, and samples as columns of numbers.

use std::{collections::HashMap, ffi::OsString, ops::ControlFlow, path::PathBuf, sync::Arc};

use percuss::{
    calibrate::Calibration,
    case::Document,
    uncertainty::{self, Uncertainty},
};
use percuss_cli::{Response as CommandResponse, ResponseData, VirtualFiles};
use percuss_report::column::word;
use pyo3::prelude::*;

use crate::{
    case::Case, errors::raise, history::Column, law::Laws, monitor::run_monitored, run::RunResult,
};

/// Columns by name.
pub type Numbers = Vec<(String, Vec<f64>)>;

/// Result of a command.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct Response {
    response: CommandResponse,
    numbers: Arc<Numbers>,
}

/// Executes a command line; `cases` and `texts` replace files of these names. Laws of `percuss uncertainty` go with a name.
#[pyfunction]
#[pyo3(signature = (words, cases, texts, progress=None, projectile_law=None, target_law=None, law_name=String::new()))]
#[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn execute(
    py: Python<'_>,
    words: Vec<OsString>,
    cases: HashMap<String, Py<Case>>,
    texts: HashMap<String, String>,
    progress: Option<Py<PyAny>>,
    projectile_law: Option<Py<PyAny>>,
    target_law: Option<Py<PyAny>>,
    law_name: String,
) -> PyResult<Response> {
    let laws = Arc::new(Laws {
        projectile: projectile_law,
        target: target_law,
        ..Laws::default()
    });
    let mut virtual_files = VirtualFiles::default();
    for (name, case) in cases {
        laws.check(py, &case.get().scenario)?;
        virtual_files.put(name, case.get().document.clone());
    }
    for (name, text) in texts {
        let document = Document::new(&name, text);
        virtual_files.put(name, document);
    }
    if !laws.are_none() {
        virtual_files.change = Some(Arc::clone(&laws).as_change(law_name));
    }
    let response = run_monitored(py, progress.as_ref(), |progress_state| {
        let on_progress = &mut |fraction: f64, words: &str| -> ControlFlow<()> {
            laws.flow()?;
            progress_state.on_progress(fraction, words)
        };
        let response =
            percuss_cli::execute(words, &virtual_files, progress_state.stop(), on_progress)?;
        let numbers = match &response.data {
            ResponseData::Json(_) | ResponseData::Run(_) => Numbers::new(),
            ResponseData::Uncertainty(found) => of_draws(found),
            ResponseData::Calibration(found) => of_sample(&found.calibration),
        };
        Ok(Response {
            response,
            numbers: Arc::new(numbers),
        })
    });
    match laws.take_error() {
        Some(error) => Err(error),
        None => response,
    }
}

#[pymethods]
impl Response {
    /// Output of --json.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        self.response.json().map_err(|failure| raise(py, failure))
    }

    /// Files that the command wrote.
    fn files(&self) -> Vec<PathBuf> {
        self.response.files.clone()
    }

    /// Result of a run.
    fn run(&self) -> Option<RunResult> {
        match &self.response.data {
            ResponseData::Run(run_output) => Some(RunResult::of(run_output)),
            _ => None,
        }
    }

    /// Names of the columns of its sample.
    fn names(&self) -> Vec<&str> {
        let names = self.numbers.iter().map(|(name, _)| name.as_str());
        names.collect()
    }

    /// Number of rows of its sample.
    fn rows(&self) -> usize {
        self.numbers.first().map_or(0, |(_, values)| values.len())
    }

    /// A column of its sample.
    fn column(&self, name: &str) -> Option<Column> {
        let (_, values) = self.numbers.iter().find(|(found, _)| found == name)?;
        Some(Column::of_numbers(&self.numbers, values))
    }

    /// Outcome of each run of an uncertainty analysis.
    fn outcomes(&self) -> Vec<String> {
        match &self.response.data {
            ResponseData::Uncertainty(found) => {
                let draws = found.draws.iter();
                draws.map(|draw| word(&draw.outcome)).collect()
            }
            _ => Vec::new(),
        }
    }
}

/// One row per run: inputs and results, NaN where a result is missing.
fn of_draws(found: &Uncertainty) -> Numbers {
    let draws = &found.draws;
    let inputs = found.inputs.iter().enumerate();
    let mut numbers: Numbers = inputs
        .map(|(i, input)| {
            let values = draws.iter().map(|draw| draw.inputs[i]);
            (input.column.clone(), values.collect())
        })
        .collect();
    for quantity in uncertainty::quantities() {
        let values = || draws.iter().map(|draw| draw.value(quantity));
        if values().any(|value| value.is_some()) {
            let column = values().map(|value| value.unwrap_or(f64::NAN)).collect();
            numbers.push((quantity.name.to_owned(), column));
        }
    }
    numbers
}

/// One row per state, ensemble by ensemble, step by step, walker by walker.
fn of_sample(calibration: &Calibration) -> Numbers {
    let Some(sample) = &calibration.sample else {
        return Numbers::new();
    };
    let (steps, walkers) = (sample.sampling.steps, sample.sampling.walkers);
    let count = sample.kept().count();
    let place = |of: &dyn Fn(usize) -> usize| (0..count).map(|i| of(i) as f64).collect();
    let mut numbers: Numbers = vec![
        ("ensemble".to_owned(), place(&|i| i / (steps * walkers))),
        ("step".to_owned(), place(&|i| i / walkers % steps)),
        ("walker".to_owned(), place(&|i| i % walkers)),
    ];
    for (i, parameter) in calibration.parameters.iter().enumerate() {
        numbers.push((parameter.column(), sample.values(i)));
    }
    if calibration.scatter.estimated {
        let logarithms = sample.values(calibration.parameters.len());
        let scatter = logarithms.into_iter().map(f64::exp).collect();
        numbers.push(("scatter".to_owned(), scatter));
    }
    numbers
}
