//! End of a run, its outcome and its result.

use serde::{Deserialize, Serialize};

use super::{
    super::{results::of_cracks, warnings::warnings_of_cavity},
    Cavity, forces,
    node::Node,
    slice::{Slice, Undeformed},
    state::State,
};
use crate::{
    history::{ElementState, Profile, Sample},
    material::Reached,
    outcome::{Detail, Outcome, PLANE_IMPACT, REST_FRACTION, RunResult, Termination},
    scenario::Scenario,
    solver::monitor::RunMonitor,
    units::significant,
};

/// Part of its depth by which a floor may still sink in a window of a run that is over.
const QUIET_FRACTION: f64 = 1e-6;

/// One round trip of a wave in the projectile, in which a run that is over changes no more.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Window {
    start: f64,
    /// When it is over at the earliest.
    end: f64,
    depth: f64,
    /// Momentum of the projectile when the window began.
    momentum: f64,
    pub(super) touched: bool,
}

impl Window {
    /// Why a run is over at the end of a window, if it is.
    pub(super) fn end(
        &mut self,
        state: &State,
        scenario: &Scenario,
        monitor: &RunMonitor,
    ) -> Option<Termination> {
        if state.time < self.end {
            return None;
        }
        let rod = &scenario.projectile;
        let window = 2.0 * rod.length.max(rod.diameter) / rod.material.bar_wave_speed();
        if state.time < self.start + window {
            self.end = self.start + window;
            return None;
        }
        let sinks =
            state.floor.depth > self.depth * (1.0 + QUIET_FRACTION) || state.floor.speed > 0.0;
        let touched = self.touched;
        self.start = state.time;
        self.depth = state.floor.depth;
        self.touched = false;
        let (mass, momentum) = state.rod.motion();
        let change = momentum - self.momentum;
        self.momentum = momentum;
        if sinks {
            return None;
        }
        if mass == 0.0 {
            return Some(Termination::ProjectileConsumed);
        }
        monitor.at_rest?;
        if state
            .rod
            .pieces_approach(REST_FRACTION * scenario.impact_velocity)
        {
            return None;
        }
        // What is left may creep forward behind a floor that it never reaches: that is no motion to wait for.
        let is_slow =
            |momentum: f64| (momentum / mass).abs() <= REST_FRACTION * scenario.impact_velocity;
        let still = is_slow(momentum);
        match touched {
            false => (momentum <= 0.0 || still).then_some(Termination::Parted),
            // A projectile that is still being pushed back has not got its rebound speed yet.
            true => (still && is_slow(change)).then_some(Termination::Quiescent),
        }
    }
}

/// Outcome of a run that was ended for a reason, and its criterion.
pub(super) fn outcome(
    termination: Termination,
    state: &State,
    monitor: &RunMonitor,
    impact_velocity: f64,
) -> (Outcome, String) {
    let (mass, momentum) = state.rod.motion();
    match termination {
        Termination::PassedBackFace => {
            let words = format!(
                "the crater reached the rear face at {} us",
                significant(state.time * 1e6, 4)
            );
            return (Outcome::Perforated, words);
        }
        Termination::NothingMoves => {
            return (Outcome::AtRest, "the impact velocity is zero".to_owned());
        }
        _ if mass == 0.0 => {
            let words = "no element of the projectile is left".to_owned();
            return (Outcome::ProjectileEroded, words);
        }
        Termination::EndTime | Termination::StepLimit if monitor.at_rest.is_none() => {
            let words = "the projectile still moved forward when the run was ended";
            return (Outcome::OutOfTime, words.to_owned());
        }
        _ => {}
    }
    let ratio = momentum / (mass * impact_velocity);
    let speed = format!(
        "the projectile's mean speed at the end is {} % of the impact velocity",
        significant(100.0 * ratio, 3)
    );
    let percent = REST_FRACTION * 100.0;
    if ratio < -REST_FRACTION {
        (Outcome::Rebounded, format!("{speed}, below -{percent} %"))
    } else {
        (Outcome::AtRest, format!("{speed}, not below -{percent} %"))
    }
}

/// Adds depths, what is left of the projectile, fragments and warnings.
pub(super) fn complete(cavity: &Cavity<'_>, result: &mut RunResult, monitor: &RunMonitor) {
    let (scenario, state) = (cavity.scenario, &cavity.state);
    let (mass, momentum) = state.rod.motion();
    let remnant = Remnant::of(
        state.rod.slices().map(|(slice, ..)| slice),
        &state.rod.front.size,
    );
    result.depth_of_penetration = Some(monitor.depth_at_rest());
    result.largest_depth = Some(monitor.largest_depth);
    result.permanent_depth = Some(state.floor.depth);
    result.residual_velocity = Some(if mass > 0.0 { momentum / mass } else { 0.0 });
    result.projectile_final_length = Some(remnant.length);
    result.projectile_final_diameter = (remnant.length > 0.0).then_some(2.0 * remnant.radius);
    result.projectile_final_mass = Some(mass);
    result.fragments = state.rod.fragments();
    result.details = of_cracks(state.cracks.len(), state.cracks.first().copied());
    let plane_impact = forces::plane_impact_force(scenario);
    if let Some(force) = plane_impact {
        result
            .details
            .push(Detail::new(PLANE_IMPACT, "kN", force * 1e-3));
    }
    let [plastic_strain, strain_rate, temperature] = state.rod.reached();
    let reached = Reached {
        plastic_strain,
        strain_rate: Some(strain_rate),
        temperature,
    };
    let erosion_strain = cavity.control.erosion_strain;
    result.warnings = warnings_of_cavity(scenario, result, &reached, erosion_strain);
    let first_contact =
        (monitor.peak_time < forces::edge_wave_time(scenario)).then_some(monitor.peak_force);
    let warning = forces::warning(scenario, first_contact, plane_impact);
    result.warnings.extend(warning);
    result.warnings.extend(warning_of_target_failure(state));
    result.warnings.splice(0..0, remnant.warning());
}

/// Logarithmic stretch beyond which a slice counts as separated: it takes 63 % of a bar's area, about what metals have lost at fracture.
const PARTED: f64 = 1.0;

/// What is left of the projectile, unloaded.
///
/// The release from a fast impact leaves the tail of the remnant with another velocity than its foot. Nothing in this solver fails in
/// tension, so a hot remnant is drawn out to a thread that grows until the run ends, and its length would be that of the thread.
#[derive(Debug, Default)]
struct Remnant {
    slices: usize,
    parted: usize,
    /// Length, in which a separated slice is as long as before the impact [m].
    length: f64,
    /// Length as it is drawn out [m].
    drawn_out: f64,
    /// Largest stretch of a slice, as a ratio of lengths.
    stretch: f64,
    /// Largest radius [m].
    radius: f64,
}

impl Remnant {
    fn of(slices: impl Iterator<Item = Slice>, size: &Undeformed) -> Self {
        slices.fold(Self::default(), |remnant, slice| {
            let (length, radius) = slice.unloaded(size);
            let stretch = length / size.length;
            let parted = stretch.ln() > PARTED;
            let counted = if parted { size.length } else { length };
            Self {
                slices: remnant.slices + 1,
                parted: remnant.parted + usize::from(parted),
                length: remnant.length + counted,
                drawn_out: remnant.drawn_out + length,
                stretch: remnant.stretch.max(stretch),
                radius: remnant.radius.max(radius),
            }
        })
    }

    fn warning(&self) -> Option<String> {
        let drawn_out = significant(self.drawn_out * 1e3, 3);
        (self.parted > 0).then(|| {
            format!(
                "the final projectile length counts {} of its last {} elements as long as before the impact: they were drawn out to as \
                 much as {} times that, where a metal parts, and nothing fails in tension here; drawn out, the projectile would be \
                 {drawn_out} mm long, and longer with time",
                self.parted,
                self.slices,
                significant(self.stretch, 2)
            )
        })
    }
}

fn warning_of_target_failure(state: &State) -> Option<String> {
    let (depth, time) = state.target_failure.as_ref()?.first?;
    Some(format!(
        "the target would fail in tension {} mm below its face after {} us, which the model `expanding-cavity` does not include; compare \
         with `chain.target_resistance = \"column\"`",
        significant(depth * 1e3, 3),
        significant(time * 1e6, 3)
    ))
}

pub(super) fn sample(state: &State) -> Sample {
    let (mass, momentum) = state.rod.motion();
    let (tail, tip) = (state.rod.tail(), state.rod.front.tip());
    let velocity = |node: Option<Node>| node.map_or(f64::NAN, |n| n.velocity);
    let place = |node: Option<Node>| node.map_or(f64::NAN, |n| n.position);
    let mut sample = Sample::default();
    sample.time = state.time;
    sample.step = state.step;
    sample.tip_velocity = velocity(tip);
    sample.tail_velocity = velocity(tail);
    sample.interface_velocity = state.far_field_velocity() + state.floor.speed;
    sample.back_velocity = match &state.rear_face {
        Some(face) => face.velocity_of_face(state.time),
        None => velocity(state.far_field.nodes.last()),
    };
    sample.mean_velocity = momentum / mass;
    sample.tip_position = place(tip) + state.floor.lost_length;
    sample.depth = state.position();
    sample.projectile_length = if mass > 0.0 {
        place(tip) - place(tail)
    } else {
        0.0
    };
    sample.contact_force = state.contact_force;
    sample.back_force = state.support_force();
    sample.energy = state.energy();
    sample.momentum = state.momentum();
    sample
}

pub(super) fn profile(state: &State) -> Profile {
    let place =
        |nodes: &[Node; 2]| 0.5 * (nodes[0].position + nodes[1].position) + state.floor.lost_length;
    let rod = state.rod.slices().map(|(slice, own, nodes)| ElementState {
        part: 0,
        initial_position: own.initial_position,
        position: place(&nodes),
        displacement: place(&nodes) - own.initial_position,
        length: slice.length,
        stress: slice.axial_stress(),
        strain: slice.strain,
        plastic_strain: slice.plastic.strain,
        diameter: 2.0 * slice.radius,
        temperature: slice.plastic.temperature,
        velocity: 0.5 * (nodes[0].velocity + nodes[1].velocity),
    });
    let far_field = state.far_field.strained().map(|mut spring| {
        if let Some(face) = &state.rear_face {
            spring.superpose(face.reflected(spring.middle, state.time));
        }
        ElementState {
            part: 1,
            initial_position: spring.middle,
            position: spring.middle + spring.displacement + state.floor.depth,
            displacement: spring.displacement,
            length: spring.length,
            stress: spring.stress,
            strain: spring.strain,
            plastic_strain: 0.0,
            diameter: 2.0 * (spring.area / std::f64::consts::PI).sqrt(),
            temperature: state.far_field.temperature,
            velocity: spring.velocity,
        }
    });
    Profile {
        time: state.time,
        elements: rod.chain(far_field).collect(),
    }
}
