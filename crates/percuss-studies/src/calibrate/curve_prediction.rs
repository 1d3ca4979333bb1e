//! Predictions of the calibrated model for the measured curves, and their differences from them.

use std::sync::atomic::Ordering;

use rayon::prelude::*;
use serde::Serialize;

use super::{
    Counter, CurveObservation, CurveSet, Problem,
    fit::Fit,
    noise::independent,
    predictive::{PROBABILITIES, mixture_quantile},
};
use crate::{
    measured_curves::compare_curve,
    outcome::RunResult,
    statistics::{quantile, sorted},
};

/// How far a curve of the model is from a measured one, as in `measured_curves` of a run. The names are stable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CurveError {
    /// Root of the mean square of the differences over the common time, in the unit of the curve.
    pub rms_difference: Option<f64>,
    /// That over the root mean square of the measured curve; null where it is 0.
    pub relative_rms_difference: Option<f64>,
    /// Largest difference, in the unit of the curve.
    pub largest_difference: Option<f64>,
}

/// A measured curve and what the calibrated model says of it. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CurvePrediction {
    /// Name of the case, of the curve and of the quantity.
    pub id: String,
    /// Name of the curve.
    pub name: String,
    /// Where it comes from.
    pub sources: Vec<String>,
    /// Whether it was kept out of the fit.
    pub held_out: bool,
    /// Name of the gauge; null for a quantity of the history.
    pub gauge: Option<String>,
    /// Quantity, without its unit.
    pub quantity: &'static str,
    /// Unit of the values.
    pub unit: &'static str,
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Number of its values that are used: those within the time of the run.
    pub values: usize,
    /// Number of independent values that they count as.
    pub effective_values: f64,
    /// Correlation time of the differences [us].
    pub correlation_time_us: f64,
    /// Whether it was estimated.
    pub correlation_estimated: bool,
    /// Stated standard uncertainty, in the unit.
    pub uncertainty: Option<f64>,
    /// Differences of the case as it is written.
    pub before: Option<CurveError>,
    /// Differences with the best values.
    pub best: Option<CurveError>,
    /// Fraction of the values in their 95 % predictive intervals.
    pub inside: Option<f64>,
    /// The curves.
    pub points: CurvePoints,
}

/// A measured curve and those of the model at its times, in the unit of the curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CurvePoints {
    /// Times [us].
    pub time_us: Vec<f64>,
    /// Measured values.
    pub measured: Vec<f64>,
    /// The case as it is written.
    pub before: Option<Vec<f64>>,
    /// With the best values.
    pub best: Option<Vec<f64>>,
    /// 2.5 % and 97.5 % of the model's values, the parameters being uncertain; null without a sample.
    pub model_band: Option<[Vec<f64>; 2]>,
    /// 2.5 % and 97.5 % of measured values, the scatter included; null without a sample.
    pub predictive_band: Option<[Vec<f64>; 2]>,
}

/// A draw from the posterior: the curves of a set, in SI units, and the scatter.
type Draw = (Vec<Vec<f64>>, f64);

/// What the model says of all measured curves, those kept out of the fit included.
pub(super) fn curve_predictions(
    problem: &Problem,
    fit: &Fit,
    draws: &[&[f64]],
    counter: &Counter<'_>,
) -> Vec<CurvePrediction> {
    let mut times = fit.correlation_times.iter();
    let mut predictions = Vec::new();
    for set in &problem.curve_sets {
        let before = problem.curve_run(set, None);
        let best = problem.curve_run(set, Some(&fit.values));
        let drawn: Vec<Draw> = draws
            .par_iter()
            .filter(|_| !problem.stop.load(Ordering::Relaxed))
            .filter_map(|state| {
                let values = &state[..problem.fitted.len()];
                let curves = problem.curves_of(set, values).ok()?;
                Some((curves, problem.scatter_in(state)))
            })
            .collect();
        for (index, curve) in set.curves.iter().enumerate() {
            let time = times.next().copied().unwrap_or(0.0);
            let runs = [&before, &best].map(Option::as_ref);
            predictions.push(prediction(set, curve, runs, time, &|i| {
                let at = drawn.iter().map(|(curves, scatter)| {
                    (curves[index][i], curve.spread().deviation(*scatter))
                });
                at.collect()
            }));
            counter.count();
        }
    }
    predictions
}

fn prediction(
    set: &CurveSet,
    curve: &CurveObservation,
    [before, best]: [Option<&RunResult>; 2],
    correlation_time: f64,
    drawn: &(dyn Fn(usize) -> Vec<(f64, f64)> + Sync),
) -> CurvePrediction {
    let of = &curve.curve;
    let unit = |si: f64| of.unit.of_si(si);
    let values = |run: Option<&RunResult>| -> Option<Vec<f64>> {
        let found = curve.predicted(run?).ok()?;
        Some(found.into_iter().map(unit).collect())
    };
    let error = |run: Option<&RunResult>| -> Option<CurveError> {
        let found = compare_curve(of, run?);
        found.rms_difference?;
        Some(CurveError {
            rms_difference: found.rms_difference,
            relative_rms_difference: found.relative_rms_difference,
            largest_difference: found.largest_difference,
        })
    };
    let bands: Vec<Option<[[f64; 2]; 2]>> = (0..curve.points.len())
        .into_par_iter()
        .map(|i| {
            let drawn = drawn(i);
            if drawn.is_empty() {
                return None;
            }
            let model = sorted(drawn.iter().map(|(value, _)| *value));
            let ends = [PROBABILITIES[0], PROBABILITIES[2]];
            Some([
                ends.map(|probability| unit(quantile(&model, probability))),
                ends.map(|probability| unit(mixture_quantile(&drawn, probability))),
            ])
        })
        .collect();
    let bands: Option<Vec<[[f64; 2]; 2]>> = bands.into_iter().collect();
    let band = |kind: usize| -> Option<[Vec<f64>; 2]> {
        let all = bands.as_ref()?;
        let end = |end: usize| all.iter().map(|bands| bands[kind][end]).collect();
        Some([end(0), end(1)])
    };
    let measured: Vec<f64> = curve.points.iter().map(|point| unit(point.value)).collect();
    let predictive_band = band(1);
    let inside = predictive_band.as_ref().map(|[low, high]| {
        let within = |i: &usize| (low[*i]..=high[*i]).contains(&measured[*i]);
        (0..measured.len()).filter(within).count() as f64 / measured.len() as f64
    });
    CurvePrediction {
        id: curve.id.clone(),
        name: of.name.clone(),
        sources: of.sources.clone(),
        held_out: curve.held_out,
        gauge: of.gauge.clone(),
        quantity: of.quantity,
        unit: of.unit.symbol,
        impact_velocity_m_s: set.impact_velocity,
        values: curve.values(),
        effective_values: independent(&curve.spreads(correlation_time)),
        correlation_time_us: correlation_time * 1e6,
        correlation_estimated: of.correlation_time.is_none(),
        uncertainty: of.uncertainty.map(unit),
        before: error(before),
        best: error(best),
        inside,
        points: CurvePoints {
            time_us: curve.points.iter().map(|point| point.time * 1e6).collect(),
            measured,
            before: values(before),
            best: values(best),
            model_band: band(0),
            predictive_band,
        },
    }
}
