//! Least squares within bounds: Levenberg and Marquardt's method \[more1978\] with derivatives by central differences.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, storage::Owned};
use rayon::prelude::*;

/// Step of a derivative, as a part of the range of its parameter.
const STEP: f64 = 1e-4;
/// What stands for each residual where the model fails: more than any that a model gives, so that the step is taken back.
const FAILED: f64 = 1e6;

/// Why there are no residuals.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Unable {
    /// The model fails with these values.
    Failed,
    /// The caller ended it.
    Stopped,
}

/// Residuals of values, each over its standard deviation.
pub(super) type Residuals<'a> = &'a (dyn Fn(&[f64]) -> Result<Vec<f64>, Unable> + Sync);

/// Where a parameter may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Bounds {
    pub(super) fn width(self) -> f64 {
        self.high - self.low
    }

    /// The value that a free number stands for, `x = (low + high)/2 + (high − low)/2 sin t`, and `dx/dt`.
    fn inside(self, t: f64) -> (f64, f64) {
        let (middle, half) = (0.5 * (self.low + self.high), 0.5 * self.width());
        let x = middle + half * t.sin();
        (x.clamp(self.low, self.high), half * t.cos())
    }

    fn free(self, x: f64) -> f64 {
        let part = 2.0 * (x - self.low) / self.width() - 1.0;
        // At a bound the derivative vanishes, and nothing would lead away from it.
        part.clamp(-0.999, 0.999).asin()
    }
}

/// The minimum that was found from a start.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Minimum {
    pub(super) values: Vec<f64>,
    /// Sum of the squared residuals.
    pub(super) sum_of_squares: f64,
    pub(super) converged: bool,
}

/// Looks for the values with the smallest sum of squared residuals.
///
/// # Errors
/// [`Unable::Failed`] when the model fails at the start, [`Unable::Stopped`].
pub(super) fn minimise(
    residuals: Residuals<'_>,
    bounds: &[Bounds],
    start: &[f64],
) -> Result<Minimum, Unable> {
    let count = residuals(start)?.len();
    let free = start.iter().zip(bounds).map(|(x, bounds)| bounds.free(*x));
    let problem = Problem {
        residuals,
        bounds,
        count,
        free: DVector::from_iterator(start.len(), free),
    };
    let (problem, report) = LevenbergMarquardt::new()
        .with_tol(1e-13)
        .with_patience(50)
        .minimize(problem);
    let values = problem.values();
    let found = residuals(&values)?;
    Ok(Minimum {
        values,
        sum_of_squares: found.iter().map(|r| r * r).sum(),
        converged: report.termination.was_successful(),
    })
}

/// Derivatives of the residuals with respect to the values, one row per residual.
///
/// # Errors
/// Those of the residuals, at values so close that the model should not fail there.
pub(super) fn jacobian(
    residuals: Residuals<'_>,
    bounds: &[Bounds],
    values: &[f64],
) -> Result<DMatrix<f64>, Unable> {
    let column = |(i, bounds): (usize, &Bounds)| {
        let step = STEP * bounds.width();
        let at = |x: f64| {
            let mut values = values.to_vec();
            values[i] = x.clamp(bounds.low, bounds.high);
            residuals(&values).map(|found| (values[i], found))
        };
        let ((low, below), (high, above)) = (at(values[i] - step)?, at(values[i] + step)?);
        let slope = |(below, above): (f64, f64)| (above - below) / (high - low);
        Ok(DVector::from_vec(
            below.into_iter().zip(above).map(slope).collect(),
        ))
    };
    let columns: Vec<DVector<f64>> = bounds
        .par_iter()
        .enumerate()
        .map(column)
        .collect::<Result<_, _>>()?;
    Ok(DMatrix::from_columns(&columns))
}

struct Problem<'a> {
    residuals: Residuals<'a>,
    bounds: &'a [Bounds],
    count: usize,
    free: DVector<f64>,
}

impl Problem<'_> {
    fn values(&self) -> Vec<f64> {
        let inside = |(t, bounds): (&f64, &Bounds)| bounds.inside(*t).0;
        self.free.iter().zip(self.bounds).map(inside).collect()
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, free: &DVector<f64>) {
        self.free.copy_from(free);
    }

    fn params(&self) -> DVector<f64> {
        self.free.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        match (self.residuals)(&self.values()) {
            Ok(found) => Some(DVector::from_vec(found)),
            Err(Unable::Failed) => Some(DVector::from_element(self.count, FAILED)),
            Err(Unable::Stopped) => None,
        }
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let mut slopes = jacobian(self.residuals, self.bounds, &self.values()).ok()?;
        for (i, bounds) in self.bounds.iter().enumerate() {
            let chain = bounds.inside(self.free[i]).1;
            slopes.column_mut(i).scale_mut(chain);
        }
        Some(slopes)
    }
}
