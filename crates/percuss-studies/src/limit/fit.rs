//! The curve `v_r = a (v^p − v_bl^p)^(1/p)` of Lambert and Jonas through residual velocities, by least squares.

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
const ITERATIONS: usize = 500;
/// Fewest points that two numbers are fitted to.
const FEWEST_AT_LIMIT: usize = 3;
/// Intervals of ln p that are searched for the least sum of squares, and steps that refine it.
const INTERVALS: u32 = 48;
const REFINEMENTS: u32 = 60;
/// Relative change of the sum of squares that ends the iteration.
const CONVERGED: f64 = 1e-15;

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

/// Fits the curve with a free limit to points above it, by the method of Levenberg and Marquardt; `None` for fewer than four points with a
/// residual velocity, or points that no such curve follows.
pub fn fit_lambert_jonas(curve: &[CurvePoint]) -> Option<LambertJonasFit> {
    let points = above_limit(curve);
    if points.len() < FEWEST {
        return None;
    }
    let lowest = points.iter().map(|point| point.0).reduce(f64::min)?;
    let mut fit = start(&points, lowest)?;
    let mut squares = fit.squares(&points);
    let mut damping = 1e-3;
    for _ in 0..ITERATIONS {
        let step = damped_step(&fit, &points, damping);
        let numbers = fit.numbers();
        let moved = step.map(|step| std::array::from_fn(|i| numbers[i] + step[i]));
        let trial = moved.and_then(|numbers| LambertJonasFit::with(numbers, lowest));
        match trial.map(|trial| (trial, trial.squares(&points))) {
            Some((trial, less)) if less < squares => {
                let change = (squares - less) / squares;
                (fit, squares) = (trial, less);
                damping = (0.1 * damping).max(1e-15);
                if change < CONVERGED {
                    break;
                }
            }
            _ if damping > 1e12 => break,
            _ => damping *= 10.0,
        }
    }
    fit.rms_m_s = (squares / points.len() as f64).sqrt();
    Some(fit)
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

/// Step of the method: the normal equations with their diagonal enlarged by a part.
fn damped_step(fit: &LambertJonasFit, points: &[(f64, f64)], damping: f64) -> Option<[f64; 3]> {
    let (mut matrix, mut right) = ([[0.0; 3]; 3], [0.0; 3]);
    for (velocity, residual) in points {
        let slopes = fit.slopes(*velocity);
        for i in 0..3 {
            right[i] += slopes[i] * (residual - fit.at(*velocity));
            for j in 0..3 {
                matrix[i][j] += slopes[i] * slopes[j];
            }
        }
    }
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] *= 1.0 + damping;
    }
    solve(matrix, right)
}

/// Solution of three linear equations by elimination with pivots; `None` for a singular matrix.
fn solve(mut matrix: [[f64; 3]; 3], mut right: [f64; 3]) -> Option<[f64; 3]> {
    for i in 0..3 {
        let pivot = (i..3).max_by(|a, b| matrix[*a][i].abs().total_cmp(&matrix[*b][i].abs()))?;
        matrix.swap(i, pivot);
        right.swap(i, pivot);
        if matrix[i][i] == 0.0 || !matrix[i][i].is_finite() {
            return None;
        }
        let (above, below) = matrix.split_at_mut(i + 1);
        let pivot = above[i];
        for (k, row) in below.iter_mut().enumerate() {
            let factor = row[i] / pivot[i];
            for (entry, of_pivot) in row.iter_mut().zip(pivot) {
                *entry -= factor * of_pivot;
            }
            right[i + 1 + k] -= factor * right[i];
        }
    }
    let mut solution = [0.0; 3];
    for i in (0..3).rev() {
        let known: f64 = (i + 1..3).map(|j| matrix[i][j] * solution[j]).sum();
        solution[i] = (right[i] - known) / matrix[i][i];
    }
    Some(solution)
}
