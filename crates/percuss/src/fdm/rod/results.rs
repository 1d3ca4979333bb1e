//! From the grid at the end of a run to its result.

use super::{law::RodLaw, mesh};
use crate::{
    fdm::{
        grid::{Grid, Watch},
        numerics::numerics,
        warnings::warn_of_material,
    },
    history::Recorder,
    options::FdmOptions,
    outcome::{Outcome, RunResult, Termination},
    scenario::{Scenario, TargetBody},
    units::significant,
};

/// Strain beyond which a cell would have eroded in the chain.
const LARGEST_STRAIN: f64 = 2.0;

/// What a result is made of.
pub(super) struct Ending<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) options: &'a FdmOptions,
    pub(super) grid: &'a Grid<RodLaw>,
    pub(super) watch: &'a Watch,
    pub(super) termination: Termination,
    pub(super) rest_fraction: f64,
}

pub(super) fn sum_up(ending: &Ending<'_>, recorder: Option<Recorder>) -> RunResult {
    let Ending {
        scenario,
        grid,
        watch,
        ..
    } = *ending;
    let (mass, momentum) = grid.motion(0);
    // A crater floor that sprang back beyond the original face is no depth.
    let depth = match scenario.target {
        TargetBody::RigidWall => None,
        _ => Some(
            watch
                .at_rest
                .map_or(watch.largest_depth, |(_, depth)| depth.max(0.0)),
        ),
    };
    let mut result = RunResult::new(
        "fdm",
        "rod",
        outcome(ending, mass, momentum),
        ending.termination,
    );
    result.depth_of_penetration = depth;
    result.largest_depth = depth.map(|_| watch.largest_depth);
    let cells_of = |bodies: std::ops::Range<usize>| {
        let own = grid
            .segments
            .iter()
            .filter(move |s| bodies.contains(&s.body));
        own.flat_map(|segment| &grid.cells[segment.cells.clone()])
    };
    result.permanent_depth = match scenario.target {
        TargetBody::Layers { .. } => {
            let shortened = cells_of(1..grid.bodies.len())
                .map(|cell| cell.rest_length() - cell.unloaded_length());
            Some(shortened.sum())
        }
        TargetBody::ConstantPressure(_) => Some(watch.largest_depth),
        TargetBody::RigidWall => None,
    };
    result.residual_velocity = Some(momentum / mass);
    result.projectile_final_length = Some(cells_of(0..1).map(|cell| cell.unloaded_length()).sum());
    let widths = cells_of(0..1).map(|cell| grid.bodies[0].unloaded_diameter(cell));
    result.projectile_final_diameter = Some(widths.fold(0.0, f64::max));
    result.projectile_final_mass = Some(mass);
    result.time_to_rest = watch.at_rest.map(|(time, _)| time);
    result.peak_force = Some(watch.peak_force);
    result.contact_time = Some(watch.contact_time);
    result.end_time = Some(grid.time);
    result.numerics = Some(numerics(grid, watch));
    result.warnings = warnings(ending, &result);
    let strains = cells_of(0..grid.bodies.len()).map(|cell| cell.strain().abs());
    let strain = strains.fold(0.0, f64::max);
    if strain > LARGEST_STRAIN {
        result.warnings.push(format!(
            "a cell reached a strain of {}: `fdm` has no erosion and holds crushed material in place; compare with the model \
             `chain`, which erodes it",
            significant(strain, 3)
        ));
    }
    result.history = recorder.map(|recorder| recorder.finish(grid.sample(), grid.profile()));
    result
}

fn outcome(ending: &Ending<'_>, mass: f64, momentum: f64) -> Outcome {
    match ending.termination {
        Termination::PassedBackFace => return Outcome::Perforated,
        Termination::NothingMoves => return Outcome::AtRest,
        Termination::EndTime | Termination::StepLimit if ending.watch.at_rest.is_none() => {
            return Outcome::OutOfTime;
        }
        _ => {}
    }
    let ratio = momentum / (mass * ending.scenario.impact_speed);
    if ratio < -ending.rest_fraction {
        Outcome::Rebounded
    } else if ratio > ending.rest_fraction {
        Outcome::Separated
    } else {
        Outcome::AtRest
    }
}

fn warnings(ending: &Ending<'_>, result: &RunResult) -> Vec<String> {
    let (scenario, grid) = (ending.scenario, ending.grid);
    let mut warnings = Vec::new();
    match result.outcome {
        Outcome::OutOfTime => warnings.push(
            "the run was ended before the shot was over: raise `fdm.end_time` or `fdm.max_steps`".to_owned(),
        ),
        Outcome::Perforated => warnings.push(
            "the target is perforated: a column without a plug or a bulge overestimates its resistance; the residual velocity \
             is indicative"
                .to_owned(),
        ),
        _ => {}
    }
    let heated = scenario.options.chain.adiabatic_heating.unwrap_or(true);
    let rod = &scenario.projectile.material;
    warn_of_material("projectile", rod, grid.views(0), heated, &mut warnings);
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        return warnings;
    };
    let length = mesh::target_length(scenario);
    let cell = length / f64::from(ending.options.target_elements.unwrap_or(80));
    let shear = ending.options.border_shear.unwrap_or(0.577);
    let depth = result.depth_of_penetration.unwrap_or(0.0);
    if shear > 0.0 {
        warnings.push(format!(
            "the depth rests on the target closure (constraint factor and border shear C = {}): `fdm.border_shear = 0.0` gives \
             the other end of the range",
            significant(shear, 4)
        ));
    }
    if depth > 0.0 && depth < cell {
        warnings.push(format!(
            "the depth ({} mm) is less than one target cell ({} mm): see `percuss converge`",
            significant(depth * 1e3, 3),
            significant(cell * 1e3, 3)
        ));
    }
    let semi_infinite = layers.iter().any(|plate| plate.thickness.is_none());
    if semi_infinite && depth > 0.75 * length {
        warnings.push(format!(
            "the depth is close to the {} mm that stand for a semi-infinite target: give a thickness",
            significant(length * 1e3, 3)
        ));
    }
    for (i, plate) in layers.iter().enumerate() {
        let name = match layers.len() {
            1 => "target".to_owned(),
            _ => format!("layer {}", i + 1),
        };
        warn_of_material(
            &name,
            &plate.material,
            grid.views(i + 1),
            heated,
            &mut warnings,
        );
    }
    warnings
}
