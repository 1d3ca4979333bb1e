//! Plastic shock in a rod that does not harden.

use crate::{
    options::ArtificialViscosity,
    scenario::{Scenario, TargetBody},
    units::significant,
};

/// Inertia over strength `ρ V²/Y` from which on a run without viscosity is warned of.
const STRONG: f64 = 1.5;

/// Warns of a rod of constant strength that a rigid wall stops in a plastic shock, where a scheme has no viscosity; `key` sets it.
///
/// The nominal stress `Y/(1 − e)` of such a rod grows ever faster with the strain e.
pub fn plastic_shock_warning(
    key: &str,
    scenario: &Scenario,
    viscosity: ArtificialViscosity,
) -> Option<String> {
    let rod = &scenario.projectile;
    let temperature = rod.start_temperature();
    let is_shocked = scenario.target == TargetBody::RigidWall
        && viscosity.is_none()
        && !rod.material.hardens_at(temperature);
    let yield_stress = rod
        .material
        .yield_stress_at(temperature)
        .filter(|_| is_shocked)?;
    let ratio = rod.material.density.si() * scenario.impact_velocity.powi(2) / yield_stress;
    (ratio > STRONG).then(|| {
        format!(
            "a rod of constant strength stops in a plastic shock, and without viscosity the final length is too small: by 5 % at ρV²/Y = 1.8, by \
             16 % at 3.1 (here {}); set `{key}.quadratic = 2.0`",
            significant(ratio, 2)
        )
    })
}
