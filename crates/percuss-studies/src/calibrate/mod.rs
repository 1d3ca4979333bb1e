//! Calibration: parameters of cases fitted to what was measured, by least squares and by sampling the posterior.
//!
//! Measured data are the `[[experiments]]` and `[[measured_curves]]` of case files and published tests; a parameter is any number of the
//! cases by its dotted key, constants of library materials included. What is calibrated on a source is no blind test of it: the record that
//! comes out says so, and validation heeds it.
//!
//! ```
//! use std::ops::ControlFlow;
//! use percuss::{calibrate::{self, Fitted, Noise, Observations, Problem, Settings}, material::Library, model::model, experiments};
//!
//! let fitted = Fitted::read("materials.ofhc-copper-johnson-cook.strength.johnson_cook.a=20..300 MPa")?;
//! let mut observations = Observations::default();
//! observations.add_tests(experiments::built_in(), Library::built_in(), &fitted)?;
//! let problem = Problem::new(model("wilkins_guinan")?, fitted, observations, Noise::Estimated)?;
//! let settings = Settings { sampling: None, seed: 0 };
//! let found = calibrate::run(&problem, &settings, &|_, _, _| ControlFlow::Continue(()))?;
//! println!("A = {} MPa, RMS error {:.1} %", found.parameters[0].best, 100.0 * found.training.map_or(f64::NAN, |all| all.rms));
//! # assert!((50.0..250.0).contains(&found.parameters[0].best));
//! # Ok::<(), percuss::Error>(())
//! ```

mod axisymmetric;
mod calibrated;
mod correction;
mod cost;
mod curve;
mod curve_prediction;
#[cfg(test)]
mod curve_tests;
mod diagnostics;
mod fit;
mod identifiability;
mod least_squares;
mod noise;
mod observation;
mod parameter;
mod posterior;
mod predictive;
mod problem;
#[cfg(test)]
mod problem_tests;
mod record;
mod sampler;
mod stage;
#[cfg(test)]
mod tests;

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicUsize, Ordering},
};

use serde::Serialize;

pub use axisymmetric::CorrectionRecord;
pub use calibrated::Calibrated;
pub use curve::{CurveObservation, CurveSet};
pub use curve_prediction::{CurveError, CurvePoints, CurvePrediction};
pub use diagnostics::{bulk_effective_size, r_hat, tail_effective_size};
pub use identifiability::{Unidentified, Weakness};
pub use noise::Noise;
pub use observation::{LeftOut, Observation, Observations};
pub use parameter::Fitted;
pub use posterior::Marginal;
pub use predictive::{Prediction, Quality};
pub use problem::Problem;
pub use record::{CalibratedRecord, records};
pub use sampler::{Sample, Sampling};
pub use stage::{Stage, Stages};

use crate::{Error, inputs::column_name, scenario::each_once};

/// How a problem is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// How the posterior is sampled; least squares only when not given.
    pub sampling: Option<Sampling>,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Hears the stage, the part of it that is done (0 to 1) and the runs so far, from several threads; [`ControlFlow::Break`] ends the
/// calibration.
pub type Observer<'a> = &'a (dyn Fn(Stage, f64, u64) -> ControlFlow<()> + Sync);

/// A fitted parameter. Values are in its unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParameterRecord {
    /// Dotted key.
    pub key: String,
    /// Unit; empty for a plain number.
    pub unit: String,
    /// 2.5 %, 50 % and 97.5 % of the prior.
    pub prior: [f64; 3],
    /// The best value: least squares, a normal or lognormal prior counting as a measurement.
    pub best: f64,
    /// Its standard error by the derivatives; null where the data do not determine it.
    pub standard_error: Option<f64>,
    /// What the sample says of it.
    pub posterior: Option<Marginal>,
}

impl ParameterRecord {
    /// Name of its column in tables, which ends with the unit.
    pub fn column(&self) -> String {
        column_name(&self.key, &self.unit)
    }
}

/// The relative scatter of measured values about the model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScatterRecord {
    /// Whether it was estimated.
    pub estimated: bool,
    /// Its value with the best parameters.
    pub best: f64,
    /// What the sample says of it.
    pub posterior: Option<Marginal>,
}

/// How the posterior was sampled.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SamplingRecord {
    /// Ensembles, walkers and steps.
    #[serde(flatten)]
    pub sampling: Sampling,
    /// Part of the proposed moves that were made.
    pub acceptance: f64,
}

/// The result of a calibration. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Calibration {
    /// Version of the program.
    pub percuss_version: &'static str,
    /// The model.
    pub model: &'static str,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Runs of the model.
    pub runs: u64,
    /// How the model was corrected to axisymmetric answers; null where it was not.
    pub correction: Option<CorrectionRecord>,
    /// What was fitted.
    pub parameters: Vec<ParameterRecord>,
    /// Scatter of the measured values.
    pub scatter: ScatterRecord,
    /// Correlations of the parameters, in their order: of the sample, or by the derivatives.
    pub correlations: Vec<Vec<f64>>,
    /// Parameters that the data do not determine.
    pub findings: Vec<Unidentified>,
    /// How the values that were fitted to are met; null where all data are curves.
    pub training: Option<Quality>,
    /// How those that were kept out are met.
    pub hold_out: Option<Quality>,
    /// How the posterior was sampled.
    pub sampling: Option<SamplingRecord>,
    /// Limitations of the numbers.
    pub warnings: Vec<String>,
    /// What the calibrated model says of each value.
    pub predictions: Vec<Prediction>,
    /// What it says of each curve.
    pub curves: Vec<CurvePrediction>,
    /// Values and curves that were not used.
    pub left_out: Vec<LeftOut>,
    /// The sample.
    #[serde(skip)]
    pub sample: Option<Sample>,
}

/// Solves a problem.
///
/// # Errors
/// [`Error::Cancelled`] when the caller ends it, [`Error::Calibration`] when no values are found that the model works with.
pub fn run(
    problem: &Problem,
    settings: &Settings,
    observer: Observer<'_>,
) -> Result<Calibration, Error> {
    crate::cost::within_memory(problem.memory(None), || solve(problem, settings, observer))
}

/// The same on these threads.
fn solve(
    problem: &Problem,
    settings: &Settings,
    observer: Observer<'_>,
) -> Result<Calibration, Error> {
    let fit = fit::least_squares(problem, settings.seed, observer)?;
    let keys: Vec<&str> = problem.fitted.iter().map(Fitted::key).collect();
    let mut findings = identifiability::of_rank(&keys, &fit.slopes);
    let sample = match settings.sampling {
        Some(sampling) => Some(posterior::sample(
            problem,
            &fit,
            sampling,
            settings.seed,
            observer,
        )?),
        None => None,
    };
    let (widths, correlations) = match &sample {
        Some(sample) => posterior::shape(problem, sample),
        None => fit.shape(),
    };
    let more = identifiability::of_posterior(&keys, &widths, &correlations, &findings);
    findings.extend(more);
    for ((parameter, value), bounds) in problem.fitted.iter().zip(&fit.values).zip(problem.bounds())
    {
        let near = 1e-3 * bounds.width();
        if value - bounds.low < near {
            findings.push(identifiability::at_bound(parameter.key(), "lower"));
        } else if bounds.high - value < near {
            findings.push(identifiability::at_bound(parameter.key(), "upper"));
        }
    }
    let report = |part: f64| {
        let runs = problem.runs.load(Ordering::Relaxed);
        heard(problem, observer(Stage::Predicting, part, runs));
    };
    let counter = Counter {
        done: AtomicUsize::new(0),
        total: problem.observations.len() + problem.curves().count(),
        report: &report,
    };
    let draws = predictive::draws(sample.as_ref());
    let predictions = predictive::predictions(problem, &fit.values, &draws, &counter);
    let curves = curve_prediction::curve_predictions(problem, &fit, &draws, &counter);
    if problem.stop.load(Ordering::Relaxed) {
        return Err(cancelled(problem));
    }
    let quality =
        |held_out: bool| Quality::of(predictions.iter().filter(|p| p.held_out == held_out));
    let training = quality(false);
    let is_met = |curve: &CurvePrediction| !curve.held_out && curve.best.is_some();
    if training.is_none() && !curves.iter().any(is_met) {
        return Err(problem::refuse(
            "the model fails on every measured value with the best parameters".to_owned(),
            "give other ranges".to_owned(),
        ));
    }
    let marginal = |i: usize| sample.as_ref().map(|sample| Marginal::of(sample, i));
    let parameters: Vec<ParameterRecord> = problem
        .fitted
        .iter()
        .enumerate()
        .map(|(i, parameter)| ParameterRecord {
            key: parameter.key().to_owned(),
            unit: parameter.unit().to_owned(),
            prior: predictive::PROBABILITIES.map(|probability| parameter.quantile(probability)),
            best: fit.values[i],
            standard_error: fit.standard_error(i),
            posterior: marginal(i),
        })
        .collect();
    let estimated = problem.noise == Noise::Estimated;
    let scatter = ScatterRecord {
        estimated,
        best: fit.scatter,
        // The last number of a state, where it is one.
        posterior: estimated
            .then(|| marginal(problem.fitted.len()))
            .flatten()
            .map(Marginal::exponential),
    };
    let mut warnings = fit.warnings.clone();
    warnings.extend(problem.correction.and_then(|record| record.warning()));
    warnings.extend(not_blind(problem));
    warnings.extend(problem.curves().filter_map(CurveObservation::warning));
    warnings.extend(posterior::warnings(
        &parameters,
        &scatter,
        settings.sampling.map(|s| s.steps),
    ));
    Ok(Calibration {
        percuss_version: env!("CARGO_PKG_VERSION"),
        model: problem.model.name(),
        seed: settings.seed,
        runs: problem.runs.load(Ordering::Relaxed),
        correction: problem.correction,
        parameters,
        scatter,
        correlations: correlations
            .row_iter()
            .map(|row| row.iter().copied().collect())
            .collect(),
        findings,
        training,
        hold_out: quality(true),
        sampling: sample.as_ref().map(|sample| SamplingRecord {
            sampling: sample.sampling,
            acceptance: sample.acceptance,
        }),
        warnings,
        predictions,
        curves,
        left_out: problem.left_out.clone(),
        sample,
    })
}

/// Says which sources that were kept out test the model no more than those that were fitted to.
fn not_blind(problem: &Problem) -> Option<String> {
    let values = problem.observations.iter().filter(|o| o.held_out);
    let curves = problem.curves().filter(|curve| curve.held_out);
    let fitted_to = values
        .map(|value| &value.sources)
        .chain(curves.map(|curve| &curve.curve.sources))
        .flatten()
        .filter(|source| problem.model.validity().is_fitted_to(source))
        .map(String::as_str);
    let known = each_once(fitted_to);
    (!known.is_empty()).then(|| {
        format!(
            "the model `{}` itself was fitted to {} or chosen on it: keeping that out is no blind test",
            problem.model.name(),
            known.join(", ")
        )
    })
}

/// Passes on what the caller answered to a report.
fn heard(problem: &Problem, answer: ControlFlow<()>) {
    if answer.is_break() {
        problem.stop.store(true, Ordering::Relaxed);
    }
}

fn cancelled(problem: &Problem) -> Error {
    Error::Cancelled {
        step: problem.runs.load(Ordering::Relaxed),
        time_us: 0.0,
    }
}

/// Counts what is done of a number of jobs.
struct Counter<'a> {
    done: AtomicUsize,
    total: usize,
    report: &'a (dyn Fn(f64) + Sync),
}

impl Counter<'_> {
    fn count(&self) {
        let done = 1 + self.done.fetch_add(1, Ordering::Relaxed);
        (self.report)((done as f64 / self.total as f64).min(1.0));
    }
}
