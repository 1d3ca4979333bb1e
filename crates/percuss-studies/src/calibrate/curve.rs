//! Measured curves: those of a case come from one run.

use super::{Fitted, noise::Spread, observation::scenario, problem::Silent};
use crate::{
    Error, Scenario,
    case::{Document, Template},
    check::Diagnostic,
    measured_curves::{Computed, at},
    outcome::RunResult,
    scenario::MeasuredCurve,
    units::significant,
};

/// Part of a curve that its errors are taken to be correlated over before there are residuals.
const GUESS: f64 = 0.05;

/// Curves that were measured in one test.
#[derive(Debug, Clone)]
pub struct CurveSet {
    /// The curves.
    pub curves: Vec<CurveObservation>,
    /// Impact velocity [m/s].
    pub impact_velocity: f64,
    pub(super) template: Template,
    document: Document,
}

/// A measured curve.
#[derive(Debug, Clone)]
pub struct CurveObservation {
    /// Name of the case and of the curve.
    pub id: String,
    /// The curve as measured.
    pub curve: MeasuredCurve,
    /// Whether it is kept out of the fit, to test it.
    pub held_out: bool,
    /// The points that the run covers: time [s], value in SI units, and the time that it stands for [s].
    pub(super) points: Vec<Point>,
    /// Root mean square of these values over time.
    pub(super) scale: f64,
}

/// A point of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    pub(super) time: f64,
    pub(super) value: f64,
    interval: f64,
}

impl CurveSet {
    /// The measured curves of a case; none where it has none.
    pub(super) fn of(
        document: &Document,
        template: &Template,
        scenario: &Scenario,
    ) -> Option<Self> {
        let curve = |curve: &MeasuredCurve| CurveObservation {
            id: format!(
                "{}: {}, {}",
                scenario.name,
                curve.name,
                curve.quantity.replace('_', " ")
            ),
            curve: curve.clone(),
            held_out: false,
            points: Vec::new(),
            scale: 0.0,
        };
        let curves: Vec<_> = scenario.measured_curves.iter().map(curve).collect();
        (!curves.is_empty()).then(|| Self {
            curves,
            impact_velocity: scenario.impact_velocity,
            template: template.clone(),
            document: document.clone(),
        })
    }

    /// The case with values for what is fitted; otherwise why there is none.
    pub(super) fn scenario(&self, fitted: &[Fitted], values: &[f64]) -> Result<Scenario, String> {
        scenario(&self.template, fitted, values, self.impact_velocity)
    }

    /// Points a curve of the set has in common with a run.
    ///
    /// # Errors
    /// The place of the curve, where there are fewer than two.
    pub(super) fn cover(&mut self, index: usize, computed: &Computed) -> Result<(), Error> {
        let of = &mut self.curves[index];
        let ends = |points: &[(f64, f64)]| {
            let time = |at: usize| significant(points[at].0 * 1e6, 4);
            format!("{} to {} us", time(0), time(points.len() - 1))
        };
        let (from, to) = (
            computed.points[0].0,
            computed.points[computed.points.len() - 1].0,
        );
        let all = &of.curve.points;
        let covered: Vec<(f64, f64)> = all
            .iter()
            .copied()
            .filter(|(time, _)| (from..=to).contains(time))
            .collect();
        if covered.len() < 2 {
            let key = format!("measured_curves.{}", of.curve.table);
            let message = format!(
                "the run covers {}, and `{}` of `{}` has {} of its {} values there: it covers {}",
                ends(&computed.points),
                of.curve.quantity,
                of.curve.name,
                covered.len(),
                all.len(),
                ends(all)
            );
            let help = "count the times from the impact, at least two of them within the run, or give the model a later `end_time`";
            return Err(self
                .document
                .place(Diagnostic::at(&key, message, help))
                .into());
        }
        of.points = points(&covered);
        let total: f64 = of.points.iter().map(|point| point.interval).sum();
        let squares = of.points.iter().map(|p| p.interval * p.value.powi(2));
        of.scale = (squares.sum::<f64>() / total).sqrt();
        Ok(())
    }
}

/// Points with the times that they stand for: half of the distance between the neighbours, at an end the distance to the only one.
fn points(all: &[(f64, f64)]) -> Vec<Point> {
    let time = |i: usize| all[i].0;
    let last = all.len() - 1;
    let interval = |i: usize| match i {
        0 => time(1) - time(0),
        i if i == last => time(last) - time(last - 1),
        i => 0.5 * (time(i + 1) - time(i - 1)),
    };
    let points = all.iter().enumerate();
    points
        .map(|(i, (time, value))| Point {
            time: *time,
            value: *value,
            interval: interval(i),
        })
        .collect()
}

impl CurveObservation {
    /// What a run gives at the times of the points, in SI units.
    pub(super) fn predicted(&self, result: &RunResult) -> Result<Vec<f64>, Silent> {
        let found = crate::measured_curves::computed(&self.curve, result.history.as_ref());
        let found = found.map_err(Silent::Always)?;
        let end = found.points.last().map_or(0.0, |point| point.0);
        // A run that ends by itself goes on with its last value; a gauge that erodes has none.
        if found.erodes && self.points.last().is_some_and(|point| point.time > end) {
            return Err(Silent::Here(format!(
                "the gauge erodes at {} us, before the measured curve ends",
                significant(end * 1e6, 4)
            )));
        }
        let points = self.points.iter();
        Ok(points.map(|point| at(&found.points, point.time)).collect())
    }

    /// Differences between what a run gives and what was measured, at the points.
    pub(super) fn differences(&self, predicted: &[f64]) -> Vec<f64> {
        let pairs = predicted.iter().zip(&self.points);
        pairs.map(|(value, point)| value - point.value).collect()
    }

    /// Number of points that the run covers.
    pub(super) fn values(&self) -> usize {
        self.points.len()
    }

    /// Says that there are points that the run does not cover.
    pub(super) fn warning(&self) -> Option<String> {
        let (used, all) = (self.points.len(), self.curve.points.len());
        (used < all).then(|| {
            format!(
                "{} of the {all} values of `{}` are not used: the run does not cover them",
                all - used,
                self.id
            )
        })
    }

    /// Correlation time that is stated, or a guess.
    pub(super) fn first_correlation_time(&self) -> f64 {
        let length = self.points.iter().map(|point| point.interval).sum::<f64>();
        self.curve.correlation_time.unwrap_or(GUESS * length)
    }

    /// How the points are distributed about the model: each counts as tanh(Δ/2τ) independent values, all as at least one.
    pub(super) fn spreads(&self, correlation_time: f64) -> Vec<Spread> {
        let weight = |point: &Point| (0.5 * point.interval / correlation_time).tanh();
        let weights: Vec<f64> = match correlation_time > 0.0 {
            true => self.points.iter().map(weight).collect(),
            false => vec![1.0; self.points.len()],
        };
        let factor = 1.0 / weights.iter().sum::<f64>().min(1.0);
        let spread = |weight: f64| Spread {
            weight: factor * weight,
            ..self.spread()
        };
        weights.into_iter().map(spread).collect()
    }

    /// How a single value is distributed about the model.
    pub(super) fn spread(&self) -> Spread {
        Spread {
            stated: self.curve.uncertainty.unwrap_or(0.0),
            scale: self.scale,
            weight: 1.0,
        }
    }

    /// Correlation time of differences at the points [s].
    ///
    /// The autocorrelation ρ about zero of the differences, interpolated to equal steps Δ, is summed up to its first value that is not
    /// positive. An exponential one with the same `1 + 2 Σ ρ = coth(Δ/2τ)` has the correlation time τ.
    pub(super) fn correlation_time(&self, differences: &[f64]) -> f64 {
        let curve: Vec<(f64, f64)> = self
            .points
            .iter()
            .zip(differences)
            .map(|(point, difference)| (point.time, *difference))
            .collect();
        let count = curve.len();
        let (from, to) = (curve[0].0, curve[count - 1].0);
        let step = (to - from) / (count - 1) as f64;
        let values: Vec<f64> = (0..count)
            .map(|i| at(&curve, (from + i as f64 * step).min(to)))
            .collect();
        let product = |lag: usize| -> f64 {
            let pairs = values.iter().zip(&values[lag..]);
            pairs.map(|(a, b)| a * b).sum()
        };
        let square = product(0);
        if square <= 0.0 {
            return 0.0;
        }
        let correlations = (1..count).map(|lag| product(lag) / square);
        let sum: f64 = correlations.take_while(|part| *part > 0.0).sum();
        match 1.0 + 2.0 * sum {
            worth if worth > 1.0 => 0.5 * step / worth.recip().atanh(),
            _ => 0.0,
        }
    }
}
