//! From the grid at the end of a run to its result.

use super::run::Rod;
use crate::{
    fdm::warnings::of_materials,
    outcome::{Outcome, REST_FRACTION, RunResult, Termination},
    scenario::TargetBody,
    solver::monitor::RunMonitor,
    units::significant,
    validity::{
        border_shear_warning, column_mesh_warnings, plastic_shock_warning, pushed_column_warning,
    },
};

/// Strain beyond which a cell would have eroded in the chain.
const LARGEST_STRAIN: f64 = 2.0;

/// Adds depths, what is left of the projectile, and warnings.
pub(super) fn complete(rod: &Rod<'_>, result: &mut RunResult, monitor: &RunMonitor) {
    let (scenario, grid) = (rod.scenario, &rod.grid);
    let (mass, momentum) = grid.motion(0);
    let depth = match scenario.target {
        TargetBody::RigidWall => None,
        _ => Some(monitor.depth_at_rest()),
    };
    result.depth_of_penetration = depth;
    result.largest_depth = depth.map(|_| monitor.largest_depth);
    let cells_of = |bodies: std::ops::Range<usize>| {
        let own = grid
            .segments
            .iter()
            .filter(move |s| bodies.contains(&s.body));
        own.flat_map(|segment| segment.cells.clone().map(|c| grid.cells.get(c)))
    };
    result.permanent_depth = match scenario.target {
        TargetBody::Layers { .. } => {
            let shortened = cells_of(1..grid.bodies.len())
                .map(|cell| cell.rest_length() - cell.unloaded_length());
            Some(shortened.sum())
        }
        TargetBody::ConstantPressure(_) => Some(monitor.largest_depth),
        TargetBody::RigidWall => None,
    };
    result.residual_velocity = Some(momentum / mass);
    result.projectile_final_length = Some(cells_of(0..1).map(|cell| cell.unloaded_length()).sum());
    let widths = cells_of(0..1).map(|cell| grid.bodies[0].unloaded_diameter(&cell));
    result.projectile_final_diameter = Some(widths.fold(0.0, f64::max));
    result.projectile_final_mass = Some(mass);
    result.warnings = warnings(rod, result);
    let strains = cells_of(0..grid.bodies.len()).map(|cell| cell.strain().abs());
    let strain = strains.fold(0.0, f64::max);
    if strain > LARGEST_STRAIN {
        result.warnings.push(format!(
            "a cell reached a strain of {}: `fdm` has no erosion and holds crushed material in place; compare with the model \
             `chain`, which erodes it",
            significant(strain, 3)
        ));
    }
}

/// Part of the time to rest below which a contact, which alone stops the projectile, has opened and closed again and again.
const LEAST_CONTACT: f64 = 0.95;

pub(super) fn outcome(rod: &Rod<'_>, termination: Termination, monitor: &RunMonitor) -> Outcome {
    match termination {
        Termination::PassedBackFace => return Outcome::Perforated,
        Termination::NothingMoves => return Outcome::AtRest,
        Termination::EndTime | Termination::StepLimit if monitor.at_rest.is_none() => {
            return Outcome::OutOfTime;
        }
        _ => {}
    }
    let (mass, momentum) = rod.grid.motion(0);
    let ratio = momentum / (mass * rod.scenario.impact_velocity);
    if ratio < -REST_FRACTION {
        Outcome::Rebounded
    } else if ratio > REST_FRACTION {
        Outcome::Separated
    } else {
        Outcome::AtRest
    }
}

fn warnings(rod: &Rod<'_>, result: &RunResult) -> Vec<String> {
    let (scenario, grid) = (rod.scenario, &rod.grid);
    let mut warnings = Vec::new();
    match result.outcome {
        Outcome::OutOfTime => warnings.push(
            "the run was ended before the impact was over: raise `fdm.end_time` or `fdm.max_steps`".to_owned(),
        ),
        Outcome::Perforated => warnings.push(
            "the target is perforated: a column without a plug or a bulge overestimates its resistance; the residual velocity \
             is indicative"
                .to_owned(),
        ),
        _ => warnings.extend(pushed_column_warning(scenario, result.depth_of_penetration)),
    }
    if let (Some(contact), Some(rest)) = (result.contact_time, result.time_to_rest)
        && contact < LEAST_CONTACT * rest
    {
        warnings.push(format!(
            "peak force and contact time depend on the mesh: the contact opens and closes, and was closed for {} us of the {} us to rest",
            significant(contact * 1e6, 3),
            significant(rest * 1e6, 3)
        ));
    }
    let viscosity = rod.options.artificial_viscosity;
    warnings.extend(plastic_shock_warning(
        "fdm.artificial_viscosity",
        scenario,
        viscosity,
    ));
    let heated = scenario.options.chain.adiabatic_heating();
    let mut bodies = of_materials(scenario, grid, heated).into_iter();
    warnings.extend(bodies.next().into_iter().flatten());
    if scenario.layers().is_empty() {
        return warnings;
    }
    let cell = scenario.modelled_length() / f64::from(rod.options.target_elements);
    let depth = result.depth_of_penetration.unwrap_or(0.0);
    warnings.extend(border_shear_warning("fdm", rod.options.border_shear));
    warnings.extend(column_mesh_warnings(scenario, depth, "cell", cell));
    warnings.extend(bodies.flatten());
    warnings
}
