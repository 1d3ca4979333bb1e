//! The curve `v_r = a (v^p − v_bl^p)^(1/p)` of Lambert and Jonas through residual velocities, by least squares.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DVector, Dyn, OMatrix, RowVector3, U3, Vector3, storage::Owned};
use serde::Serialize;

use super::CurvePoint;
use crate::minimum::least;

/// The curve with its three numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LambertJonasFit {
    /// Factor a.
    pub a: f64,
    /// Exponent p.
    pub p: f64,
    /// Ballistic limit [m/s]: that of the model where it was found, otherwise fitted.
    pub ballistic_limit_m_s: f64,
    /// Root mean square of the differences [m/s].
    pub rms_m_s: f64,
}

/// Fewest points that three numbers are fitted to.
const FEWEST: usize = 4;
/// Ranges of `a` and `p`: far beyond anything that a plate does, so that only a curve of another shape ends there.
const FACTORS: std::ops::RangeInclusive<f64> = 1e-3..=3.0;
const EXPONENTS: std::ops::RangeInclusive<f64> = 0.5..=50.0;
/// Bound on the evaluations, over one more than the number of parameters.
const PATIENCE: usize = 500;
/// Difference that stands for each where no curve has the numbers [m/s]: the step is taken back.
const OUTSIDE: f64 = 1e6;
/// Fewest points that two numbers are fitted to.
const FEWEST_AT_LIMIT: usize = 3;
/// Intervals of ln p that are searched for the least sum of squares, and steps that refine it.
const INTERVALS: u32 = 48;
const REFINEMENTS: u32 = 60;

impl LambertJonasFit {
    /// Residual velocity at an impact velocity [m/s].
    pub fn at(&self, velocity: f64) -> f64 {
        if velocity <= self.ballistic_limit_m_s {
            return 0.0;
        }
        // Through the ratio, so that a large p does not overflow.
        let ratio = (self.ballistic_limit_m_s / velocity).powf(self.p);
        self.a * velocity * (1.0 - ratio).powf(1.0 / self.p)
    }

    /// Derivatives of the residual velocity by `a`, `p` and the limit.
    fn slopes(&self, velocity: f64) -> [f64; 3] {
        if velocity <= self.ballistic_limit_m_s {
            return [0.0; 3];
        }
        let (p, limit) = (self.p, self.ballistic_limit_m_s);
        let value = self.at(velocity);
        let ratio = (limit / velocity).powf(p);
        let rest = 1.0 - ratio;
        let by_p = -rest.ln() / (p * p) - ratio * (limit / velocity).ln() / (p * rest);
        [
            value / self.a,
            value * by_p,
            -value * ratio / (rest * limit),
        ]
    }

    fn numbers(&self) -> [f64; 3] {
        [self.a, self.p, self.ballistic_limit_m_s]
    }

    /// The curve with these numbers, if they make one.
    fn with([a, p, limit]: [f64; 3], lowest: f64) -> Option<Self> {
        let inside = FACTORS.contains(&a) && EXPONENTS.contains(&p);
        (inside && limit > 0.0 && limit < lowest).then_some(Self {
            a,
            p,
            ballistic_limit_m_s: limit,
            rms_m_s: 0.0,
        })
    }

    fn squares(&self, points: &[(f64, f64)]) -> f64 {
        let square = |(velocity, residual): &(f64, f64)| (self.at(*velocity) - residual).powi(2);
        points.iter().map(square).sum()
    }
}

/// Fits the curve with a free limit to points above it, by the method of Levenberg and Marquardt \[more1978\]; `None` for fewer than four points with a
/// residual velocity, or points that no such curve follows.
pub fn fit_lambert_jonas(curve: &[CurvePoint]) -> Option<LambertJonasFit> {
    let points = above_limit(curve);
    if points.len() < FEWEST {
        return None;
    }
    let lowest = points.iter().map(|point| point.0).reduce(f64::min)?;
    let numbers = start(&points, lowest)?.numbers().into();
    let problem = FreeCurve {
        points: &points,
        lowest,
        numbers,
    };
    let (problem, _) = LevenbergMarquardt::new()
        .with_patience(PATIENCE)
        .minimize(problem);
    let mut fit = problem.curve()?;
    fit.rms_m_s = (fit.squares(&points) / points.len() as f64).sqrt();
    Some(fit)
}

/// Least squares of the three numbers of a curve.
struct FreeCurve<'a> {
    points: &'a [(f64, f64)],
    /// The lowest of their impact velocities, below which the limit lies [m/s].
    lowest: f64,
    numbers: Vector3<f64>,
}

impl FreeCurve<'_> {
    fn curve(&self) -> Option<LambertJonasFit> {
        LambertJonasFit::with(self.numbers.into(), self.lowest)
    }
}

impl LeastSquaresProblem<f64, Dyn, U3> for FreeCurve<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, U3>;
    type ParameterStorage = Owned<f64, U3>;

    fn set_params(&mut self, numbers: &Vector3<f64>) {
        self.numbers = *numbers;
    }

    fn params(&self) -> Vector3<f64> {
        self.numbers
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let curve = self.curve();
        let residual = |(velocity, residual): &(f64, f64)| {
            curve.map_or(OUTSIDE, |curve| curve.at(*velocity) - residual)
        };
        let residuals = self.points.iter().map(residual);
        Some(DVector::from_iterator(self.points.len(), residuals))
    }

    fn jacobian(&self) -> Option<OMatrix<f64, Dyn, U3>> {
        let curve = self.curve()?;
        let rows = self
            .points
            .iter()
            .map(|(velocity, _)| RowVector3::from(curve.slopes(*velocity)));
        Some(OMatrix::<f64, Dyn, U3>::from_rows(
            &rows.collect::<Vec<_>>(),
        ))
    }
}

/// Fits `a` and `p` of the curve that starts at a known limit [m/s]: the best `a` of each `p` is known in closed form, and the best `p` is
/// searched for between its bounds. `None` for fewer than three points with a residual velocity above the limit.
pub fn fit_lambert_jonas_from(limit: f64, curve: &[CurvePoint]) -> Option<LambertJonasFit> {
    let mut points = above_limit(curve);
    points.retain(|(velocity, _)| *velocity > limit);
    if points.len() < FEWEST_AT_LIMIT {
        return None;
    }
    let lowest = points.iter().map(|point| point.0).reduce(f64::min)?;
    let (from, to) = (EXPONENTS.start().ln(), EXPONENTS.end().ln());
    let step = (to - from) / f64::from(INTERVALS);
    let exponent = |log: f64| log.exp().clamp(*EXPONENTS.start(), *EXPONENTS.end());
    let squares = |log: f64| {
        with_best_factor(exponent(log), limit, &points, lowest)
            .map_or(f64::INFINITY, |fit| fit.squares(&points))
    };
    let near = (0..=INTERVALS)
        .map(|i| from + step * f64::from(i))
        .min_by(|a, b| squares(*a).total_cmp(&squares(*b)))?;
    let refined = least(near - step, near + step, REFINEMENTS, squares);
    // At a bound the least value is on it, and not beside it.
    let best = match squares(refined) <= squares(near) {
        true => refined,
        false => near,
    };
    let mut fit = with_best_factor(exponent(best), limit, &points, lowest)?;
    fit.rms_m_s = (fit.squares(&points) / points.len() as f64).sqrt();
    Some(fit)
}

/// Impact and residual velocities of points with a residual velocity.
fn above_limit(curve: &[CurvePoint]) -> Vec<(f64, f64)> {
    curve
        .iter()
        .map(|point| (point.impact_velocity_m_s, point.residual_velocity_m_s))
        .filter(|(_, residual)| *residual > 0.0)
        .collect()
}

/// The curve of an exponent and a limit with the factor that suits points best.
fn with_best_factor(
    p: f64,
    limit: f64,
    points: &[(f64, f64)],
    lowest: f64,
) -> Option<LambertJonasFit> {
    let unit = LambertJonasFit::with([1.0, p, limit], lowest)?;
    let (mut product, mut square) = (0.0, 0.0);
    for (velocity, residual) in points {
        product += unit.at(*velocity) * residual;
        square += unit.at(*velocity).powi(2);
    }
    let a = (product / square).clamp(*FACTORS.start(), *FACTORS.end());
    LambertJonasFit::with([a, p, limit], lowest)
}

/// The best of a few curves with p = 2 and the factor that suits each of them best.
fn start(points: &[(f64, f64)], lowest: f64) -> Option<LambertJonasFit> {
    let candidates = [0.5, 0.8, 0.95, 0.999].into_iter();
    let candidates =
        candidates.filter_map(|part| with_best_factor(2.0, part * lowest, points, lowest));
    candidates.min_by(|a, b| a.squares(points).total_cmp(&b.squares(points)))
}
