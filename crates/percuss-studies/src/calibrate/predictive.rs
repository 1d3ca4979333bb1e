//! Predictions of the calibrated model for each measured value, and their agreement.

use rayon::prelude::*;
use serde::Serialize;

use super::{Counter, Observation, Problem, sampler::Sample};
use crate::{
    bisection::bisected,
    inputs::normal_probability,
    outcome::BandQuantity,
    statistics::{quantile, sorted},
};

/// Most states of the posterior that are put through the model.
const DRAWS: usize = 400;
/// Chances between which 95 % lie, and the middle.
pub(super) const PROBABILITIES: [f64; 3] = [0.025, 0.5, 0.975];

/// A measured value and what the calibrated model says of it, in the unit of the quantity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Prediction {
    /// Id of the test, or name of the case with the number of its entry.
    pub id: String,
    /// Where it comes from.
    pub sources: Vec<String>,
    /// Whether it was kept out of the fit.
    pub held_out: bool,
    /// What was measured.
    pub quantity: BandQuantity,
    /// Unit of the values.
    pub unit: &'static str,
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// The measured value.
    pub measured: f64,
    /// Its standard deviation, where it is stated.
    pub uncertainty: Option<f64>,
    /// What the model gives for the case as it is written, uncorrected.
    pub before: Option<f64>,
    /// What it gives with the best values, corrected where the calibration is.
    pub best: Option<f64>,
    /// Axisymmetric answer at the values of the last round, and its discretisation uncertainty; null without a correction.
    pub axisymmetric: Option<[f64; 2]>,
    /// `(best − measured)/measured`, relative to the impact velocity for a residual velocity.
    pub relative_error: Option<f64>,
    /// Where the model's value lies with a probability of 95 %, the parameters being uncertain.
    pub model_band: Option<[f64; 2]>,
    /// Where a measured value would lie with a probability of 95 %, the scatter included.
    pub predictive_band: Option<[f64; 2]>,
    /// Median of such a value.
    pub predictive_median: Option<f64>,
}

impl Prediction {
    /// Whether the measured value lies in its predictive band.
    pub fn is_inside(&self) -> Option<bool> {
        let [low, high] = self.predictive_band?;
        Some((low..=high).contains(&self.measured))
    }
}

/// How well a set of measured values is met.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Quality {
    /// Number of values.
    pub count: usize,
    /// Root mean square of the relative errors before, with the cases as they are written.
    pub rms_before: Option<f64>,
    /// Root mean square of the relative errors of the best values.
    pub rms: f64,
    /// Mean of those errors.
    pub bias: f64,
    /// Values in their 95 % predictive bands.
    pub inside: Option<usize>,
}

impl Quality {
    /// Quality of the predictions of one kind; nothing if there are none.
    pub(super) fn of<'a>(predictions: impl Iterator<Item = &'a Prediction>) -> Option<Self> {
        let all: Vec<&Prediction> = predictions.filter(|p| p.relative_error.is_some()).collect();
        if all.is_empty() {
            return None;
        }
        let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / all.len() as f64;
        let errors = || all.iter().filter_map(|p| p.relative_error);
        let before: Option<Vec<f64>> = all
            .iter()
            .map(|p| {
                // The relative error tells the scale that it is relative to.
                let scale = match p.quantity {
                    BandQuantity::ResidualVelocity => p.impact_velocity_m_s,
                    _ => p.measured,
                };
                Some((p.before? - p.measured) / scale)
            })
            .collect();
        let inside: Option<Vec<bool>> = all.iter().map(|p| p.is_inside()).collect();
        Some(Self {
            count: all.len(),
            rms_before: before.map(|e| mean(&mut e.iter().map(|e| e * e)).sqrt()),
            rms: mean(&mut errors().map(|e| e * e)).sqrt(),
            bias: mean(&mut errors()),
            inside: inside.map(|inside| inside.into_iter().filter(|inside| *inside).count()),
        })
    }
}

/// States of the sample that are put through the model.
pub(super) fn draws(sample: Option<&Sample>) -> Vec<&[f64]> {
    sample.map_or_else(Vec::new, |sample| {
        let every = stride(sample.kept().count(), sample.walkers());
        sample.kept().step_by(every).collect()
    })
}

/// How far apart draws are in a number of states of walkers in turn: without a common divisor with theirs, so that draws come from each.
fn stride(states: usize, walkers: usize) -> usize {
    let shares = |stride: usize| {
        let (mut large, mut small) = (walkers, stride);
        while small > 0 {
            (large, small) = (small, large % small);
        }
        large > 1
    };
    let mut stride = states.div_ceil(DRAWS).max(1);
    while shares(stride) {
        stride += 1;
    }
    stride
}

/// What the model says of all measured values, those kept out of the fit included.
pub(super) fn predictions(
    problem: &Problem,
    best: &[f64],
    draws: &[&[f64]],
    counter: &Counter<'_>,
) -> Vec<Prediction> {
    let predict = |observation: &Observation| {
        let unit = |si: f64| observation.quantity.in_unit(si);
        let found = problem.prediction(observation, best).ok();
        let fitted = problem.fitted.len();
        // A state that the model fails with has no density, except for a value that was kept out.
        let drawn: Vec<(f64, f64)> = draws
            .par_iter()
            .filter_map(|state| {
                let value = problem.prediction(observation, &state[..fitted]).ok()?;
                Some((
                    value,
                    observation.spread().deviation(problem.scatter_in(state)),
                ))
            })
            .collect();
        counter.count();
        let banded = !drawn.is_empty();
        let model = sorted(drawn.iter().map(|(value, _)| *value));
        let band = |of: &dyn Fn(f64) -> f64| {
            banded.then(|| PROBABILITIES.map(|probability| unit(of(probability))))
        };
        let predictive = band(&|probability| mixture_quantile(&drawn, probability));
        Prediction {
            id: observation.id.clone(),
            sources: observation.sources.clone(),
            held_out: observation.held_out,
            quantity: observation.quantity,
            unit: observation.quantity.unit(),
            impact_velocity_m_s: observation.impact_velocity,
            measured: unit(observation.measured),
            uncertainty: observation.uncertainty.map(unit),
            before: problem.as_written(observation).map(unit),
            best: found.map(unit),
            axisymmetric: observation
                .correction
                .map(|c| [c.value, c.first.uncertainty].map(unit)),
            relative_error: found.map(|value| (value - observation.measured) / observation.scale()),
            model_band: band(&|probability| quantile(&model, probability))
                .map(|[low, _, high]| [low, high]),
            predictive_band: predictive.map(|[low, _, high]| [low, high]),
            predictive_median: predictive.map(|[_, median, _]| median),
        }
    };
    problem.observations.par_iter().map(predict).collect()
}

/// Quantile of normal distributions, given as means and standard deviations, that are equally likely.
pub(super) fn mixture_quantile(parts: &[(f64, f64)], probability: f64) -> f64 {
    let below = |y: f64| {
        let part = |(mean, deviation): &(f64, f64)| normal_probability((y - mean) / deviation);
        parts.iter().map(part).sum::<f64>() / parts.len() as f64
    };
    let ends = |sign: f64| {
        parts
            .iter()
            .map(move |(mean, deviation)| mean + sign * 9.0 * deviation)
    };
    let low = ends(-1.0).fold(f64::INFINITY, f64::min);
    let high = ends(1.0).fold(f64::NEG_INFINITY, f64::max);
    bisected(low, high, 60, |y| below(y) < probability)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_come_from_every_walker() {
        for (walkers, steps) in [(32, 4000), (8, 60), (16, 2000), (3, 400), (10, 1)] {
            let states = walkers * steps;
            let every = stride(states, walkers);
            let drawn = (0..states).step_by(every).map(|state| state % walkers);
            let drawn: std::collections::BTreeSet<usize> = drawn.collect();
            assert_eq!(drawn.len(), walkers, "{walkers} {steps}");
            let draws = states.div_ceil(every);
            assert!(draws <= DRAWS && (draws > DRAWS / 4 || every == 1));
        }
    }

    #[test]
    fn quantiles_are_the_tabled_ones() {
        let one = [(10.0, 2.0)];
        assert!(
            (mixture_quantile(&one, 0.975) - (10.0 + 2.0 * 1.959_963_984_540_054)).abs() < 1e-9
        );
        // Two that are far apart: 97.5 % of both together is 95 % of the upper one.
        let two = [(0.0, 1.0), (100.0, 1.0)];
        assert!((mixture_quantile(&two, 0.975) - (100.0 + 1.644_853_626_951_472_7)).abs() < 1e-9);
    }
}
