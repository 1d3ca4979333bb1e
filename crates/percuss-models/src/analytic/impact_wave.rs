//! Plane waves of a first contact, until the release from the edge of the rod reaches its axis.

use crate::material::Material;

/// Waves in rod and target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ImpactWave {
    /// Part of the impact velocity at which both faces move: `Z_p/(Z_p + Z_t)`.
    pub(super) share: f64,
    /// Speed of the wave in the rod [m/s].
    pub(super) speed: f64,
    /// Speed of the wave in the target over that in the rod.
    pub(super) ratio: f64,
}

impl ImpactWave {
    /// Waves of a projectile's and a target's material, as in the bulk.
    pub(super) fn of(projectile: &Material, target: &Material) -> Self {
        let speeds = [projectile, target].map(Material::bulk_sound_speed);
        let own = projectile.density.si() * speeds[0];
        let other = target.density.si() * speeds[1];
        Self {
            share: own / (own + other),
            speed: speeds[0],
            ratio: speeds[1] / speeds[0],
        }
    }
}
