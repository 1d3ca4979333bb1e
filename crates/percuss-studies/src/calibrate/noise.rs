//! Standard deviation of a measured value about the model.

use std::str::FromStr;

use serde::Serialize;

use super::Observation;

/// Scatter of measured values about the model, Gaussian and independent.
///
/// The variance of a value is `u² + (s c)²`: u is its stated standard deviation, 0 where there is none; s is a relative scatter that
/// stands for test and model alike; c is the measured value, or the impact velocity for a residual velocity. Where the model is corrected
/// to axisymmetric answers, their discretisation uncertainty counts to u.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Noise {
    /// s is estimated with the other parameters; it is evenly likely in its logarithm beforehand.
    Estimated,
    /// s is given.
    Relative(f64),
    /// s is 0, and every value has a stated standard deviation.
    Stated,
}

/// Smallest and largest scatter that is estimated.
pub(super) const SCATTER: (f64, f64) = (1e-6, 1.0);

impl Noise {
    /// Scatter that is not estimated.
    pub(super) fn given(self) -> Option<f64> {
        match self {
            Self::Estimated => None,
            Self::Relative(scatter) => Some(scatter),
            Self::Stated => Some(0.0),
        }
    }
}

impl FromStr for Noise {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.trim() {
            "estimated" => Ok(Self::Estimated),
            "stated" => Ok(Self::Stated),
            part => part
                .strip_suffix('%')
                .and_then(|number| number.trim().parse::<f64>().ok())
                .map(|percent| percent / 100.0)
                .filter(|part| (1e-6..=1.0).contains(part))
                .map(Self::Relative)
                .ok_or("allowed: estimated, stated, or a part such as \"2 %\", up to 100 %"),
        }
    }
}

/// Standard deviation of a measured value for a relative scatter [m or m/s].
pub(super) fn deviation(observation: &Observation, scatter: f64) -> f64 {
    let stated = observation.uncertainty.unwrap_or(0.0);
    let of_meshes = observation.correction.map_or(0.0, |c| c.first.uncertainty);
    stated.hypot(of_meshes).hypot(scatter * observation.scale())
}

/// The scatter with which residuals (model less measured) have as many standard deviations, squared and summed, as there are degrees
/// of freedom: `Σ r²/(u² + (s c)²) = degrees`. The least of [`SCATTER`] where stated deviations alone explain them.
pub(super) fn scatter_of(residuals: &[(f64, &Observation)], degrees: f64) -> f64 {
    let excess = |scatter: f64| {
        let square = |(residual, observation): &(f64, &Observation)| {
            (residual / deviation(observation, scatter)).powi(2)
        };
        residuals.iter().map(square).sum::<f64>() > degrees
    };
    let (mut low, mut high) = SCATTER;
    if !excess(low) {
        return low;
    }
    for _ in 0..100 {
        let middle = (low * high).sqrt();
        if excess(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
