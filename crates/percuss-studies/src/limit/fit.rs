//! The curve `v_r = a (v^p − v_bl^p)^(1/p)` of Lambert and Jonas through residual velocities, by least squares.

use serde::Serialize;

use super::CurvePoint;

/// The curve with its three numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LambertJonasFit {
    /// Factor a.
    pub a: f64,
    /// Exponent p.
    pub p: f64,
    /// Ballistic limit [m/s].
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

/// Fits the curve to points above the limit, by the method of Levenberg and Marquardt; `None` for fewer than four points with a
/// residual velocity, or points that no such curve follows.
pub fn fit_lambert_jonas(curve: &[CurvePoint]) -> Option<LambertJonasFit> {
    let points: Vec<(f64, f64)> = curve
        .iter()
        .map(|point| (point.impact_velocity_m_s, point.residual_velocity_m_s))
        .filter(|(_, residual)| *residual > 0.0)
        .collect();
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

/// The best of a few curves with p = 2 and the factor that suits each of them best.
fn start(points: &[(f64, f64)], lowest: f64) -> Option<LambertJonasFit> {
    let candidates = [0.5, 0.8, 0.95, 0.999].into_iter().filter_map(|part| {
        let unit = LambertJonasFit::with([1.0, 2.0, part * lowest], lowest)?;
        let (mut product, mut square) = (0.0, 0.0);
        for (velocity, residual) in points {
            product += unit.at(*velocity) * residual;
            square += unit.at(*velocity).powi(2);
        }
        let a = (product / square).clamp(*FACTORS.start(), *FACTORS.end());
        LambertJonasFit::with([a, 2.0, part * lowest], lowest)
    });
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
