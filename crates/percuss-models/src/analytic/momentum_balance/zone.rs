//! Plastic zone of the target ahead of a crater floor: its extent, its resistance and its moving mass.

use super::super::cavity_expansion::CavityExpansion;

/// Intervals of the table of extents.
const STEPS: u32 = 24;

/// A target that flows within a shell around a hemispherical floor.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Zone {
    /// Density [kg/m3].
    pub(super) density: f64,
    /// Flow stress Y [Pa].
    pub(super) strength: f64,
    /// Factor k of `k Y ln α`: 2 of the hoop stress, and 2/3 of the shear between rays.
    pub(super) gradient: f64,
    /// Speeds of the floor [m/s] and extents, rising speeds.
    pub(super) extents: Vec<(f64, f64)>,
}

impl Zone {
    /// The zone of a body, with or without shear between rays.
    pub(super) fn new(body: &CavityExpansion, shear: bool) -> Self {
        Self {
            density: body.density,
            strength: body.yield_stress,
            gradient: if shear { 8.0 / 3.0 } else { 2.0 },
            extents: body.extents(STEPS),
        }
    }

    /// Extent in radii of the floor at a speed of the floor [m/s]. Beyond the table its front keeps the largest speed.
    pub(super) fn extent(&self, speed: f64) -> f64 {
        let next = self.extents.partition_point(|point| point.0 <= speed);
        let below = next.checked_sub(1).and_then(|i| self.extents.get(i));
        match (below, self.extents.get(next)) {
            (Some(&(from, alpha)), Some(&(to, after))) => {
                alpha + (after - alpha) * (speed - from) / (to - from)
            }
            (Some(&(from, alpha)), None) if from > 0.0 => (alpha * from / speed).max(1.0),
            (Some(&(_, alpha)), None) | (None, Some(&(_, alpha))) => alpha,
            (None, None) => 1.0,
        }
    }

    /// Pressure at the middle of a floor that moves slowly [Pa]: `2Y/3 + k Y ln α`.
    pub(super) fn resistance(&self, alpha: f64) -> f64 {
        self.strength * (2.0 / 3.0 + self.gradient * alpha.ln())
    }

    /// Velocity on the axis over that of the floor, at a radius in radii of the floor: `[(α/ξ)³ − 1]/(α³ − 1)`.
    #[cfg(test)]
    pub(super) fn velocity(alpha: f64, radius: f64) -> f64 {
        ((alpha / radius).powi(3) - 1.0) / (alpha.powi(3) - 1.0)
    }

    /// Length of target on the axis that moves with the floor, in its radii: `∫ v/U dξ = ½[1 − 3/(α² + α + 1)]`.
    pub(super) fn moving_length(alpha: f64) -> f64 {
        0.5 - 1.5 / (alpha * alpha + alpha + 1.0)
    }
}
