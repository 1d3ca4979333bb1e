//! Samples, outcome and results of a run.

use super::{
    bonded::Bonded,
    fracture::{LEAST_BY_STRESS, Softenings},
    run::{Impact, State},
    shape::Rigid,
};
use crate::{
    history::{ElementState, Sample},
    material::Reached,
    outcome::{Detail, Outcome, REST_FRACTION, RunResult, Termination},
    problem::RearFaceCondition,
    solver::{interface::Solver, monitor::RunMonitor},
    units::significant,
    validity::THROUGH_FIXED_FACE,
};

/// Mean velocity of the projectile along the normal of the face [m/s].
fn mean_velocity<B: Bonded<D>, const D: usize>(run: &Impact<'_, B, D>) -> f64 {
    run.projectile_momentum() / run.inertia.mass
}

/// Velocity of the projectile: along the normal, or its speed where it came at an angle, negative away from the target [m/s].
fn residual_velocity<B: Bonded<D>, const D: usize>(run: &Impact<'_, B, D>) -> f64 {
    match run.rigid {
        Rigid::Wall => mean_velocity(run),
        Rigid::Projectile(_) => signed_speed(run.state.flight.velocity),
    }
}

pub(super) fn outcome<B: Bonded<D>, const D: usize>(
    run: &Impact<'_, B, D>,
    termination: Termination,
) -> Outcome {
    outcome_at(
        (residual_velocity(run), run.scenario.impact_velocity),
        termination,
    )
}

/// Speed, negative where it is away from the target [m/s].
pub(super) fn signed_speed([across, along]: [f64; 2]) -> f64 {
    across.hypot(along).copysign(along)
}

/// Outcome at a residual velocity, of an impact at another [m/s].
pub(super) fn outcome_at((velocity, impact): (f64, f64), termination: Termination) -> Outcome {
    let least = REST_FRACTION * impact;
    match termination {
        Termination::NothingMoves => Outcome::AtRest,
        Termination::LeftTarget => Outcome::Perforated,
        Termination::EndTime | Termination::StepLimit => Outcome::OutOfTime,
        _ if velocity < -least => Outcome::Rebounded,
        _ if velocity > least => Outcome::Separated,
        _ => Outcome::AtRest,
    }
}

/// State at this time.
pub(super) fn sample<B: Bonded<D>, const D: usize>(
    run: &Impact<'_, B, D>,
    monitor: &RunMonitor,
) -> Sample {
    let (body, state) = (&run.body, &run.state);
    let [(front, front_velocity), (back, back_velocity)] = run.faces.map(|(row, place)| {
        (
            body.position(row, place)[D - 1],
            body.velocity(row, place)[D - 1],
        )
    });
    let mut sample = Sample::default();
    sample.time = state.time;
    sample.step = run.clock().step;
    sample.mean_velocity = mean_velocity(run);
    sample.depth = monitor.depth;
    sample.energy = run.energy();
    sample.momentum = run.momentum();
    sample.contact_force = run.contact_force();
    sample.back_force = state.support_force;
    sample.crack_length = if D == 2 { run.front.size } else { f64::NAN };
    sample.crack_reach = run.front.reach;
    match run.rigid {
        Rigid::Wall => {
            sample.tip_velocity = back_velocity;
            sample.tail_velocity = front_velocity;
            sample.tip_position = back;
            sample.projectile_length = back - front;
        }
        Rigid::Projectile(_) => {
            let (pose, length) = (run.pose(), run.scenario.projectile.length);
            let at = |point| state.flight.velocity_at(pose.place(point))[1];
            sample.tip_velocity = at([0.0; 2]);
            sample.tail_velocity = at([0.0, -length]);
            sample.interface_velocity = front_velocity;
            sample.back_velocity = back_velocity;
            sample.tip_position = pose.tip[1];
            sample.projectile_length = length;
        }
    }
    sample
}

/// State at a gauge that was at a position before the impact [m]: between the two rows around it.
pub(super) fn at_gauge<B: Bonded<D>, const D: usize>(
    run: &Impact<'_, B, D>,
    position: f64,
    rows: &[ElementState],
) -> ElementState {
    if position < 0.0 && run.rigid != Rigid::Wall {
        let gone = ElementState::gone(0, position);
        let place = run.pose().place([0.0, position]);
        return ElementState {
            position: place[1],
            displacement: place[1] - position,
            velocity: run.state.flight.velocity_at(place)[1],
            ..gone
        };
    }
    let behind = rows.partition_point(|row| row.initial_position <= position);
    let state = match (
        behind.checked_sub(1).and_then(|row| rows.get(row)),
        rows.get(behind),
    ) {
        (Some(a), Some(b)) => {
            let way = b.initial_position - a.initial_position;
            a.between(b, (position - a.initial_position) / way)
        }
        (Some(end), None) | (None, Some(end)) => *end,
        (None, None) => ElementState::gone(run.part(), position),
    };
    ElementState {
        initial_position: position,
        ..state
    }
}

/// Adds velocities, sizes and warnings.
pub(super) fn complete<B: Bonded<D>, const D: usize>(
    run: &Impact<'_, B, D>,
    result: &mut RunResult,
    monitor: &RunMonitor,
) {
    result.residual_velocity = Some(residual_velocity(run));
    result.projectile_final_length = Some(match run.rigid {
        Rigid::Wall => sample(run, monitor).projectile_length,
        Rigid::Projectile(_) => run.scenario.projectile.length,
    });
    if run.rigid != Rigid::Wall {
        result.largest_depth = Some(monitor.largest_depth);
    }
    if run.inertia.moment.is_some() {
        add_directions(run, result);
    }
    if run.body.softening().is_some() {
        add_cracks(run, result);
    }
    result.details = details(run);
    result.warnings = warnings(run, result);
}

/// Adds cracks and pieces.
fn add_cracks<B: Bonded<D>, const D: usize>(run: &Impact<'_, B, D>, result: &mut RunResult) {
    let mut front = run.front.clone();
    front.follow(&run.body, &run.notches, run.state.time);
    result.cracks = Some(front.results(&run.body, &run.notches));
    let origin = match run.rigid {
        Rigid::Wall => "projectile",
        Rigid::Projectile(_) => "target",
    };
    let pieces = run.body.pieces();
    if pieces.len() > 1 {
        let spacing = run.body.spacing();
        result.fragments = pieces
            .iter()
            .map(|piece| piece.fragment(origin, spacing))
            .collect();
    }
}

fn details<B: Bonded<D>, const D: usize>(run: &Impact<'_, B, D>) -> Vec<Detail> {
    let body = &run.body;
    let mut details = vec![
        Detail::new("spacing of the particles", "mm", body.spacing() * 1e3),
        Detail::new("particles", "", body.particles().count() as f64),
    ];
    details.extend(body.details(run.scenario, &run.inertia));
    let (stretch, tension) = (run.state.largest_stretch, run.state.largest_tension);
    details.extend(body.extremes_in_words(stretch, tension));
    if run.inertia.moment.is_some() {
        let rate = -run.state.flight.spin;
        details.push(Detail::new(
            "angular velocity of the projectile",
            "rad/s",
            rate,
        ));
    }
    if let Some(softening) = body.softening() {
        let pieces = body.pieces();
        let single = pieces.iter().filter(|piece| piece.particles == 1).count();
        details.extend([
            Detail::new("softening of the bonds", "", softening.end),
            Detail::new("pieces of one particle", "", single as f64),
        ]);
    }
    details
}

/// Adds where a projectile that came at an angle goes.
fn add_directions<B: Bonded<D>, const D: usize>(run: &Impact<'_, B, D>, result: &mut RunResult) {
    let flight = &run.state.flight;
    let [[u, w], [cosine, sine]] = [flight.velocity, flight.turn];
    result.flight_direction = Some(u.atan2(w));
    result.projectile_axis = Some((-sine).atan2(cosine));
}

fn warnings<B: Bonded<D>, const D: usize>(
    run: &Impact<'_, B, D>,
    result: &RunResult,
) -> Vec<String> {
    let mut warnings = run.body.notes(run.scenario);
    match run.body.softenings(run.scenario) {
        Some(softenings) => warnings.extend(fracture_warnings(run, &softenings)),
        None => {
            let State {
                largest_stretch,
                largest_tension,
                ..
            } = run.state;
            warnings.extend(run.body.limits_in_words(largest_stretch, largest_tension));
        }
    }
    let flow = run.body.flow();
    let reached = Reached {
        plastic_strain: flow.plastic_strain,
        strain_rate: None,
        temperature: flow.temperature,
    };
    let heated = run.scenario.options.particles.adiabatic_heating();
    let mut bodies = run.scenario.bodies().into_iter();
    let of_particles = match run.rigid {
        Rigid::Wall => bodies.next(),
        Rigid::Projectile(_) => bodies.nth(1),
    };
    if let Some((what, material)) = of_particles {
        warnings.extend(reached.warnings(&what, material, heated));
    }
    let idle = run.body.idle(&run.notches);
    if !idle.is_empty() {
        warnings.push(format!(
            "`particles.notches`: number {} cuts no bond of the body: it lies outside of it or between two particles",
            numbered(&idle)
        ));
    }
    if result.outcome == Outcome::Perforated
        && run.scenario.rear_face() == Some(RearFaceCondition::Fixed)
    {
        warnings.push(THROUGH_FIXED_FACE.to_owned());
    }
    if result.outcome == Outcome::OutOfTime {
        warnings.push(
            "the run ended before the bodies parted: the residual velocity is that of the moment; raise `particles.end_time`"
                .to_owned(),
        );
    }
    warnings
}

/// What a fracture answer depends on beside the material.
fn fracture_warnings<B: Bonded<D>, const D: usize>(
    run: &Impact<'_, B, D>,
    softenings: &Softenings,
) -> Vec<String> {
    let spacing = run.body.spacing() * 1e3;
    let mut warnings = Vec::new();
    if softenings.fitting < 1.0 {
        let fitting = spacing * softenings.fitting;
        warnings.push(format!(
            "cracks take the fracture energy, but start at less than the tensile strength of the material: particles of {} mm have \
             both, and those of this run are {} mm apart; set `particles.spacing` where that can be computed",
            significant(fitting, 2),
            significant(spacing, 3)
        ));
    }
    let by_stress = run.body.softening().filter(|law| law.by_stress);
    if by_stress.is_some_and(|law| law.end < LEAST_BY_STRESS) {
        warnings.push(format!(
            "`particles.failure_criterion`: with a softening below {} the energy that a crack takes by the principal stress grows with the size of \
             the body; the strength does not: reduce `particles.spacing`, or give \"elongation\" where cracks start at notches",
            LEAST_BY_STRESS
        ));
    }
    if run.body.broken_bonds() > 0 {
        warnings.push(
            "paths and pieces of cracks scatter with the packing: give mean and spread over several values of `particles.seed` (`percuss run --seeds N`)"
                .to_owned(),
        );
    }
    warnings
}

pub(super) fn numbered(numbers: &[usize]) -> String {
    let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
    numbers.join(", ")
}
