//! Distributions by their quantile functions.

use std::{
    f64::consts::{FRAC_1_SQRT_2, PI},
    fmt,
};

use crate::units::significant;

/// A distribution of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Distribution {
    Normal {
        mean: f64,
        deviation: f64,
        cut: Cut,
    },
    /// The logarithm is normal; `deviation` is that of the logarithm.
    Lognormal {
        median: f64,
        deviation: f64,
        cut: Cut,
    },
    Uniform {
        from: f64,
        to: f64,
    },
    Triangular {
        from: f64,
        mode: f64,
        to: f64,
    },
}

/// Where a distribution is cut off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cut {
    pub(super) min: f64,
    pub(super) max: f64,
}

impl Cut {
    /// None at all.
    pub(super) const NONE: Self = Self {
        min: f64::NEG_INFINITY,
        max: f64::INFINITY,
    };
}

impl Distribution {
    /// The value that a number stays below with chance `u`, between 0 and 1.
    pub(super) fn quantile(&self, u: f64) -> f64 {
        match *self {
            Self::Normal {
                mean,
                deviation,
                cut,
            } => {
                let score = |x: f64| (x - mean) / deviation;
                let z = truncated(u, score(cut.min), score(cut.max));
                (mean + deviation * z).clamp(cut.min, cut.max)
            }
            Self::Lognormal {
                median,
                deviation,
                cut,
            } => {
                let score = |x: f64| libm::log(x.max(0.0) / median) / deviation;
                let z = truncated(u, score(cut.min), score(cut.max));
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

    /// The value at a normal score: the quantile at the chance of staying below that score.
    pub(super) fn at_score(&self, z: f64) -> f64 {
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
            // The chance of a high score rounds to 1, which has no finite quantile.
            _ => self.quantile(chance(z).clamp(f64::MIN_POSITIVE, 1.0 - 0.5 * f64::EPSILON)),
        }
    }

    /// Standard deviation of a normal distribution that is not cut off.
    pub(super) fn normal_deviation(&self) -> Option<f64> {
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
    pub(super) fn part_left(&self) -> f64 {
        let between = |low: f64, high: f64| chance(high) - chance(low);
        match *self {
            Self::Normal {
                mean,
                deviation,
                cut,
            } => between((cut.min - mean) / deviation, (cut.max - mean) / deviation),
            Self::Lognormal {
                median,
                deviation,
                cut,
            } => {
                let score = |x: f64| libm::log(x.max(0.0) / median) / deviation;
                between(score(cut.min), score(cut.max))
            }
            Self::Uniform { .. } | Self::Triangular { .. } => 1.0,
        }
    }
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |value: f64| significant(value, 6);
        match *self {
            Self::Normal {
                mean,
                deviation,
                cut,
            } => write!(f, "normal{cut}, {} ± {}", number(mean), number(deviation)),
            Self::Lognormal {
                median,
                deviation,
                cut,
            } => write!(
                f,
                "lognormal{cut}, {} ± {} %",
                number(median),
                // The factor of one standard deviation.
                significant(100.0 * libm::expm1(deviation), 3)
            ),
            Self::Uniform { from, to } => write!(f, "uniform, {} … {}", number(from), number(to)),
            Self::Triangular { from, mode, to } => write!(
                f,
                "triangular, {} … {} … {}",
                number(from),
                number(mode),
                number(to)
            ),
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
    let (below, above) = (chance(low), chance(high));
    score(below + u * (above - below))
}

/// Standard normal distribution function.
fn chance(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Quantile of the standard normal distribution: the rational estimate 26.2.23 of Abramowitz and Stegun, made exact by three of
/// Halley's steps.
pub(super) fn score(u: f64) -> f64 {
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
        let step = (chance(z) - tail) * (2.0 * PI).sqrt() * libm::exp(0.5 * z * z);
        z -= step / (1.0 + 0.5 * z * step);
    }
    if u < 0.5 { z } else { -z }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNCUT: Cut = Cut::NONE;

    #[test]
    fn normal_scores_are_the_tabled_ones() {
        for (u, z) in [
            (0.5, 0.0),
            (0.841_344_746_068_542_9, 1.0),
            (0.975, 1.959_963_984_540_054),
            (0.995, 2.575_829_303_548_900_4),
            (0.001, -3.090_232_306_167_813_5),
            (1e-9, -5.997_807_015_007_686),
        ] {
            assert!((score(u) - z).abs() < 1e-14 * (1.0 + z.abs()) * 4.0, "{u}");
        }
        for i in 1..2000 {
            let u = f64::from(i) / 2000.0;
            assert!((chance(score(u)) / u - 1.0).abs() < 1e-14, "{u}");
            // 1 - u is rounded.
            assert!((score(u) + score(1.0 - u)).abs() < 1e-12, "{u}");
        }
        let smallest = 2_f64.powi(-53);
        assert!((chance(score(smallest)) / smallest - 1.0).abs() < 1e-12);
    }

    #[test]
    fn quantiles_invert_their_distribution_functions() {
        let normal = Distribution::Normal {
            mean: 230.0,
            deviation: 5.0,
            cut: UNCUT,
        };
        let lognormal = Distribution::Lognormal {
            median: 2.7,
            deviation: 0.2,
            cut: UNCUT,
        };
        let uniform = Distribution::Uniform {
            from: -1.0,
            to: 3.0,
        };
        let triangular = Distribution::Triangular {
            from: 1.0,
            mode: 2.0,
            to: 5.0,
        };
        for i in 1..100 {
            let u = f64::from(i) / 100.0;
            let close = |found: f64| assert!((found - u).abs() < 1e-13, "{found} {u}");
            close(chance((normal.quantile(u) - 230.0) / 5.0));
            close(chance((lognormal.quantile(u) / 2.7).ln() / 0.2));
            close((uniform.quantile(u) + 1.0) / 4.0);
            let x = triangular.quantile(u);
            close(if x < 2.0 {
                (x - 1.0).powi(2) / 4.0
            } else {
                1.0 - (5.0 - x).powi(2) / 12.0
            });
        }
        assert_eq!(triangular.quantile(0.25), 2.0);
    }

    #[test]
    fn a_cut_distribution_stays_inside_and_keeps_its_shape() {
        let cut = Cut { min: 1.0, max: 3.5 };
        let normal = Distribution::Normal {
            mean: 2.0,
            deviation: 1.0,
            cut,
        };
        let left = chance(1.5) - chance(-1.0);
        assert!((normal.part_left() - left).abs() < 1e-15);
        for i in 0..=1000 {
            let u = f64::from(i) / 1000.0;
            let x = normal.quantile(u);
            assert!((1.0..=3.5).contains(&x), "{x}");
            assert!(((chance(x - 2.0) - chance(-1.0)) / left - u).abs() < 1e-13);
        }
        let lognormal = Distribution::Lognormal {
            median: 2.0,
            deviation: 0.5,
            cut: Cut {
                min: f64::NEG_INFINITY,
                max: 2.0,
            },
        };
        assert!((lognormal.part_left() - 0.5).abs() < 1e-15);
        assert!((lognormal.quantile(0.5) - 2.0 * (0.5 * score(0.25)).exp()).abs() < 1e-14);
    }

    /// Mean and variance by the midpoint rule against their closed forms.
    #[test]
    fn moments_are_the_closed_forms() {
        let moments = |distribution: Distribution| {
            let count = 200_000;
            let at = |i: i32| distribution.quantile((f64::from(i) + 0.5) / f64::from(count));
            let mean = (0..count).map(at).sum::<f64>() / f64::from(count);
            let square = (0..count).map(|i| at(i).powi(2)).sum::<f64>() / f64::from(count);
            (mean, square - mean * mean)
        };
        let (mean, variance) = moments(Distribution::Triangular {
            from: 0.0,
            mode: 1.0,
            to: 4.0,
        });
        assert!((mean - 5.0 / 3.0).abs() < 1e-6 && (variance - 13.0 / 18.0).abs() < 1e-6);
        let (mean, variance) = moments(Distribution::Lognormal {
            median: 1.0,
            deviation: 0.25,
            cut: UNCUT,
        });
        let s2: f64 = 0.0625;
        assert!((mean / (s2 / 2.0).exp() - 1.0).abs() < 1e-5, "{mean}");
        let exact = (s2.exp() - 1.0) * s2.exp();
        assert!((variance / exact - 1.0).abs() < 1e-3, "{variance}");
    }
}
