//! One run of one model.

use std::{
    ops::ControlFlow,
    sync::Arc,
    time::{Duration, Instant},
};

use percuss::{
    Scenario,
    axisymmetric::{AxisymmetricAnswer, ReferenceMeshes, Request},
    model::{self, Control, Progress},
    outcome::RunResult as Computed,
    summary::CaseResults,
};
use percuss_cli::{Failure, RunOutput, start_threads};
use pyo3::{exceptions::PyValueError, prelude::*};

use crate::{
    case::Case,
    errors::raise,
    fork::with_threads,
    history::Column,
    law::Laws,
    monitor::{PythonMonitor, run_monitored},
};

/// The result of a run.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct RunResult {
    scenario: Arc<Scenario>,
    result: Arc<Computed>,
    axisymmetric: Option<AxisymmetricAnswer>,
    /// `None` where files were written on the way.
    solver_time: Option<Duration>,
}

impl RunResult {
    /// The result of a run that was a command line.
    pub fn of(run_output: &RunOutput) -> Self {
        Self {
            scenario: Arc::clone(&run_output.scenario),
            result: Arc::clone(&run_output.result),
            axisymmetric: run_output.axisymmetric.clone(),
            solver_time: None,
        }
    }
}

/// Computes a case by a model, the default one of the case where none is named.
#[pyfunction]
#[pyo3(signature = (case, model, record, progress=None, projectile_law=None, target_law=None, resistance_law=None, reference=None))]
#[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn run(
    py: Python<'_>,
    case: &Bound<'_, Case>,
    model: Option<&str>,
    record: bool,
    progress: Option<Py<PyAny>>,
    projectile_law: Option<Py<PyAny>>,
    target_law: Option<Py<PyAny>>,
    resistance_law: Option<Py<PyAny>>,
    reference: Option<&str>,
) -> PyResult<RunResult> {
    let laws = Laws {
        projectile: projectile_law,
        target: target_law,
        resistance: resistance_law,
        ..Laws::default()
    };
    percuss_cli::limit_memory().map_err(|failure| raise(py, failure))?;
    let scenario = laws.put_into(py, &case.get().scenario)?;
    let chosen = model::choose(model, &scenario).map_err(|error| raise(py, error))?;
    let mut monitor = PythonMonitor::new(progress.as_ref());
    let mut solver_time = Duration::ZERO;
    let mut compute = || {
        let mut on_progress = |now: Progress| -> ControlFlow<()> {
            laws.flow()?;
            monitor.report(now.fraction, || {
                format!("{:.1} us, depth {:.3} mm", now.time * 1e6, now.depth * 1e3)
            })
        };
        let mut control = Control {
            record: record || !scenario.measured_curves.is_empty(),
            progress: Some(&mut on_progress),
            ..Control::default()
        };
        let start = Instant::now();
        let result = chosen.run(&scenario, &mut control).map_err(Failure::from);
        solver_time = start.elapsed();
        result
    };
    start_threads().map_err(|failure| raise(py, failure))?;
    let result = py.detach(|| with_threads(&mut compute));
    if let Some(error) = laws.take_error() {
        return Err(error);
    }
    let result = Arc::new(monitor.finish(py, result)?);
    let meshes = reference.and_then(ReferenceMeshes::named);
    let answer = meshes.map(|meshes| axisymmetric_answer(py, &scenario, meshes, progress.as_ref()));
    Ok(RunResult {
        scenario,
        result,
        axisymmetric: answer.transpose()?,
        solver_time: Some(solver_time),
    })
}

/// Axisymmetric answer of a case, whatever it costs.
fn axisymmetric_answer(
    py: Python<'_>,
    scenario: &Scenario,
    meshes: ReferenceMeshes,
    progress: Option<&Py<PyAny>>,
) -> PyResult<AxisymmetricAnswer> {
    let request = Request {
        meshes,
        budget: None,
    };
    run_monitored(py, progress, |state| {
        let mut report = |fraction: f64| state.on_progress(fraction, "axisymmetric runs");
        Ok(request.answer(scenario, &mut report)?)
    })
}

#[pymethods]
impl RunResult {
    /// What `percuss run --json` prints.
    fn json(&self) -> PyResult<String> {
        let results = CaseResults::new(&self.scenario, std::slice::from_ref(&self.result))
            .with_axisymmetric(self.axisymmetric.clone());
        serde_json::to_string(&results).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// Time that the solver took [s].
    fn solver_seconds(&self) -> Option<f64> {
        self.solver_time.map(|time| time.as_secs_f64())
    }

    /// Number of recorded moments; `None` without a history.
    fn samples(&self) -> Option<usize> {
        self.result.history.as_ref().map(|h| h.samples.len())
    }

    /// Number of recorded states along the axis.
    fn profiles(&self) -> usize {
        let history = self.result.history.as_ref();
        history.map_or(0, |history| history.profiles.len())
    }

    /// Time of a state along the axis [s].
    fn profile_time(&self, index: usize) -> Option<f64> {
        let history = self.result.history.as_ref()?;
        Some(history.profiles.get(index)?.time)
    }

    /// A column of the history by its name in SI units.
    fn sample_column(&self, si_name: &str) -> Option<Column> {
        Column::of_samples(&self.result, si_name)
    }

    /// Names of the gauges.
    fn gauges(&self) -> Vec<String> {
        let history = self.result.history.iter();
        let gauges = history.flat_map(|history| &history.gauges);
        gauges.map(|gauge| gauge.name.clone()).collect()
    }

    /// Times of the states at a gauge [s].
    fn gauge_times(&self, index: usize) -> Option<Column> {
        let gauge = self.result.history.as_ref()?.gauges.get(index)?;
        Some(Column::of_numbers(&self.result, &gauge.times))
    }

    /// A column of the states at a gauge by its name in SI units.
    fn gauge_column(&self, index: usize, si_name: &str) -> Option<Column> {
        Column::of_gauge(&self.result, index, si_name)
    }

    /// A column of a state along the axis by its name in SI units.
    fn element_column(&self, index: usize, si_name: &str) -> Option<Column> {
        Column::of_elements(&self.result, index, si_name)
    }
}
