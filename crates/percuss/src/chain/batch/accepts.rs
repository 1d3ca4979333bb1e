//! Which shots can be computed side by side.

use crate::{
    case::{
        ArtificialViscosity, BorderShearLaw, ErosionClosure, Kinematics, Scheme, TargetClosure,
    },
    material::Material,
    scenario::{Scenario, TargetBody},
};

/// Whether a shot is one of those that can be computed side by side: a column of one layer, logarithmic strain, border shear by
/// friction, nothing that damps or parts, and strength that is a power of the plastic strain.
pub(crate) fn accepts(scenario: &Scenario) -> bool {
    let options = &scenario.options.chain;
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        return false;
    };
    let is_power = |material: &Material| {
        let prepared = material.strength.law().prepare(material, 1.0);
        prepared.hardening().is_some()
    };
    options.scheme == Scheme::Conservative
        && options.target_closure() == TargetClosure::Column
        && options.erosion_closure() == ErosionClosure::Strain
        && options.kinematics() == Kinematics::Logarithmic
        && options.border_shear_law() == BorderShearLaw::Friction
        && options.artificial_viscosity.unwrap_or_default() == ArtificialViscosity::default()
        && options.damping_ratio.unwrap_or(0.0) == 0.0
        && options.local_damping.unwrap_or(0.0) == 0.0
        && options.failure.is_none()
        && layers.len() == 1
        && layers[0].gap == 0.0
        && scenario.impact_speed > 0.0
        && is_power(&scenario.projectile.material)
        && is_power(&layers[0].material)
}
