//! Statistics of relative errors.

use serde::Serialize;

use crate::statistics::{quantile, sorted};

/// Statistics of relative errors `(predicted − measured)/measured`; they are plain numbers, 0.1 for 10 %.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Errors {
    /// How many errors.
    pub count: usize,
    /// Their mean: positive where the model gives too much.
    pub bias: f64,
    /// Root of the mean of their squares.
    pub rms: f64,
    /// Median of their magnitudes.
    pub median_absolute: f64,
    /// The error of largest magnitude.
    pub worst: f64,
    /// Id of the test that has it; the first one of several.
    pub worst_id: String,
}

impl Errors {
    /// Statistics of errors and the ids of their tests; `None` where there are none.
    pub fn of<'a>(errors: impl IntoIterator<Item = (f64, &'a str)>) -> Option<Self> {
        let errors: Vec<(f64, &str)> = errors.into_iter().collect();
        let count = errors.len();
        let mean = |of: &dyn Fn(f64) -> f64| {
            errors.iter().map(|(error, _)| of(*error)).sum::<f64>() / count as f64
        };
        let (worst, worst_id) = errors.iter().copied().reduce(|worst, next| {
            if next.0.abs() > worst.0.abs() {
                next
            } else {
                worst
            }
        })?;
        let magnitudes = sorted(errors.iter().map(|(error, _)| error.abs()));
        Some(Self {
            count,
            bias: mean(&|error| error),
            rms: mean(&|error| error * error).sqrt(),
            median_absolute: quantile(&magnitudes, 0.5),
            worst,
            worst_id: worst_id.to_owned(),
        })
    }
}
