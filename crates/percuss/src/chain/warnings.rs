//! What a user should know before relying on a result of the conservative scheme.

use super::mesh;
use crate::{
    material::Material,
    outcome::{Outcome, RunResult},
    scenario::{Scenario, TargetBody},
    units::{Temperature, significant},
};

/// Warnings of a run, the weightiest first.
pub(super) fn warnings(
    scenario: &Scenario,
    result: &RunResult,
    erosion_strain: f64,
) -> Vec<String> {
    let mut warnings = Vec::new();
    match result.outcome {
        Outcome::OutOfTime => warnings.push(
            "the run was ended before the shot was over: raise `chain.end_time` or `chain.max_steps`".to_owned(),
        ),
        Outcome::Perforated => warnings.push(
            "the target is perforated: a column without a plug or a bulge overestimates its resistance; the residual \
             velocity is indicative"
                .to_owned(),
        ),
        _ => {}
    }
    warn_of_closure(scenario, result, &mut warnings);
    warn_of_erosion(scenario, result, erosion_strain, &mut warnings);
    let projectile = (
        &*scenario.projectile.material,
        result.largest_plastic_strain.0,
        result.largest_temperature.0,
    );
    warn_of_material("projectile", projectile, &mut warnings);
    if let TargetBody::Layers { layers, .. } = &scenario.target
        && let [plate] = layers.as_slice()
    {
        let target = (
            &*plate.material,
            result.largest_plastic_strain.1,
            result.largest_temperature.1,
        );
        warn_of_material("target", target, &mut warnings);
    }
    warnings
}

/// A column of target resists by its constraint factor and its border shear: both are closures, not results.
fn warn_of_closure(scenario: &Scenario, result: &RunResult, warnings: &mut Vec<String>) {
    let (TargetBody::Layers { layers, .. }, Some(depth)) =
        (&scenario.target, result.depth_of_penetration)
    else {
        return;
    };
    let thickness: f64 = layers
        .iter()
        .map(|plate| mesh::modelled_thickness(plate, scenario))
        .sum();
    let element = thickness / scenario.chain.target_elements() as f64;
    if scenario.chain.border_shear() > 0.0 {
        warnings.push(format!(
            "the depth rests on the target closure (constraint factor and border shear C = {}): `chain.border_shear = 0.0` \
             gives the other end of the range",
            significant(scenario.chain.border_shear(), 4)
        ));
    }
    if depth > 0.0 && depth < element {
        warnings.push(format!(
            "the depth ({} mm) is less than one target element ({} mm): see `percuss converge`",
            significant(depth * 1e3, 3),
            significant(element * 1e3, 3)
        ));
    }
    let semi_infinite = layers.iter().any(|plate| plate.thickness.is_none());
    if semi_infinite && depth > 0.75 * thickness {
        warnings.push(format!(
            "the depth is close to the {} mm that stand for a semi-infinite target: give a thickness",
            significant(thickness * 1e3, 3)
        ));
    }
}

fn warn_of_erosion(
    scenario: &Scenario,
    result: &RunResult,
    erosion_strain: f64,
    warnings: &mut Vec<String>,
) {
    let (projectile, target) = result.eroded_elements;
    if projectile + target > 0 {
        warnings.push(format!(
            "{projectile} of {} projectile elements and {target} target elements eroded at strain {}, a numerical limit: \
             compare with `chain.erosion_strain` = {} and {}",
            scenario.chain.projectile_elements(),
            significant(erosion_strain, 3),
            significant(0.75 * erosion_strain, 3),
            significant(1.5 * erosion_strain, 3),
        ));
    }
}

/// Material, largest plastic strain, largest temperature [K].
type Reached<'a> = (&'a Material, f64, f64);

fn warn_of_material(
    what: &str,
    (material, strain, temperature): Reached<'_>,
    warnings: &mut Vec<String>,
) {
    if let Some(melting) = material.melting_temperature
        && temperature >= melting.si()
    {
        warnings.push(format!(
            "the {what} reached its melting point ({melting}): there the law has no strength"
        ));
    }
    let thermal = matches!(
        &material.strength,
        crate::material::Strength::JohnsonCook(_)
    );
    if thermal && material.specific_heat.is_none() && strain > 0.0 {
        warnings.push(format!(
            "the {what}'s material has no specific heat: it does not warm up, so its strength is not reduced"
        ));
    }
    let validity = &material.validity;
    if let Some(most) = validity.plastic_strain_max
        && strain > most
    {
        warnings.push(format!(
            "the {what} reached a plastic strain of {}, beyond {most} to which its law was fitted",
            significant(strain, 3)
        ));
    }
    if let Some(most) = validity.temperature_max
        && temperature > most.si()
    {
        warnings.push(format!(
            "the {what} reached {}, beyond {most} to which its law was fitted",
            Temperature::new(temperature)
        ));
    }
}
