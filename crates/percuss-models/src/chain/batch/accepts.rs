//! Which runs can be computed side by side.

use super::bundle::law;
use crate::{
    material::Material,
    options::{
        ArtificialViscosity, BorderShearLaw, ChainOptions, ErosionCriterion, Kinematics, Scheme,
        TargetResistanceModel,
    },
    scenario::{Plate, Scenario, TargetBody},
};

/// Whether a run is one of those that can be computed side by side: a column of one layer, logarithmic strain, border shear by
/// friction, no damping and no failure, and strength laws whose equations ride in lanes.
pub fn accepts(scenario: &Scenario) -> bool {
    let rides = |material: &Material| law(material).is_some();
    scenario.resistance.is_none()
        && scenario.impact_velocity > 0.0
        && accepts_options(&scenario.options.chain)
        && single_layer(&scenario.target).is_some_and(rides)
        && rides(&scenario.projectile.material)
}

/// Whether the batch computes what the options ask for.
///
/// Every option is named here, so that a new one does not compile before somebody has decided what the batch does about it. Those bound
/// to `_` take effect in the mesh, in the batch, or only beside one that is refused.
fn accepts_options(options: &ChainOptions) -> bool {
    let ChainOptions {
        scheme,
        projectile_elements: _,
        target_elements: _,
        target_resistance: _,
        constraint_factor: _,
        border_shear: _,
        border_shear_law,
        shear_band,
        dishing,
        kinematics: _,
        courant: _,
        erosion_strain: _,
        erosion_criterion: _,
        artificial_viscosity,
        damping_ratio,
        local_damping,
        failure,
        fracture_energy: _,
        rate_effects: _,
        adiabatic_heating: _,
        heat_fraction: _,
        end_time: _,
        max_steps: _,
        end_at_rest: _,
        published,
    } = options;
    *scheme == Scheme::Conservative
        && published.is_none()
        && options.target_resistance() == TargetResistanceModel::Column
        && options.erosion_criterion() == ErosionCriterion::Strain
        && options.kinematics() == Kinematics::Logarithmic
        && border_shear_law.unwrap_or_default() == BorderShearLaw::Friction
        && shear_band.is_none()
        && !dishing.unwrap_or(false)
        && artificial_viscosity.unwrap_or_default() == ArtificialViscosity::default()
        && damping_ratio.unwrap_or(0.0) == 0.0
        && local_damping.unwrap_or(0.0) == 0.0
        && failure.is_none()
}

/// Material of the only layer of a target that has one, and no gap in front of it.
fn single_layer(target: &TargetBody) -> Option<&Material> {
    let TargetBody::Layers {
        layers,
        back_face: _,
        column_diameter: _,
        // One layer has nothing to separate from.
        separate_layers: _,
        // The edge of a plate counts with `dishing` only.
        edge: _,
    } = target
    else {
        return None;
    };
    let [
        Plate {
            material,
            material_id: _,
            thickness: _,
            gap,
            interface: _,
            column_diameter: _,
            temperature: _,
        },
    ] = layers.as_slice()
    else {
        return None;
    };
    (*gap == 0.0).then_some(material)
}
