//! Limitations of a result of the conservative scheme.

use std::f64::consts::FRAC_PI_2;

use super::plug;
use crate::{
    material::{Material, Reached, cavity_expansion_pressure_at},
    options::{BorderShearLaw, ChainOptions, ErosionCriterion, TargetResistanceModel},
    outcome::{Outcome, RunResult},
    problem::RearFaceCondition,
    regime::{STRENGTH_STRAIN, THIN, is_thinner},
    scenario::{Plate, Scenario, TargetBody},
    units::{Velocity, significant},
    validity::{
        border_shear_warning, column_mesh_warnings, fixed_rear_face_warning, plastic_shock_warning,
        pushed_column_warning,
    },
};

const OUT_OF_TIME: &str =
    "the run was ended before the impact was over: raise `chain.end_time` or `chain.max_steps`";
/// Section of the thickness of a plate that a crater may take before a support behind it matters.
const FREE_OF_BACK_FACE: f64 = 0.5;
/// Thickness in projectile diameters from which on a plate is far from the thin ones of a column.
const NEAR_COLUMN: f64 = 1.0;
/// Thickness in projectile diameters from which on dishing adds less than a tenth to the depth in the axisymmetric reference.
const FREE_OF_DISHING: f64 = 3.0;

/// Length of an element in projectile diameters from which on an eroding rod does not go as deep as one of fine elements.
const LONGEST_ERODING: f64 = 0.75;

/// Warnings of a run, the weightiest first.
pub(super) fn warnings(
    scenario: &Scenario,
    result: &RunResult,
    reached: &[Reached],
    erosion_strain: f64,
) -> Vec<String> {
    let mut warnings = Vec::new();
    match result.outcome {
        Outcome::OutOfTime => warnings.push(OUT_OF_TIME.to_owned()),
        Outcome::Perforated if result.plug_mass.is_some() => {}
        Outcome::Perforated if result.numerics().eroded_elements.1 == scenario.options.chain.target_elements() => {
            warnings.push("the whole column of target eroded before the projectile did: give a thicker target".to_owned());
        }
        Outcome::Perforated => warnings.push(
            "the target is perforated: a column without a plug or a bulge overestimates its resistance; the residual \
             velocity is indicative"
                .to_owned(),
        ),
        // With a shear band the border fails, and perforation is a result.
        _ if scenario.options.chain.shear_band.is_some() => {}
        _ => warnings.extend(pushed_column_warning(scenario, result.depth_of_penetration)),
    }
    if result.outcome != Outcome::Perforated {
        warnings.extend(fixed_rear_face_warning(scenario));
    }
    warn_of_plug(scenario, result, &mut warnings);
    warn_of_closure(scenario, result, &mut warnings);
    warn_of_erosion(scenario, result, erosion_strain, &mut warnings);
    warn_of_failure(scenario, result, &mut warnings);
    let viscosity = scenario.options.chain.artificial_viscosity();
    warnings.extend(plastic_shock_warning(
        "chain.artificial_viscosity",
        scenario,
        viscosity,
    ));
    let heated = scenario.options.chain.adiabatic_heating();
    for ((what, material), reached) in scenario.bodies().into_iter().zip(reached) {
        warnings.extend(reached.warnings(&what, material, heated));
    }
    warnings
}

/// Warnings of a run with an expanding cavity for a target, the weightiest first.
pub(super) fn warnings_of_cavity(
    scenario: &Scenario,
    result: &RunResult,
    reached: &Reached,
    erosion_strain: f64,
) -> Vec<String> {
    let mut warnings = Vec::new();
    if result.outcome == Outcome::OutOfTime {
        warnings.push(OUT_OF_TIME.to_owned());
    }
    let depth = result.permanent_depth.unwrap_or(0.0);
    if depth == 0.0 && scenario.impact_velocity > 0.0 {
        warnings.push("the target stays elastic: it keeps no dent".to_owned());
    }
    if scenario.resistance.is_some() {
        warnings.push("the depth rests on a resistance law of the caller's own".to_owned());
    } else if depth > 0.0 {
        warnings.push(
            "the depth rests on the target resistance model `expanding-cavity`: no constant of it is fitted, but its form was selected \
             with the cases in view that its model error is estimated from"
                .to_owned(),
        );
    }
    if depth > 0.0 {
        warnings.extend(warning_of_elastic_depth(result));
    }
    warnings.extend(warning_of_rear_face(scenario, depth));
    let diameter = scenario.projectile.diameter;
    // A case that names its target resistance model keeps it at any thickness.
    let thickness = scenario
        .target_thickness()
        .filter(|_| !scenario.given.target_resistance);
    if let Some(thickness) = thickness.filter(|&h| is_thinner(h, NEAR_COLUMN, scenario)) {
        warnings.push(format!(
            "the plate is {} projectile diameters thick: below {THIN} the target resistance model is `column`, whose answer differs; compare \
             both by `chain.target_resistance`",
            significant(thickness / diameter, 3)
        ));
    }
    if scenario.gauges.iter().any(|gauge| gauge.position > 0.0) {
        warnings.push(
            "gauges in the target read the elastic far field of the crater: for waves in a bar set `chain.target_resistance = \"column\"` \
             and `chain.border_shear = 0.0`"
                .to_owned(),
        );
    }
    warn_of_erosion(scenario, result, erosion_strain, &mut warnings);
    let heated = scenario.options.chain.adiabatic_heating();
    let material = &scenario.projectile.material;
    warnings.extend(reached.warnings("projectile", material, heated));
    warnings
}

/// That a target at rest springs back by more than half its depth.
fn warning_of_elastic_depth(result: &RunResult) -> Option<String> {
    result.time_to_rest?;
    let permanent = result.permanent_depth?;
    (result.depth_of_penetration? > 2.0 * permanent).then(|| {
        format!(
            "most of the depth is elastic deflection, which springs back: {} mm are permanent",
            significant(permanent * 1e3, 3)
        )
    })
}

/// What an expanding cavity leaves out of a rear face that is near.
fn warning_of_rear_face(scenario: &Scenario, depth: f64) -> Option<String> {
    let thickness = scenario.target_thickness()?;
    let TargetBody::Layers { back_face, .. } = scenario.target else {
        return None;
    };
    match back_face {
        RearFaceCondition::Free if thickness < FREE_OF_DISHING * scenario.projectile.diameter => Some(
            "the depth is that of the crater alone: a plate below 3 projectile diameters with a free rear face also dishes and bulges, \
             which is not included"
                .to_owned(),
        ),
        RearFaceCondition::Fixed if depth >= thickness => Some(
            "perforation is not a result: the rear face is fixed (default) and the crater has reached it; set \
             `target.back_face = \"free\"`"
                .to_owned(),
        ),
        RearFaceCondition::Fixed if is_thinner(thickness, FREE_OF_DISHING, scenario) => {
            fixed_rear_face_warning(scenario)
        }
        RearFaceCondition::Fixed | RearFaceCondition::NonReflecting if depth > FREE_OF_BACK_FACE * thickness => Some(
            "the crater is more than half as deep as the plate: the support behind it is not included in the resistance"
                .to_owned(),
        ),
        _ => None,
    }
}

/// Section of the thickness beyond which a plate that dishes is more and more a membrane, which is left out.
const LARGE_DISHING: f64 = 0.5;

/// Plugging depends on the width and the failure of the shear band.
fn warn_of_plug(scenario: &Scenario, result: &RunResult, warnings: &mut Vec<String>) {
    let detail = |name: &str| {
        let found = result.details.iter().find(|detail| detail.name == name);
        found.map(|detail| detail.value)
    };
    let Some(width) = detail(plug::WIDTH) else {
        return;
    };
    warnings.push(format!(
        "perforation rests on the shear around the plug, {} mm wide at its largest stress, and on when it fails: compare with half and \
         twice that as `chain.shear_band.width`, and with failure = \"never\"",
        significant(width, 3)
    ));
    if let (Some(dishing), Some(thickness)) = (detail(plug::DISHING), scenario.target_thickness())
        && dishing * 1e-3 > LARGE_DISHING * thickness
    {
        warnings.push(
            "the plate dished by more than half its thickness: its resistance as a membrane is left out".to_owned(),
        );
    }
}

/// A column of target resists by its constraint factor and its border shear: both are model assumptions, not results.
fn warn_of_closure(scenario: &Scenario, result: &RunResult, warnings: &mut Vec<String>) {
    let (TargetBody::Layers { layers, .. }, Some(depth)) =
        (&scenario.target, result.depth_of_penetration)
    else {
        return;
    };
    let element = scenario.modelled_length() / scenario.options.chain.target_elements() as f64;
    if layers.iter().all(|plate| plate.gap == 0.0) {
        warnings.extend(warning_of_elastic_depth(result));
    }
    if scenario.options.chain.erosion_criterion() == ErosionCriterion::Tate {
        warnings.push(
            "the depth depends on the erosion criterion `tate`: the resistance of the target is its flow stress times the constraint \
             factor, on the rod's area"
                .to_owned(),
        );
    } else if scenario.options.chain.target_resistance() != TargetResistanceModel::Column {
        warn_of_cone(scenario, layers, depth, warnings);
    } else if scenario.options.chain.border_shear_law() == BorderShearLaw::Friction {
        let coefficient = scenario.options.chain.border_shear();
        warnings.extend(border_shear_warning("chain", coefficient));
    }
    warnings.extend(column_mesh_warnings(scenario, depth, "element", element));
}

/// Factor on either side of the threshold of penetration within which the cones are at their weakest.
const THRESHOLD_EDGE: f64 = 1.4;
/// Section of the compliance of the cone that may lie behind a plate's rear face.
const COMPLIANCE_BEHIND: f64 = 0.25;

/// A cone models neither a crater that is deep against its mouth nor a near rear face.
fn warn_of_cone(scenario: &Scenario, layers: &[Plate], depth: f64, warnings: &mut Vec<String>) {
    let Some(plate) = layers.first() else {
        return;
    };
    let struck = &plate.material;
    let resistance = scenario.options.chain.target_resistance();
    let rod = &scenario.projectile;
    let radius = 0.5 * rod.diameter;
    if resistance == TargetResistanceModel::Diverging && depth > radius {
        warnings.push(format!(
            "the depth is more than a radius of the projectile: the crater floor has left the mouth of the cone, which resists more \
             and more; compare with `chain.target_resistance` = \"{}\"",
            TargetResistanceModel::DivergingPenetrable.name()
        ));
    }
    if resistance == TargetResistanceModel::DivergingPenetrable
        && let (Some(resistance), Some(strength)) = (
            cavity_expansion_pressure_at(struck, plate.start_temperature()),
            rod.material.flow_stress(STRENGTH_STRAIN),
        )
        && resistance > strength
    {
        let threshold = (2.0 * (resistance - strength) / rod.material.density.si()).sqrt();
        let ratio = scenario.impact_velocity / threshold;
        if (1.0 / THRESHOLD_EDGE..THRESHOLD_EDGE).contains(&ratio) {
            warnings.push(format!(
                "the impact is near the threshold of penetration ({}), where the projectile begins to be turned back: the depth is \
                 too small from there on until penetration is steady",
                Velocity::new((threshold).round())
            ));
        }
    }
    let thickness: Option<f64> = layers.iter().map(|plate| plate.thickness).sum();
    let apex = FRAC_PI_2 * (1.0 - struck.poissons_ratio * struck.poissons_ratio) * radius;
    if let Some(thickness) = thickness
        && apex > COMPLIANCE_BEHIND * (apex + thickness - depth)
    {
        warnings.push(
            "the rear face is near: a cone does not bulge, bend or plug, and keeps its length as the crater deepens".to_owned(),
        );
    }
}

fn warn_of_erosion(
    scenario: &Scenario,
    result: &RunResult,
    erosion_strain: f64,
    warnings: &mut Vec<String>,
) {
    let (projectile, target) = result.numerics().eroded_elements;
    let rod = &scenario.projectile;
    let element = rod.length / scenario.options.chain.projectile_elements() as f64;
    if projectile > 0 && element > LONGEST_ERODING * rod.diameter {
        warnings.push(format!(
            "the elements of the projectile are {} diameters long, and erode one at a time, which makes the depth too small: raise `chain.projectile_elements` to {:.0}",
            significant(element / rod.diameter, 2),
            (rod.length / (ChainOptions::LONGEST_ELEMENT * rod.diameter)).ceil()
        ));
    }
    let by_strain = scenario.options.chain.erosion_criterion() == ErosionCriterion::Strain;
    if projectile + target > 0 && by_strain {
        warnings.push(format!(
            "{projectile} of {} projectile elements and {target} target elements eroded at strain {}, a numerical limit: \
             compare with `chain.erosion_strain` = {} and {}, and with half the Courant number",
            scenario.options.chain.projectile_elements(),
            significant(erosion_strain, 3),
            significant(0.75 * erosion_strain, 3),
            significant(1.5 * erosion_strain, 3),
        ));
    }
}

/// Bodies that cannot fail for want of numbers, and pieces that depend on the mesh.
fn warn_of_failure(scenario: &Scenario, result: &RunResult, warnings: &mut Vec<String>) {
    let Some(failure) = &scenario.options.chain.failure else {
        return;
    };
    let mut without: Vec<&str> = Vec::new();
    let mut look_at = |material: &Material, id| {
        if failure.law().prepare(material).is_none() && !without.contains(&id) {
            without.push(id);
        }
    };
    let rod = &scenario.projectile;
    look_at(&rod.material, &rod.material_id);
    if let TargetBody::Layers { layers, .. } = &scenario.target {
        for plate in layers {
            look_at(&plate.material, &plate.material_id);
        }
    }
    for id in without {
        warnings.push(format!(
            "`{id}` has no `{}`: it does not part",
            failure.law().record_key()
        ));
    }
    let energy = scenario.options.chain.fracture_energy;
    if energy.is_none_or(|energy| energy.si() == 0.0) && result.fragments.len() > 3 {
        warnings.push(
            "cracks open at once: the first one is a result, the number of pieces and the smallest of them depend on the mesh; \
             give `chain.fracture_energy`"
                .to_owned(),
        );
    }
}
