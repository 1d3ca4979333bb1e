//! From the grid at the end of a planar impact to its result.

use super::run::PlanarImpact;
use crate::{
    fdm::warnings::of_materials,
    material::impedance_match,
    outcome::{Detail, Outcome, REST_FRACTION, RunResult, Termination},
    scenario::TargetBody,
    units::significant,
};

/// Adds what is left of the projectile, stresses and speeds of the faces, and warnings.
pub(super) fn complete(impact: &PlanarImpact<'_>, result: &mut RunResult) {
    let (mass, momentum) = impact.grid.motion(0);
    result.residual_velocity = Some(momentum / mass);
    result.projectile_final_mass = Some(mass);
    result.peak_force = Some(impact.interface.peak);
    result.details = details(impact);
    result.warnings = warnings(impact, result);
}

pub(super) fn outcome(impact: &PlanarImpact<'_>, termination: Termination) -> Outcome {
    let (mass, momentum) = impact.grid.motion(0);
    let velocity = momentum / mass;
    match termination {
        Termination::NothingMoves => Outcome::AtRest,
        Termination::EndTime | Termination::StepLimit => Outcome::OutOfTime,
        _ if velocity < -REST_FRACTION * impact.scenario.impact_velocity => Outcome::Rebounded,
        _ if velocity > REST_FRACTION * impact.scenario.impact_velocity => Outcome::Separated,
        _ => Outcome::AtRest,
    }
}

/// Time after which release from the edge has reached the axis of the projectile [s].
fn edge_release(impact: &PlanarImpact<'_>) -> f64 {
    0.5 * impact.scenario.projectile.diameter / impact.grid.bodies[0].wave_speed_at_rest()
}

fn details(impact: &PlanarImpact<'_>) -> Vec<Detail> {
    let (scenario, grid) = (impact.scenario, &impact.grid);
    let mut details = vec![Detail::new(
        "edge release reaches the axis",
        "us",
        edge_release(impact) * 1e6,
    )];
    if let Some(force) = impact.interface.plateau() {
        let stress = force / scenario.projectile.area();
        details.push(Detail::new(
            "interface stress, plateau",
            "GPa",
            stress * 1e-9,
        ));
    }
    let front = match &scenario.target {
        TargetBody::Layers { layers, .. } => layers.first().map(|plate| &*plate.material),
        _ => None,
    };
    let projectile = &scenario.projectile.material;
    if let Some((speed, pressure)) = impedance_match(projectile, front, scenario.impact_velocity) {
        details.push(Detail::new("impedance match: particle speed", "m/s", speed));
        details.push(Detail::new(
            "impedance match: pressure without strength",
            "GPa",
            pressure * 1e-9,
        ));
    }
    if impact.back.free {
        details.push(Detail::new(
            "largest speed of the rear face",
            "m/s",
            impact.back.largest,
        ));
    }
    details.push(Detail::new("spall planes", "", grid.spalls.len() as f64));
    if let Some(first) = grid.spalls.first() {
        details.push(Detail::new(
            "first spall plane, below the struck face",
            "mm",
            first.position * 1e3,
        ));
        details.push(Detail::new("first spall", "us", first.time * 1e6));
        if impact.back.free {
            let pull_back = impact.back.largest - impact.back.smallest_after;
            details.push(Detail::new("pull-back of the rear face", "m/s", pull_back));
        }
    }
    details
}

fn warnings(impact: &PlanarImpact<'_>, result: &RunResult) -> Vec<String> {
    let (scenario, grid) = (impact.scenario, &impact.grid);
    let mut warnings = vec![
        "uniaxial strain leaves no crater: the model gives stresses, speeds and spall, no depth"
            .to_owned(),
    ];
    if result.outcome == Outcome::OutOfTime {
        warnings.push(
            "the bodies still touched at the end of the run: the residual velocity is that of the moment; raise `fdm.end_time`"
                .to_owned(),
        );
    }
    let release = edge_release(impact);
    if grid.time > release {
        warnings.push(format!(
            "release from the edge reaches the axis after {} us, and the run lasts {} us: what happens later is not uniaxial \
             strain",
            significant(release * 1e6, 3),
            significant(grid.time * 1e6, 3)
        ));
    }
    if let Some(late) = grid.spalls.first().filter(|spall| spall.time > release) {
        warnings.push(format!(
            "the first spall comes at {} us, after release from the edge: it may not happen",
            significant(late.time * 1e6, 3)
        ));
    }
    let heated = scenario.options.chain.adiabatic_heating();
    let of_records = of_materials(scenario, grid, heated);
    for (body, ((name, _), of_record)) in scenario.bodies().into_iter().zip(of_records).enumerate()
    {
        warnings.extend(of_record);
        if grid.bodies[body].spall_strength.is_none() {
            warnings.push(format!(
                "the {name}'s material has no spall strength and holds any tension: give `fdm.spall_strength` or \
                 `materials.NAME.spall_strength`"
            ));
        }
    }
    warnings
}
