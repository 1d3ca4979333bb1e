//! Least-squares estimate with its scatter and the standard errors of the derivatives.

use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::{
    Counter, Noise, Observer, Problem, Stage, cancelled, heard,
    least_squares::{Minimum, Unable, jacobian, minimise},
    noise::{SCATTER, Spread, independent, scatter_of},
    problem::{Silent, refuse},
};
use crate::{Error, sweep};

/// Points tried for a start, per parameter.
const TRIED: usize = 10;
/// Starts from which the minimum is looked for.
const STARTS: usize = 2;
/// Rounds in which scatter, correlation times and parameters are made to agree.
const ROUNDS: usize = 8;
/// Relative change of the scatter and of the correlation times that ends them.
const SETTLED: f64 = 1e-4;
/// Relative difference of two minima that are one.
const SAME: f64 = 1e-3;
/// What random numbers are drawn for.
const START: u64 = 0x57a7;

/// The best values.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fit {
    pub(super) values: Vec<f64>,
    pub(super) scatter: f64,
    /// Correlation times of all curves [s].
    pub(super) correlation_times: Vec<f64>,
    /// How what is fitted to is distributed about the model.
    pub(super) spreads: Vec<Spread>,
    /// Derivatives of the measured quantities over their standard deviations by the parameters over those of their priors.
    pub(super) slopes: DMatrix<f64>,
    /// Standard deviations of the priors.
    pub(super) units: Vec<f64>,
    /// Whether a prior counts as a measurement.
    informed: Vec<bool>,
    pub(super) warnings: Vec<String>,
}

/// How often least squares compute all measured values: a guess of a dozen steps from each start, and the rounds after them.
pub(super) fn evaluations(parameters: usize) -> usize {
    (TRIED + 1) * parameters + (12 * STARTS + ROUNDS) * (2 * parameters + 2)
}

/// Finds the values with the smallest sum of squares, from several starts.
pub(super) fn least_squares(
    problem: &Problem,
    seed: u64,
    observer: Observer<'_>,
) -> Result<Fit, Error> {
    let count = problem.fitted.len();
    let report = |part: f64| {
        let runs = problem.runs.load(Ordering::Relaxed);
        heard(problem, observer(Stage::LeastSquares, part, runs));
    };
    let counter = Counter {
        done: AtomicUsize::new(0),
        total: evaluations(count),
        report: &report,
    };
    let curves = problem.curves();
    let correlation_times: Vec<f64> = curves.map(|c| c.first_correlation_time()).collect();
    let mut solver = Solver {
        problem,
        counter,
        spreads: problem.spreads(&correlation_times),
        correlation_times,
    };
    let failed = |unable: Unable| match unable {
        Unable::Stopped => cancelled(problem),
        Unable::Failed if problem.stop.load(Ordering::Relaxed) => cancelled(problem),
        Unable::Failed => refuse(
            format!(
                "the model `{}` fails in every part of the ranges that was tried",
                problem.model.name()
            ),
            "give other ranges".to_owned(),
        ),
    };
    let mut scatter = problem.noise.given().unwrap_or(0.05);
    let mut minima: Vec<Minimum> = Vec::new();
    let mut unable = Unable::Failed;
    for start in solver.starts(seed, scatter) {
        match solver.minimum(&start, scatter) {
            Ok(minimum) => minima.push(minimum),
            Err(Unable::Stopped) => unable = Unable::Stopped,
            Err(Unable::Failed) => {}
        }
    }
    minima.sort_by(|a, b| a.sum_of_squares.total_cmp(&b.sum_of_squares));
    let mut warnings = Vec::new();
    if let [best, .., worst] = minima.as_slice()
        && worst.sum_of_squares > (1.0 + SAME) * best.sum_of_squares + 1e-6
    {
        warnings.push(format!(
            "least squares ended in different minima from different starts: sums of squares {:.4} and {:.4}; there may be a better one",
            best.sum_of_squares, worst.sum_of_squares
        ));
    }
    let mut best = minima.into_iter().next().ok_or_else(|| failed(unable))?;
    let correlated = problem.curves().any(|c| c.curve.correlation_time.is_none());
    if problem.noise == Noise::Estimated || correlated {
        for _ in 0..ROUNDS {
            let mut change = solver.correlate(&best.values).map_err(failed)?;
            if problem.noise == Noise::Estimated {
                let found = solver.scatter(&best.values).map_err(failed)?;
                change = change.max((found / scatter - 1.0).abs());
                scatter = found;
            }
            if change < SETTLED {
                break;
            }
            best = solver.minimum(&best.values, scatter).map_err(failed)?;
        }
    }
    let worth = independent(&solver.spreads);
    if problem.noise == Noise::Estimated && worth <= count as f64 {
        warnings.push(format!(
            "the data are worth {worth:.1} independent values, too few for {count} parameters and their own scatter: state uncertainties, or \
             fit fewer parameters"
        ));
    }
    if !best.converged {
        warnings.push(
            "least squares did not converge: what the model gives may jump with the parameters"
                .to_owned(),
        );
    }
    solver.fit(best.values, scatter, warnings).map_err(failed)
}

struct Solver<'a> {
    problem: &'a Problem,
    counter: Counter<'a>,
    correlation_times: Vec<f64>,
    spreads: Vec<Spread>,
}

impl Solver<'_> {
    fn residuals(&self, values: &[f64], scatter: f64) -> Result<Vec<f64>, Unable> {
        self.counter.count();
        self.problem.residuals(values, &self.spreads, scatter)
    }

    fn minimum(&self, start: &[f64], scatter: f64) -> Result<Minimum, Unable> {
        let residuals = |values: &[f64]| self.residuals(values, scatter);
        minimise(&residuals, &self.problem.bounds(), start)
    }

    /// The middle of the priors and points of a Latin hypercube, the best of them first, as many as are tried from.
    fn starts(&self, seed: u64, scatter: f64) -> Vec<Vec<f64>> {
        let tried = TRIED * self.problem.fitted.len();
        let point = |test: usize| {
            let value = |(dimension, parameter): (usize, &super::Fitted)| {
                let stream = sweep::stream(seed, START, dimension);
                let stratum = sweep::permuted(stream, test as u64, tried as u64);
                parameter.quantile((stratum as f64 + 0.5) / tried as f64)
            };
            self.problem.fitted.iter().enumerate().map(value).collect()
        };
        let mut points: Vec<Vec<f64>> = vec![self.problem.middle()];
        points.extend((0..tried).map(point));
        let mut ranked: Vec<(f64, Vec<f64>)> = points
            .into_par_iter()
            .filter_map(|point| {
                let residuals = self.residuals(&point, scatter).ok()?;
                Some((residuals.iter().map(|r| r * r).sum(), point))
            })
            .collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        ranked.into_iter().take(STARTS).map(|(_, p)| p).collect()
    }

    /// Scatter of the measured values about the model.
    fn scatter(&self, values: &[f64]) -> Result<f64, Unable> {
        let differences = self.problem.differences(values)?;
        let degrees = independent(&self.spreads) - values.len() as f64;
        Ok(scatter_of(&differences, &self.spreads, degrees.max(1.0)))
    }

    /// Estimates the correlation times that are not stated; gives the largest relative change.
    fn correlate(&mut self, values: &[f64]) -> Result<f64, Unable> {
        let mut times = Vec::new();
        for set in &self.problem.curve_sets {
            let predicted = self
                .problem
                .curves_of(set, values)
                .map_err(|silent| match silent {
                    Silent::Stopped => Unable::Stopped,
                    _ => Unable::Failed,
                })?;
            let curves = set.curves.iter().zip(predicted);
            times.extend(curves.map(|(curve, predicted)| {
                let stated = curve.curve.correlation_time;
                stated.unwrap_or_else(|| curve.correlation_time(&curve.differences(&predicted)))
            }));
        }
        let change = |(new, old): (&f64, &f64)| match new == old {
            true => 0.0,
            false => (new - old).abs() / new.max(*old),
        };
        let changes = times.iter().zip(&self.correlation_times).map(change);
        let largest = changes.fold(0.0, f64::max);
        self.spreads = self.problem.spreads(&times);
        self.correlation_times = times;
        Ok(largest)
    }

    fn fit(&self, values: Vec<f64>, scatter: f64, warnings: Vec<String>) -> Result<Fit, Unable> {
        let fitted = &self.problem.fitted;
        let residuals = |values: &[f64]| {
            let mut all = self.residuals(values, scatter.max(SCATTER.0))?;
            all.truncate(all.len() - fitted.len());
            Ok(all)
        };
        let mut slopes = jacobian(&residuals, &self.problem.bounds(), &values)?;
        let units: Vec<f64> = fitted.iter().map(super::Fitted::prior_deviation).collect();
        for (mut column, unit) in slopes.column_iter_mut().zip(&units) {
            column *= *unit;
        }
        Ok(Fit {
            informed: fitted
                .iter()
                .map(|parameter| {
                    let (low, high) = (parameter.quantile(0.2), parameter.quantile(0.8));
                    parameter.prior.score(low) != parameter.prior.score(high)
                })
                .collect(),
            values,
            scatter,
            correlation_times: self.correlation_times.clone(),
            spreads: self.spreads.clone(),
            slopes,
            units,
            warnings,
        })
    }
}

impl Fit {
    /// Covariance with every prior taken for a normal one, in units of the priors' standard deviations.
    pub(super) fn covariance(&self) -> DMatrix<f64> {
        let information = self.slopes.transpose() * &self.slopes;
        let count = self.values.len();
        let whole = information + DMatrix::identity(count, count);
        // One more than a positive matrix has an inverse.
        whole
            .cholesky()
            .map_or_else(|| DMatrix::identity(count, count), |c| c.inverse())
    }

    /// Standard deviations over those of the priors, and correlations.
    pub(super) fn shape(&self) -> (Vec<f64>, DMatrix<f64>) {
        let covariance = self.covariance();
        let widths: Vec<f64> = covariance.diagonal().iter().map(|v| v.sqrt()).collect();
        let correlations = DMatrix::from_fn(widths.len(), widths.len(), |i, j| {
            covariance[(i, j)] / (widths[i] * widths[j])
        });
        (widths, correlations)
    }

    /// Standard error of a value by the data and by the priors that count as measurements; `None` where they do not determine it.
    pub(super) fn standard_error(&self, index: usize) -> Option<f64> {
        let mut information = self.slopes.transpose() * &self.slopes;
        for (i, informed) in self.informed.iter().enumerate() {
            information[(i, i)] += f64::from(u8::from(*informed));
        }
        let lengths = DVector::from_iterator(
            self.values.len(),
            information.diagonal().iter().map(|v| v.sqrt()),
        );
        if lengths.iter().any(|length| *length == 0.0) {
            let alone = lengths[index] > 0.0;
            return alone
                .then(|| self.units[index] / lengths[index])
                .filter(|_| self.values.len() == 1);
        }
        // Scaled to a unit diagonal, what is singular shows by its eigenvalues.
        let scaled = DMatrix::from_fn(lengths.len(), lengths.len(), |i, j| {
            information[(i, j)] / (lengths[i] * lengths[j])
        });
        let eigen = scaled.symmetric_eigen();
        let variance: f64 = eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter())
            .map(|(value, vector)| match vector[index].powi(2) {
                part if *value > 1e-10 => part / value,
                part if part > 1e-6 => f64::INFINITY,
                _ => 0.0,
            })
            .sum();
        variance
            .is_finite()
            .then(|| variance.sqrt() * self.units[index] / lengths[index])
    }
}
