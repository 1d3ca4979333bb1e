//! Limitations of a result.

use super::{
    run::{Axisymmetric, materials},
    setup::{extent, is_thick},
};
use crate::{
    Scenario,
    material::{Material, Reached, Strength},
    outcome::{Outcome, RunResult},
    problem::{Nose, RearFaceCondition},
    regime::is_thinner,
    scenario::each_once,
    solver::Particle,
    units::significant,
    validity::THROUGH_FIXED_FACE,
};

/// Part of the energy lost between particles and grid that deserves a word.
const TRANSFER: f64 = 0.1;

/// Diameters of the projectile below which a target bends or bulges.
const PLATE: f64 = 3.0;

/// Diameter of a spread face over that of the shank from which it raises limits: by a tenth at 1.04, against an elastic projectile (blunt tool steel on
/// 12 mm of Weldox 460 E).
const SPREAD: f64 = 1.02;

/// Fewest cells across a layer or along the projectile that resolve how it bends.
const FEWEST_CELLS: f64 = 2.0;

/// Whether a target is a plate to its projectile.
fn is_plate(scenario: &Scenario) -> bool {
    let thickness = scenario.target_thickness();
    thickness.is_some_and(|thickness| is_thinner(thickness, PLATE, scenario))
}

/// Ids of the case's materials of a kind, each once.
fn unlike(scenario: &Scenario, is_one: fn(&Material) -> bool) -> Vec<&str> {
    let unlike = materials(scenario).filter(|(material, _)| is_one(material));
    each_once(unlike.map(|(_, id)| id))
}

/// Ids of the target's materials without data of failure; empty where an option of `axi` makes them fail.
pub fn layers_that_cannot_fail(scenario: &Scenario) -> Vec<&str> {
    if scenario.options.axi.can_fail(None) {
        return Vec::new();
    }
    let layers = materials(scenario).skip(1);
    let without = layers.filter(|(material, _)| material.damage.is_none());
    each_once(without.map(|(_, id)| id))
}

pub(super) fn warnings(run: &Axisymmetric<'_>, result: &RunResult) -> Vec<String> {
    let mut warnings = Vec::new();
    let energy = run.grid.energy();
    let share = energy.transfer / energy.initial;
    if share > TRANSFER {
        warnings.push(format!(
            "{:.0} % of the energy was lost between particles and grid: raise `axi.cells_per_radius`",
            100.0 * share
        ));
    }
    if let (Some(extent), Some(depth)) = (extent(run.scenario), result.largest_depth) {
        let below = extent.layers.iter().sum::<f64>() - depth;
        let radius = 0.5 * run.scenario.projectile.diameter;
        if extent.cut && below < 5.0 * radius {
            warnings.push(format!(
                "the crater came within {:.1} projectile radii of the end of the modelled target: raise `axi.target_depth`",
                below / radius
            ));
        }
    }
    let modelled = extent(run.scenario).map_or(0.0, |extent| extent.layers.iter().sum::<f64>());
    for gauge in &run.scenario.gauges {
        if !gauge.fixed && gauge.position > modelled {
            warnings.push(format!(
                "`{}` has no values: it lies {:.3} mm deep, and the modelled target ends at {:.3} mm: raise `axi.target_depth`",
                gauge.name,
                1e3 * gauge.position,
                1e3 * modelled
            ));
        }
    }
    let is_held = run.scenario.rear_face() == Some(RearFaceCondition::Fixed);
    if is_held && result.outcome == Outcome::Perforated {
        warnings.push(THROUGH_FIXED_FACE.to_owned());
    } else if is_held && is_plate(run.scenario) {
        warnings.push(
            "the plate can neither bend, bulge nor be perforated: its rear face is fixed (the default). Set `back_face = \"free\"`"
                .to_owned(),
        );
    }
    let cell = run.grid.mesh.cell;
    let layers = run.scenario.layers().iter();
    let thin = layers
        .filter_map(|layer| layer.thickness)
        .fold(f64::INFINITY, f64::min);
    for (what, extent) in [
        ("the projectile is", run.scenario.projectile.length),
        ("the thinnest layer is", thin),
    ] {
        if extent < FEWEST_CELLS * cell {
            warnings.push(format!(
                "{what} {:.1} cells thick: raise `axi.cells_per_radius`",
                extent / cell
            ));
        }
    }
    let options = &run.scenario.options.axi;
    let free = run.scenario.rear_face() == Some(RearFaceCondition::Free);
    let cannot_fail = layers_that_cannot_fail(run.scenario);
    let brittle = !run.scenario.brittle().is_empty();
    if free && options.damage.is_none() && !cannot_fail.is_empty() && !brittle {
        warnings.push(format!(
            "the target can be perforated by stretching and thinning alone, which takes more energy than failure: {} has no `damage` in its record. Give it, or `axi.failure_strain`",
            cannot_fail.join(", ")
        ));
    }
    let can_fail = materials(run.scenario)
        .skip(1)
        .any(|(material, _)| material.damage.is_some());
    if free && is_plate(run.scenario) && can_fail && run.scenario.projectile.nose == Nose::Flat {
        let rod = &run.scenario.projectile;
        let has_hardening = !matches!(rod.material.strength, Strength::PerfectlyPlastic(_));
        let spread = result
            .projectile_final_diameter
            .filter(|diameter| !has_hardening && *diameter > SPREAD * rod.diameter);
        let spread = spread.map_or_else(String::new, |diameter| {
            format!(
                ". A face that spreads raises them: this one did, to {} mm, without hardening in the projectile's record; compare an elastic projectile",
                significant(1e3 * diameter, 3)
            )
        });
        warnings.push(format!(
            "whether a plate fails under a blunt nose is uncertain: limits by `axi` are up to 2.1 times those of `power_balance`; `percuss limit` \
             gives both{spread}"
        ));
    }
    if free && is_thick(run.scenario) && options.damage.is_none() && can_fail {
        warnings.push(
            "the target accumulates damage, which is the default with a free rear face, and has a deeper crater than a target whose rear face \
             is fixed or far away, which does not: compare `axi.damage = false`"
                .to_owned(),
        );
    }
    for (asked, what, lacks) in [
        (
            options.damage == Some(true),
            "damage",
            unlike(run.scenario, |m| m.damage.is_none()),
        ),
        (
            options.spalls() && options.spall_strength.is_none(),
            "spall_strength",
            unlike(run.scenario, |m| m.spall_strength.is_none()),
        ),
    ] {
        if asked && !lacks.is_empty() {
            warnings.push(format!(
                "without `{what}` in its record nothing of it fails by that: {}",
                lacks.join(", ")
            ));
        }
    }
    let heated = options.adiabatic_heating();
    for ((what, material), body) in run.scenario.bodies().into_iter().zip(&run.grid.bodies) {
        let most = |value: fn(&Particle) -> f64| {
            body.particles()
                .map(|particle| value(&particle))
                .fold(0.0, f64::max)
        };
        let reached = Reached {
            plastic_strain: most(|particle| particle.plastic_strain),
            strain_rate: None,
            temperature: most(|particle| particle.temperature),
        };
        warnings.extend(reached.warnings(&what, material, heated));
    }
    let lost = run
        .grid
        .accumulated
        .lost
        .iter()
        .zip(["projectile", "target"]);
    let lost: Vec<String> = lost
        .filter(|(count, _)| **count > 0)
        .map(|(count, body)| match count {
            1 => format!("1 particle of the {body}"),
            _ => format!("{count} particles of the {body}"),
        })
        .collect();
    if !lost.is_empty() {
        warnings.push(format!(
            "{} eroded or left the modelled space; the balances include them",
            lost.join(" and ")
        ));
    }
    warnings
}
