//! From the grid at the end of a planar impact to its result.

use super::{interface::InterfaceForce, law::PlanarLaw, run::BackFaceMotion};
use crate::{
    fdm::{
        grid::{Grid, Watch},
        numerics::numerics,
        warnings::warn_of_material,
    },
    history::Recorder,
    material::impedance_match,
    outcome::{Detail, Outcome, RunResult, Termination},
    scenario::{Scenario, TargetBody},
    units::significant,
};

/// Part of the impact speed below which a projectile counts as stopped.
const REST_FRACTION: f64 = 0.01;

/// What a result is made of.
pub(super) struct Ending<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) grid: &'a Grid<PlanarLaw>,
    pub(super) watch: &'a Watch,
    pub(super) termination: Termination,
    pub(super) back: BackFaceMotion,
    pub(super) interface: &'a InterfaceForce,
}

pub(super) fn sum_up(ending: &Ending<'_>, recorder: Option<Recorder>) -> RunResult {
    let Ending {
        grid,
        watch,
        termination,
        ..
    } = *ending;
    let (mass, momentum) = grid.motion(0);
    let mut result = RunResult::new(
        "fdm",
        "planar",
        outcome(ending, momentum / mass),
        termination,
    );
    result.residual_velocity = Some(momentum / mass);
    result.projectile_final_mass = Some(mass);
    result.time_to_rest = watch.at_rest.map(|(time, _)| time);
    result.peak_force = Some(ending.interface.peak);
    result.contact_time = Some(watch.contact_time);
    result.end_time = Some(grid.time);
    result.details = details(ending);
    result.numerics = Some(numerics(grid, watch));
    result.warnings = warnings(ending, &result);
    result.history = recorder.map(|recorder| recorder.finish(grid.sample(), grid.profile()));
    result
}

fn outcome(ending: &Ending<'_>, velocity: f64) -> Outcome {
    match ending.termination {
        Termination::NothingMoves => Outcome::AtRest,
        Termination::EndTime | Termination::StepLimit => Outcome::OutOfTime,
        _ if velocity < -REST_FRACTION * ending.scenario.impact_speed => Outcome::Rebounded,
        _ if velocity > REST_FRACTION * ending.scenario.impact_speed => Outcome::Separated,
        _ => Outcome::AtRest,
    }
}

/// Time after which release from the edge has reached the axis of the projectile [s].
fn edge_release(ending: &Ending<'_>) -> f64 {
    0.5 * ending.scenario.projectile.diameter / ending.grid.bodies[0].wave_speed_at_rest()
}

fn details(ending: &Ending<'_>) -> Vec<Detail> {
    let (scenario, grid) = (ending.scenario, ending.grid);
    let detail = |name, unit, value| Detail { name, unit, value };
    let mut details = vec![detail(
        "edge release reaches the axis",
        "us",
        edge_release(ending) * 1e6,
    )];
    if let Some(force) = ending.interface.plateau() {
        let stress = force / scenario.projectile.area();
        details.push(detail("interface stress, plateau", "GPa", stress * 1e-9));
    }
    let front = match &scenario.target {
        TargetBody::Layers { layers, .. } => layers.first().map(|plate| &*plate.material),
        _ => None,
    };
    let projectile = &scenario.projectile.material;
    if let Some((speed, pressure)) = impedance_match(projectile, front, scenario.impact_speed) {
        details.push(detail("impedance match: particle speed", "m/s", speed));
        details.push(detail(
            "impedance match: pressure without strength",
            "GPa",
            pressure * 1e-9,
        ));
    }
    if ending.back.free {
        details.push(detail(
            "largest speed of the back face",
            "m/s",
            ending.back.largest,
        ));
    }
    details.push(detail("spall planes", "", grid.spalls.len() as f64));
    if let Some(first) = grid.spalls.first() {
        details.push(detail(
            "first spall plane, below the struck face",
            "mm",
            first.position * 1e3,
        ));
        details.push(detail("first spall", "us", first.time * 1e6));
        if ending.back.free {
            let pull_back = ending.back.largest - ending.back.smallest_after;
            details.push(detail("pull-back of the back face", "m/s", pull_back));
        }
    }
    details
}

fn warnings(ending: &Ending<'_>, result: &RunResult) -> Vec<String> {
    let (scenario, grid) = (ending.scenario, ending.grid);
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
    let release = edge_release(ending);
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
    let mut bodies = vec![("projectile".to_owned(), &scenario.projectile.material)];
    if let TargetBody::Layers { layers, .. } = &scenario.target {
        for (i, plate) in layers.iter().enumerate() {
            let name = match layers.len() {
                1 => "target".to_owned(),
                _ => format!("layer {}", i + 1),
            };
            bodies.push((name, &plate.material));
        }
    }
    for (body, (name, material)) in bodies.into_iter().enumerate() {
        warn_of_material(&name, material, grid.views(body), true, &mut warnings);
        if grid.bodies[body].spall_strength.is_none() {
            warnings.push(format!(
                "the {name}'s material has no spall strength and holds any tension: give `fdm.spall_strength` or \
                 `materials.NAME.spall_strength`"
            ));
        }
    }
    warnings
}
