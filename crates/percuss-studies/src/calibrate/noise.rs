//! Standard deviation of a measured value about the model.

use std::str::FromStr;

use serde::Serialize;

use crate::bisection::bisect_ratio;

/// Scatter of measured values about the model: Gaussian and, but for the points of a curve, independent.
///
/// The variance of a value is `u² + (s c)²`: u is its stated standard deviation, 0 where there is none; s is a relative scatter that
/// stands for test and model alike; c is the measured value, or the impact velocity for a residual velocity. Where the model is corrected
/// to axisymmetric answers, their discretisation uncertainty counts to u. Points of a curve are correlated in time: c is the root mean
/// square of the curve, and a point counts as tanh(Δ/2τ) independent values for its time Δ and the correlation time τ.
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

/// How a measured number is distributed about the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spread {
    /// Its stated standard deviation; 0 without one.
    pub(super) stated: f64,
    /// What a relative scatter is a part of.
    pub(super) scale: f64,
    /// How many independent numbers it counts as: 1, and less for a point of a curve.
    pub(super) weight: f64,
}

impl Spread {
    /// Standard deviation for a relative scatter.
    pub(super) fn deviation(&self, scatter: f64) -> f64 {
        self.stated.hypot(scatter * self.scale)
    }

    /// A difference from the model over its standard deviation, such that its square counts as many numbers as it stands for.
    pub(super) fn residual(&self, difference: f64, scatter: f64) -> f64 {
        difference / self.deviation(scatter) * self.weight.sqrt()
    }

    /// Logarithm of the likelihood of a difference, up to a constant.
    pub(super) fn ln_likelihood(&self, difference: f64, scatter: f64) -> f64 {
        let deviation = self.deviation(scatter);
        self.weight * (-0.5 * (difference / deviation).powi(2) - deviation.ln())
    }
}

/// How many independent numbers some count as.
pub(super) fn independent(spreads: &[Spread]) -> f64 {
    spreads.iter().map(|spread| spread.weight).sum()
}

/// The scatter with which residuals (model less measured) have as many standard deviations, squared and summed, as there are degrees
/// of freedom: `Σ w r²/(u² + (s c)²) = degrees`. The least of [`SCATTER`] where stated deviations alone explain them.
pub(super) fn scatter_of(differences: &[f64], spreads: &[Spread], degrees: f64) -> f64 {
    let excess = |scatter: f64| {
        let square =
            |(difference, spread): (&f64, &Spread)| spread.residual(*difference, scatter).powi(2);
        differences.iter().zip(spreads).map(square).sum::<f64>() > degrees
    };
    let (least, most) = SCATTER;
    match excess(least) {
        true => bisect_ratio(least, most, 100, excess).1,
        false => least,
    }
}
