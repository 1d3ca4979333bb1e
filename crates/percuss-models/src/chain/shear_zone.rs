//! The zone of shear around the rim of a plug: what slip belongs to a strain of the rim.
//!
//! Along the axis equilibrium asks for `τ = τ_a r/a` inside a plug of radius a, whose slices accelerate as one, and `τ = τ_a a/r`
//! outside. A ring at that stress lags behind the rim as its hardening and its sensitivity to the rate say,
//! `dε/dε_a = exp{[F(ε_a) − F(ε) − ln(τ_a/τ)]/m}`, F being the logarithm of the adiabatic stress. The slip of the plug's mean motion against the plate is
//! `u = √3 [∫_a^∞ ε dr + ∫_0^a ε (r/a)² dr]`, so that `τ_a du` is the work of the zone.

use super::adiabatic::{AdiabaticCurve, Sheared};
use crate::bisection::bisected;

pub(super) const SQRT_3: f64 = 1.732_050_807_568_877_2;
/// Step of the rim's strain.
const STRAIN_STEP: f64 = 0.01;
/// Rings on each side of the rim, and the width of the first as a part of the radius.
const RINGS: usize = 50;
const FIRST_RING: f64 = 1e-4;
/// Outer radius of the zone over that of the plug: there the stress is a third of the rim's.
const OUTER_RADIUS: f64 = 3.0;
/// Smallest rate sensitivity that the rings resolve.
const LEAST_SENSITIVITY: f64 = 1e-4;
/// Section of a step to which the strain of a ring is found, and the most steps of a secant that is kept in its bracket.
const FOUND: f64 = 1e-7;
const MOST_ITERATIONS: u32 = 60;
/// Beyond it an exponential is nothing.
const LEAST_EXPONENT: f64 = -30.0;
/// The zone ends where it is narrower than this part of its width at the maximum: there heat conduction, left out here, would hold it apart.
const NARROWEST: f64 = 0.01;
/// A zone narrower than this part of the radius is no result but the rings'.
const LEAST_WIDTH: f64 = 1e-3;
/// Strain at which a metal without a maximum is evaluated.
const UNIT_STRAIN: f64 = 1.0;
/// Repetitions that settle the strain rate, which depends on the width itself, and the change that ends them.
const MOST_ROUNDS: u32 = 20;
const SETTLED: f64 = 1e-4;

/// How the shear of a band is spread around the rim of the plug.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Spread {
    /// Evenly over a width [m].
    Even(f64),
    /// As equilibrium, hardening and rate say.
    Zone(ShearZone),
}

/// The zone around a plug.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ShearZone {
    /// Radius of the plug [m].
    radius: f64,
    /// Slip per shear strain of the rim in each step of the rim's strain [m].
    widths: Vec<f64>,
    /// Slip over shear strain of the rim where the rim's stress is largest [m], or at unit strain where it has no maximum.
    mean_width: f64,
}

/// How far the rim is strained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// To its largest stress, which tells the mean width.
    ToMaximum,
    Whole,
}

/// A ring of the zone.
struct Ring {
    /// ln(τ_a/τ).
    below: f64,
    /// What its strain counts in the slip [m].
    weight: f64,
    strain: f64,
}

impl Spread {
    /// Slip over shear strain of the rim at its largest stress [m].
    pub(super) fn mean_width(&self) -> f64 {
        match self {
            Self::Even(width) => *width,
            Self::Zone(zone) => zone.mean_width,
        }
    }

    /// Elastic slip over the shear strain of the rim [m]. Around a zone that is the plug's own shear; the plate's is the plate's.
    pub(super) fn elastic_width(&self) -> f64 {
        match self {
            Self::Even(width) => *width,
            // ∫ (r/a)(r/a)² dr from 0 to a.
            Self::Zone(zone) => 0.25 * zone.radius,
        }
    }

    /// Further slip for a further plastic shear strain of the rim, at an equivalent plastic strain of the rim [m].
    pub(super) fn width(&self, strain: f64) -> f64 {
        match self {
            Self::Even(width) => *width,
            Self::Zone(zone) => {
                let last = zone.widths.len() - 1;
                zone.widths[((strain / STRAIN_STEP) as usize).min(last)]
            }
        }
    }
}

impl Sheared<'_> {
    /// The zone around a plug of a radius that starts with a speed, and the strain at which its rim is strongest; `None` where
    /// neither hardening nor the rate spreads it.
    pub(super) fn zone(&self, radius: f64, speed: f64) -> Option<(ShearZone, Option<f64>)> {
        let at = |width: f64, extent: Extent| {
            let rate = speed / (SQRT_3 * width);
            let curve = self.curve(rate);
            let zone = ShearZone::new(radius, &curve, self.rate_sensitivity(rate), extent);
            (zone, curve.instability())
        };
        let mut width = 0.1 * radius;
        if self.rate_effects {
            for _ in 0..MOST_ROUNDS {
                let (zone, _) = at(width, Extent::ToMaximum);
                let settled = (zone.mean_width / width - 1.0).abs() < SETTLED;
                width = zone.mean_width.max(LEAST_WIDTH * radius);
                if settled {
                    break;
                }
            }
        }
        let (zone, instability) = at(width, Extent::Whole);
        (zone.mean_width > LEAST_WIDTH * radius).then_some((zone, instability))
    }

    /// Strain at which the shear stress of an even band is largest.
    pub(super) fn instability(&self, width: f64, speed: f64) -> Option<f64> {
        self.curve(speed / (SQRT_3 * width)).instability()
    }
}

impl ShearZone {
    fn new(radius: f64, curve: &AdiabaticCurve, sensitivity: f64, extent: Extent) -> Self {
        let sensitivity = sensitivity.max(LEAST_SENSITIVITY);
        let mut rings = rings(radius);
        let classified = curve
            .instability()
            .unwrap_or_else(|| UNIT_STRAIN.min(curve.end()));
        let (mut widths, mut slip, mut mean_width) = (Vec::new(), 0.0, None);
        let steps = ((curve.end() / STRAIN_STEP) as usize).max(1);
        for i in 1..=steps {
            let rim = i as f64 * STRAIN_STEP;
            let mut further = 0.0;
            for ring in &mut rings {
                let before = ring.strain;
                ring.follow(rim, curve, sensitivity);
                further += ring.weight * (ring.strain - before);
            }
            let width = further / STRAIN_STEP;
            slip += SQRT_3 * further;
            if mean_width.is_none() && (rim >= classified || i == steps) {
                mean_width = Some(slip / (SQRT_3 * rim));
            }
            widths.push(width);
            if mean_width.is_some() && extent == Extent::ToMaximum {
                break;
            }
            if let Some(mean) = mean_width.filter(|mean| width < NARROWEST * mean) {
                widths[i - 1] = NARROWEST * mean;
                break;
            }
        }
        Self {
            radius,
            widths,
            mean_width: mean_width.unwrap_or_default(),
        }
    }
}

impl Ring {
    /// Lets the ring follow a further step of the rim, implicitly: what hardens relaxes to equilibrium faster than a step.
    fn follow(&mut self, rim: f64, curve: &AdiabaticCurve, sensitivity: f64) {
        let share = |strain: f64| {
            let excess = curve.logarithm(rim) - curve.logarithm(strain) - self.below;
            (excess / sensitivity).min(0.0)
        };
        // Nothing flows that would not flow at the least hardened.
        if share(self.strain) < LEAST_EXPONENT {
            return;
        }
        let lag = |part: f64| part - share(self.strain + part * STRAIN_STEP).exp();
        let (mut low, mut below) = (0.0, lag(0.0));
        let (mut high, mut above) = (1.0, lag(1.0));
        let mut kept = 0;
        for _ in 0..MOST_ITERATIONS {
            if high - low < FOUND || below == 0.0 || above == 0.0 {
                break;
            }
            let part = (low * above - high * below) / (above - below);
            let value = lag(part);
            if value.abs() < FOUND {
                (low, below, high, above) = (part, value, part, value);
            } else if value < 0.0 {
                (low, below) = (part, value);
                if kept == -1 {
                    above *= 0.5;
                }
                kept = -1;
            } else {
                (high, above) = (part, value);
                if kept == 1 {
                    below *= 0.5;
                }
                kept = 1;
            }
        }
        let part = match above.abs() < below.abs() {
            true => high,
            false => low,
        };
        self.strain += part * STRAIN_STEP;
    }
}

/// Rings on both sides of the rim, wider with the distance from it.
fn rings(radius: f64) -> Vec<Ring> {
    let side = |reach: f64, inside: bool| {
        let growth = growth(reach / FIRST_RING);
        let mut near = 0.0;
        (0..RINGS).map(move |i| {
            let width = FIRST_RING * growth.powi(i as i32);
            let middle = near + 0.5 * width;
            near += width;
            let (below, counts) = match inside {
                true => (-(1.0 - middle).ln(), (1.0 - middle).powi(2)),
                false => (middle.ln_1p(), 1.0),
            };
            Ring {
                below,
                weight: width * radius * counts,
                strain: 0.0,
            }
        })
    };
    side(OUTER_RADIUS - 1.0, false)
        .chain(side(1.0, true))
        .collect()
}

/// Factor from ring to ring with which they sum up to a number of first rings.
fn growth(sum: f64) -> f64 {
    let rings = |factor: f64| (factor.powi(RINGS as i32) - 1.0) / (factor - 1.0);
    bisected(1.0, 2.0, 60, |factor| rings(factor) < sum)
}

#[cfg(test)]
#[path = "shear_zone_tests.rs"]
mod tests;
