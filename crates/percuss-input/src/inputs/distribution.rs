//! Distributions by their quantile functions.

use std::{
    f64::consts::{FRAC_1_SQRT_2, PI},
    fmt,
};

use crate::units::significant;

/// A distribution of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// Normal distribution.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
        /// Limits.
        cut: Cut,
    },
    /// Normal distribution of the logarithm.
    Lognormal {
        /// Median.
        median: f64,
        /// Standard deviation of the logarithm.
        deviation: f64,
        /// Limits.
        cut: Cut,
    },
    /// Uniform distribution.
    Uniform {
        /// Lower limit.
        from: f64,
        /// Upper limit.
        to: f64,
    },
    /// Triangular distribution.
    Triangular {
        /// Lower limit.
        from: f64,
        /// Most probable value.
        mode: f64,
        /// Upper limit.
        to: f64,
    },
}

/// Where a distribution is cut off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    pub(crate) min: f64,
    pub(crate) max: f64,
}

impl Cut {
    /// None at all.
    pub const NONE: Self = Self {
        min: f64::NEG_INFINITY,
        max: f64::INFINITY,
    };
}

impl Distribution {
    /// The value that a number stays below with probability `u`, between 0 and 1.
    pub fn quantile(&self, u: f64) -> f64 {
        match *self {
            Self::Normal {
                mean,
                deviation,
                cut,
            } => {
                let z = truncated(u, self.score(cut.min), self.score(cut.max));
                (mean + deviation * z).clamp(cut.min, cut.max)
            }
            Self::Lognormal {
                median,
                deviation,
                cut,
            } => {
                let z = truncated(u, self.score(cut.min), self.score(cut.max));
                (median * libm::exp(deviation * z)).clamp(cut.min, cut.max)
            }
            Self::Uniform { from, to } => from + u * (to - from),
            Self::Triangular { from, mode, to } => {
                let rising = (mode - from) / (to - from);
                if u < rising {
                    from + (u * (to - from) * (mode - from)).sqrt()
                } else {
                    to - ((1.0 - u) * (to - from) * (to - mode)).sqrt()
                }
            }
        }
    }

    /// The value at a normal score: the quantile at the probability of staying below that score.
    pub fn at_score(&self, z: f64) -> f64 {
        match *self {
            // Straight, so that normal parameters of normal scores are exactly normal.
            Self::Normal {
                mean,
                deviation,
                cut: Cut::NONE,
            } => mean + deviation * z,
            Self::Lognormal {
                median,
                deviation,
                cut: Cut::NONE,
            } => median * libm::exp(deviation * z),
            // The probability of a high score rounds to 1, which has no finite quantile.
            _ => self
                .quantile(normal_probability(z).clamp(f64::MIN_POSITIVE, 1.0 - 0.5 * f64::EPSILON)),
        }
    }

    /// Standard deviation of a normal distribution that is not cut off.
    pub fn normal_deviation(&self) -> Option<f64> {
        match *self {
            Self::Normal {
                deviation,
                cut: Cut::NONE,
                ..
            } => Some(deviation),
            _ => None,
        }
    }

    /// Part of the distribution that its cut leaves.
    pub fn part_left(&self) -> f64 {
        let below = |x: f64| normal_probability(self.score(x));
        match *self {
            Self::Normal { cut, .. } | Self::Lognormal { cut, .. } => {
                below(cut.max) - below(cut.min)
            }
            Self::Uniform { .. } | Self::Triangular { .. } => 1.0,
        }
    }
}

impl Distribution {
    /// It in words, such as `normal, 230 ± 3 m/s`; the unit may be empty.
    pub fn describe(&self, unit: &str) -> String {
        let number = |value: f64| significant(value, 6);
        let words = match *self {
            Self::Normal {
                mean,
                deviation,
                cut,
            } => format!(
                "normal{cut}, {} ± {} {unit}",
                number(mean),
                number(deviation)
            ),
            Self::Lognormal {
                median,
                deviation,
                cut,
            } => {
                // The factor of one standard deviation.
                let percent = significant(100.0 * libm::expm1(deviation), 3);
                let median = format!("{} {unit}", number(median));
                format!("lognormal{cut}, {} ± {percent} %", median.trim_end())
            }
            Self::Uniform { from, to } => {
                format!("uniform, {} … {} {unit}", number(from), number(to))
            }
            Self::Triangular { from, mode, to } => {
                let [from, mode, to] = [from, mode, to].map(number);
                format!("triangular, {from} … {mode} … {to} {unit}")
            }
        };
        words.trim_end().to_owned()
    }
}

/// Standard deviations beyond which a normal distribution has next to nothing.
const FARTHEST: f64 = 8.0;

impl Distribution {
    /// Logarithm of the density, up to a constant; minus infinity outside.
    pub fn ln_density(&self, x: f64) -> f64 {
        let (low, high) = self.support();
        if !(low..=high).contains(&x) {
            return f64::NEG_INFINITY;
        }
        match *self {
            Self::Normal { .. } => -0.5 * self.score(x).powi(2),
            Self::Lognormal { .. } => -0.5 * self.score(x).powi(2) - libm::log(x),
            Self::Uniform { .. } => 0.0,
            Self::Triangular { from, mode, to } if x < mode => {
                libm::log((x - from) / (mode - from)) - libm::log(to - from)
            }
            Self::Triangular { mode, to, from } if x > mode => {
                libm::log((to - x) / (to - mode)) - libm::log(to - from)
            }
            Self::Triangular { from, to, .. } => -libm::log(to - from),
        }
    }

    /// Standard deviations of a normal distribution, or of the logarithm of a lognormal one, from its middle; 0 for others.
    pub fn score(&self, x: f64) -> f64 {
        match *self {
            Self::Normal {
                mean, deviation, ..
            } => (x - mean) / deviation,
            Self::Lognormal {
                median, deviation, ..
            } => libm::log(x.max(0.0) / median) / deviation,
            Self::Uniform { .. } | Self::Triangular { .. } => 0.0,
        }
    }

    /// Where it is, except for a negligible part.
    pub fn support(&self) -> (f64, f64) {
        match *self {
            Self::Normal {
                mean,
                deviation,
                cut,
            } => (
                cut.min.max(mean - FARTHEST * deviation),
                cut.max.min(mean + FARTHEST * deviation),
            ),
            Self::Lognormal {
                median,
                deviation,
                cut,
            } => (
                cut.min.max(median * libm::exp(-FARTHEST * deviation)),
                cut.max.min(median * libm::exp(FARTHEST * deviation)),
            ),
            Self::Uniform { from, to } | Self::Triangular { from, to, .. } => (from, to),
        }
    }
}

impl fmt::Display for Cut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |value: f64| significant(value, 6);
        match (self.min.is_finite(), self.max.is_finite()) {
            (false, false) => Ok(()),
            (true, false) => write!(f, " from {} up", number(self.min)),
            (false, true) => write!(f, " up to {}", number(self.max)),
            (true, true) => write!(f, " from {} to {}", number(self.min), number(self.max)),
        }
    }
}

/// Quantile of the standard normal distribution between two scores.
fn truncated(u: f64, low: f64, high: f64) -> f64 {
    let (below, above) = (normal_probability(low), normal_probability(high));
    score(below + u * (above - below))
}

/// Standard normal distribution function.
pub fn normal_probability(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Quantile of the standard normal distribution: the rational estimate 26.2.23 of Abramowitz and Stegun, made exact by three of
/// Halley's steps.
pub fn score(u: f64) -> f64 {
    let tail = u.min(1.0 - u);
    if tail <= 0.0 {
        return if u < 0.5 {
            f64::NEG_INFINITY
        } else {
            f64::INFINITY
        };
    }
    let t = (-2.0 * libm::log(tail)).sqrt();
    let top = 2.515517 + t * (0.802853 + t * 0.010328);
    let bottom = 1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308));
    let mut z = top / bottom - t;
    for _ in 0..3 {
        let step = (normal_probability(z) - tail) * (2.0 * PI).sqrt() * libm::exp(0.5 * z * z);
        z -= step / (1.0 + 0.5 * z * step);
    }
    if u < 0.5 { z } else { -z }
}

#[cfg(test)]
#[path = "distribution_tests.rs"]
mod tests;
