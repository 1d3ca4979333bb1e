//! Posterior: a sample from around the best values, and its statistics.

use std::sync::atomic::Ordering;

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::{
    Noise, Observer, ParameterRecord, Problem, Sample, Sampling, ScatterRecord, Stage, cancelled,
    fit::Fit,
    heard,
    noise::{SCATTER, independent},
    parameter::half_of_68,
    predictive::PROBABILITIES,
    sampler,
};
use crate::{
    Error,
    statistics::{mean, quantile, sorted, variance},
    sweep,
};

/// How much wider than the estimated posterior the walkers start: R-hat sees ensembles that have not met.
const SPREAD: f64 = 2.0;
/// Most times as many steps that a warning asks for.
const MOST_FACTOR: f64 = 20.0;
/// R-hat from which ensembles have not mixed, and the effective sizes that intervals need \[vehtari2021\].
const R_HAT: f64 = 1.01;
const SIZE: f64 = 400.0;
/// What random numbers are drawn for.
const PLACE: u64 = 0x91ace;

/// What a sample says of one parameter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Marginal {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub standard_deviation: f64,
    /// 2.5 %, 50 % and 97.5 %.
    pub quantiles: [f64; 3],
    /// Rank-normalised split R-hat over the ensembles, the folded one included: 1 where they agree.
    pub r_hat: f64,
    /// Effective sample size for the mean and the median.
    pub bulk_effective_size: f64,
    /// Effective sample size for the ends of intervals.
    pub tail_effective_size: f64,
}

impl Marginal {
    pub(super) fn of(sample: &Sample, parameter: usize) -> Self {
        let values = sample.values(parameter);
        let sorted = sorted(values.iter().copied());
        Self {
            mean: mean(&values),
            standard_deviation: variance(&values).sqrt(),
            quantiles: PROBABILITIES.map(|probability| quantile(&sorted, probability)),
            r_hat: sample.r_hat(parameter),
            bulk_effective_size: sample.bulk_effective_size(parameter),
            tail_effective_size: sample.tail_effective_size(parameter),
        }
    }

    /// Of the logarithm, that of the number itself; mean and standard deviation as those of a lognormal distribution.
    pub(super) fn exponential(self) -> Self {
        let variance = self.standard_deviation.powi(2);
        let mean = (self.mean + 0.5 * variance).exp();
        Self {
            mean,
            standard_deviation: mean * variance.exp_m1().sqrt(),
            quantiles: self.quantiles.map(f64::exp),
            ..self
        }
    }
}

/// Samples the posterior.
pub(super) fn sample(
    problem: &Problem,
    fit: &Fit,
    sampling: Sampling,
    seed: u64,
    observer: Observer<'_>,
) -> Result<Sample, Error> {
    let steps = sampling.ensembles * (sampling.burn_in + sampling.steps);
    let progress = |done: usize| {
        let runs = problem.runs.load(Ordering::Relaxed);
        let answer = observer(Stage::Sampling, done as f64 / steps as f64, runs);
        heard(problem, answer);
        answer
    };
    let covariance = fit.covariance();
    let root = covariance.cholesky().map_or_else(
        || DMatrix::identity(fit.values.len(), fit.values.len()),
        |c| c.l(),
    );
    let start = |ensemble: usize, walker: usize| {
        let normal = |dimension: usize| {
            let stream = sweep::stream(seed, PLACE + ensemble as u64, dimension);
            let u =
                ((sweep::bits(stream, walker as u64) >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
            SPREAD * sweep::score(u)
        };
        let count = fit.values.len();
        let away = &root * DVector::from_iterator(count, (0..count).map(normal));
        let mut state: Vec<f64> = (0..count)
            .map(|i| inside(problem, i, fit.values[i], away[i] * fit.units[i]))
            .collect();
        if problem.noise == Noise::Estimated {
            // The logarithm of a standard deviation by n values has about the standard deviation √(1/2n).
            let width = (0.5 / independent(&fit.spreads)).sqrt();
            let ln_scatter = fit.scatter.ln() + width * normal(count);
            state.push(ln_scatter.clamp(SCATTER.0.ln(), SCATTER.1.ln()));
        }
        state
    };
    sampler::sample(
        |state| problem.ln_posterior(state, &fit.spreads),
        &start,
        sampling,
        seed,
        &progress,
    )
    .map_err(|sampler::Stopped| cancelled(problem))
    .and_then(|sample| match problem.stop.load(Ordering::Relaxed) {
        true => Err(cancelled(problem)),
        false => Ok(sample),
    })
}

/// A value at some distance from the best one, on the other side of it or closer where it would be outside.
fn inside(problem: &Problem, index: usize, best: f64, mut away: f64) -> f64 {
    let prior = &problem.fitted[index].prior;
    loop {
        for value in [best + away, best - away] {
            if prior.ln_density(value) > f64::NEG_INFINITY {
                return value;
            }
        }
        away *= 0.5;
    }
}

/// Widths of the posterior over those of the priors, both as half of the range that holds 68 %, and correlations.
pub(super) fn shape(problem: &Problem, sample: &Sample) -> (Vec<f64>, DMatrix<f64>) {
    let values: Vec<Vec<f64>> = (0..problem.fitted.len())
        .map(|i| sample.values(i))
        .collect();
    let width = |(values, parameter): (&Vec<f64>, &super::Fitted)| {
        let sorted = sorted(values.iter().copied());
        let half = half_of_68(|u| quantile(&sorted, u));
        half / parameter.prior_deviation()
    };
    let widths = values.iter().zip(&problem.fitted).map(width).collect();
    let moments: Vec<(f64, f64)> = values
        .iter()
        .map(|v| (mean(v), variance(v).sqrt()))
        .collect();
    let correlations = DMatrix::from_fn(values.len(), values.len(), |i, j| {
        if i == j {
            return 1.0;
        }
        let products = values[i].iter().zip(&values[j]);
        let sum: f64 = products
            .map(|(a, b)| (a - moments[i].0) * (b - moments[j].0))
            .sum();
        sum / (values[i].len() as f64 - 1.0) / (moments[i].1 * moments[j].1)
    });
    (widths, correlations)
}

/// What is wrong with a sample of so many steps, with the number of steps that is likely to be enough.
pub(super) fn warnings(
    parameters: &[ParameterRecord],
    scatter: &ScatterRecord,
    steps: Option<usize>,
) -> Vec<String> {
    let named = parameters
        .iter()
        .map(|parameter| (parameter.key.as_str(), parameter.posterior));
    let all = named.chain([("the scatter", scatter.posterior)]);
    let mut warnings = Vec::new();
    // Ensembles that do not agree need more than their sizes say.
    let mut factor: f64 = 2.0;
    for (name, marginal) in all {
        let Some(marginal) = marginal else { continue };
        // Not a number where there are too few steps to tell.
        if marginal.r_hat.is_nan() || marginal.r_hat > R_HAT {
            factor = factor.max(4.0);
            warnings.push(format!(
                "the ensembles do not agree on {name}: R-hat is {:.3}, more than {R_HAT}",
                marginal.r_hat
            ));
        }
        let sizes = [
            ("for its mean and median", marginal.bulk_effective_size),
            ("for the ends of its range", marginal.tail_effective_size),
        ];
        for (what_for, size) in sizes {
            if size.is_nan() || size < SIZE {
                factor = factor.max(1.2 * SIZE / size.max(1.0)).min(MOST_FACTOR);
                warnings.push(format!(
                    "the sample of {name} is worth {size:.0} independent values {what_for}, fewer than {SIZE}"
                ));
            }
        }
    }
    if let Some(steps) = steps.filter(|_| !warnings.is_empty()) {
        // Whole hundreds.
        let enough = 100 * (factor * steps as f64 / 100.0).ceil() as usize;
        warnings.push(format!(
            "the sample is too short: repeat with `--steps {enough}`, which takes {:.0} times as long",
            enough as f64 / steps as f64
        ));
    }
    warnings
}
