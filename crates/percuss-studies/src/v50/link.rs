//! The two distributions of the velocity that a test needs.

use std::f64::consts::PI;

use super::Method;
use crate::inputs::normal_probability;

/// A distribution with the median 0; both are symmetric.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Link {
    /// The normal distribution of standard deviation 1.
    Probit,
    /// The logistic distribution of scale 1.
    Logit,
}

/// Argument below which the tail of the normal distribution is computed from its asymptotic series: accurate to 1e-9 there.
const FAR: f64 = -20.0;

impl Link {
    pub(super) fn method(self) -> Method {
        match self {
            Self::Probit => Method::Probit,
            Self::Logit => Method::Logit,
        }
    }

    /// Standard deviation of the distribution.
    pub(super) fn standard_deviation(self) -> f64 {
        match self {
            Self::Probit => 1.0,
            Self::Logit => PI / 3.0_f64.sqrt(),
        }
    }

    /// F(z).
    pub(super) fn probability(self, z: f64) -> f64 {
        match self {
            Self::Probit => normal_probability(z),
            Self::Logit => 1.0 / (1.0 + (-z).exp()),
        }
    }

    /// ln F(z).
    pub(super) fn log_probability(self, z: f64) -> f64 {
        match self {
            Self::Probit if z < FAR => {
                -0.5 * z * z - (-z).ln() - 0.5 * (2.0 * PI).ln() + tail(z).ln()
            }
            Self::Probit => self.probability(z).ln(),
            Self::Logit if z < 0.0 => z - z.exp().ln_1p(),
            Self::Logit => -(-z).exp().ln_1p(),
        }
    }

    /// First derivative of ln F at z, and minus its second one: both are positive.
    pub(super) fn slopes(self, z: f64) -> (f64, f64) {
        match self {
            Self::Probit => {
                let slope = if z < FAR {
                    -z / tail(z)
                } else {
                    (-0.5 * z * z).exp() / (2.0 * PI).sqrt() / self.probability(z)
                };
                (slope, slope * (slope + z))
            }
            Self::Logit => {
                let rest = self.probability(-z);
                (rest, rest * self.probability(z))
            }
        }
    }
}

/// `F(z) |z|/f(z)` of the normal distribution far below its mean: `1 − 1/z² + 3/z⁴ − 15/z⁶ + …`
fn tail(z: f64) -> f64 {
    let t = 1.0 / (z * z);
    1.0 - t * (1.0 - t * (3.0 - t * (15.0 - 105.0 * t)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_logarithm() {
        for link in [Link::Probit, Link::Logit] {
            for z in [-30.0, -20.5, -19.5, -8.0, -1.0, 0.0, 0.3, 2.0, 6.0] {
                let h = 1e-4;
                let at = |z| link.log_probability(z);
                let (slope, curvature) = link.slopes(z);
                let numeric = (at(z + h) - at(z - h)) / (2.0 * h);
                assert!(
                    (slope - numeric).abs() <= 1e-6 * slope.abs().max(1e-3),
                    "{link:?} {z}"
                );
                let numeric = (link.slopes(z - h).0 - link.slopes(z + h).0) / (2.0 * h);
                assert!(
                    (curvature - numeric).abs() <= 1e-5 * curvature.max(1e-2),
                    "{link:?} {z}"
                );
            }
        }
    }

    #[test]
    fn known_values_are_met_and_the_tail_joins() {
        assert!((Link::Probit.probability(1.959_963_985) - 0.975).abs() < 1e-9);
        assert!((Link::Logit.probability(3.0_f64.ln()) - 0.75).abs() < 1e-15);
        let joint =
            |link: Link| link.log_probability(FAR - 1e-9) - link.log_probability(FAR + 1e-9);
        assert!(joint(Link::Probit).abs() < 1e-6);
    }
}
