//! Scheme `conservative`: the run from impact to its end.

use super::{mesh, part::Role, solver::StepControl, state::State, warnings::warnings};
use crate::{
    Error, Scenario,
    case::ErosionStrain,
    error::NumericalError,
    history::{ElementState, Profile, Recorder, Sample},
    model::{Control, Progress},
    outcome::{Outcome, RunResult, Termination},
    scenario::TargetBody,
};

/// Courant number when a case gives none.
const DEFAULT_COURANT: f64 = 0.8;
/// Strain at which an element erodes when a case gives none.
const DEFAULT_EROSION_STRAIN: f64 = 2.0;
/// Time steps after which a run is ended when a case gives none.
const DEFAULT_MAX_STEPS: u64 = 20_000_000;
/// Largest energy residual of a run that counts.
pub const ENERGY_TOLERANCE: f64 = 1e-3;
/// Largest momentum residual of a run that counts.
pub const MOMENTUM_TOLERANCE: f64 = 1e-9;
/// Steps between two looks at the books.
const AUDIT_INTERVAL: u64 = 128;
/// Part of the impact speed below which a projectile counts as stopped.
const REST_FRACTION: f64 = 0.01;
/// Part of the initial energy that may still dissipate within the last window of a run.
const QUIET_FRACTION: f64 = 1e-6;

/// A run of the conservative scheme.
#[derive(Debug)]
pub struct Conservative<'a> {
    scenario: &'a Scenario,
    pub(super) state: State,
    control: StepControl,
    watch: Watch,
}

/// What is followed during a run.
#[derive(Debug, Default)]
struct Watch {
    largest_depth: f64,
    peak_force: f64,
    first_time_step: f64,
    smallest_time_step: f64,
    energy_residual: f64,
    momentum_residual: f64,
    /// Time and depth at which the projectile's momentum was first used up.
    at_rest: Option<(f64, f64)>,
    /// Whether the projectile touched the target at any time since the window began.
    touched: bool,
    window_start: f64,
    window_dissipation: f64,
    window_depth: f64,
}

impl<'a> Conservative<'a> {
    /// The chain at the moment of impact.
    pub fn new(scenario: &'a Scenario) -> Self {
        let options = &scenario.chain;
        let erosion_strain = match options
            .erosion_strain
            .unwrap_or(ErosionStrain::At(DEFAULT_EROSION_STRAIN))
        {
            ErosionStrain::At(strain) => strain,
            ErosionStrain::Never => f64::INFINITY,
        };
        Self {
            scenario,
            state: mesh::build(scenario),
            control: StepControl {
                courant: options.courant.unwrap_or(DEFAULT_COURANT),
                viscosity: options.artificial_viscosity.unwrap_or_default(),
                damping_ratio: options.damping_ratio.unwrap_or(0.0),
                erosion_strain,
            },
            watch: Watch::default(),
        }
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// [`Error::Numerical`] when an element inverts or the books do not balance; [`Error::Cancelled`].
    pub fn run(mut self, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let mut recorder = control.record.then(Recorder::new);
        let end_time = self.end_time();
        let max_steps = self.scenario.chain.max_steps.unwrap_or(DEFAULT_MAX_STEPS);
        self.record(&mut recorder);
        let termination = if self.scenario.impact_speed == 0.0 {
            Termination::NothingMoves
        } else {
            loop {
                self.state.advance(&self.control)?;
                self.follow();
                self.record(&mut recorder);
                if let Some(event) = self.event() {
                    break event;
                }
                if self.state.time >= end_time {
                    break Termination::EndTime;
                }
                if self.state.step >= max_steps {
                    break Termination::StepLimit;
                }
                if self.state.step.is_multiple_of(AUDIT_INTERVAL) {
                    self.audit()?;
                    control.report(self.progress(end_time))?;
                }
                if self.is_quiet() {
                    break Termination::Quiescent;
                }
            }
        };
        self.audit()?;
        Ok(self.finish(termination, recorder))
    }

    /// Time at which a run without an `end_time` gives up: many times what waves and the shot itself take.
    fn end_time(&self) -> f64 {
        if let Some(time) = self.scenario.chain.end_time {
            return time.si();
        }
        let rod = &self.scenario.projectile;
        let speed = self.scenario.impact_speed.max(1.0);
        let mut time = 2.0 * rod.length / rod.material.bar_wave_speed() + 2.0 * rod.length / speed;
        match &self.scenario.target {
            TargetBody::Layers { layers, .. } => {
                for plate in layers {
                    let thickness = mesh::modelled_thickness(plate, self.scenario);
                    time +=
                        2.0 * thickness / plate.material.bar_wave_speed() + 2.0 * thickness / speed;
                }
            }
            TargetBody::RigidWall => {}
            TargetBody::ConstantPressure(pressure) => {
                time += rod.material.density.si() * rod.length * speed / pressure;
            }
        }
        20.0 * time
    }

    fn depth(&self) -> f64 {
        let state = &self.state;
        match (
            &self.scenario.target,
            state.face_segment(),
            state.tip_segment(),
        ) {
            (TargetBody::Layers { .. }, Some(face), _) => {
                state.nodes[state.segments[face].first_node].position
            }
            (TargetBody::ConstantPressure(_), _, Some(tip)) => {
                state.nodes[state.segments[tip].last_node].position
            }
            _ => 0.0,
        }
    }

    /// Keeps up extremes and the state of the projectile after a step.
    fn follow(&mut self) {
        let depth = self.depth();
        let (state, watch) = (&self.state, &mut self.watch);
        watch.largest_depth = watch.largest_depth.max(depth);
        watch.peak_force = watch.peak_force.max(state.contact_force);
        if state.step == 1 {
            watch.first_time_step = state.time_step;
            watch.smallest_time_step = state.time_step;
        }
        watch.smallest_time_step = watch.smallest_time_step.min(state.time_step);
        let tip_closed = state
            .tip_segment()
            .is_some_and(|tip| state.closed.get(tip) == Some(&true));
        watch.touched |= tip_closed;
        if watch.at_rest.is_none() {
            // The tail is the last to hear of the impact: no need to sum up before it slows down.
            let tail_slowed = state.nodes[0].velocity < self.scenario.impact_speed * 0.5;
            if tail_slowed && state.projectile_motion().1 <= 0.0 {
                watch.at_rest = Some((state.time, depth));
            }
        }
    }

    fn event(&self) -> Option<Termination> {
        let state = &self.state;
        if state.tip_segment().is_none() {
            return Some(Termination::ProjectileConsumed);
        }
        let TargetBody::Layers { layers, .. } = &self.scenario.target else {
            return None;
        };
        let thickness: Option<f64> = layers.iter().map(|plate| plate.thickness).sum();
        let passed = thickness.is_some_and(|thickness| self.depth() >= thickness);
        (passed || state.face_segment().is_none()).then_some(Termination::PassedBackFace)
    }

    /// Whether the shot is over: looked at once in a round trip of a wave in the projectile.
    fn is_quiet(&mut self) -> bool {
        let rod = &self.scenario.projectile;
        let window = 2.0 * rod.length / rod.material.bar_wave_speed();
        if self.state.time < self.watch.window_start + window {
            return false;
        }
        let books = &self.state.books;
        let dissipation =
            books.plastic[0] + books.plastic[1] + books.friction_work + books.eroded_energy;
        let watch = &mut self.watch;
        let flowing =
            dissipation - watch.window_dissipation > QUIET_FRACTION * books.initial_energy;
        let deepening = watch.largest_depth > watch.window_depth * (1.0 + 1e-9);
        let touched = watch.touched;
        watch.window_start = self.state.time;
        watch.window_dissipation = dissipation;
        watch.window_depth = watch.largest_depth;
        watch.touched = false;
        // A projectile that is still being pushed back has not got its rebound speed yet.
        let (mass, momentum) = self.state.projectile_motion();
        let still = (momentum / mass).abs() <= REST_FRACTION * self.scenario.impact_speed;
        let over = !touched || (watch.at_rest.is_some() && !deepening && still);
        over && !flowing
    }

    fn audit(&mut self) -> Result<(), Error> {
        let energy = self.state.energy().residual();
        let momentum = self.state.momentum().residual();
        let watch = &mut self.watch;
        watch.energy_residual = watch.energy_residual.max(energy.abs());
        watch.momentum_residual = watch.momentum_residual.max(momentum.abs());
        let fail = |what: String| {
            Err(NumericalError {
                what,
                step: self.state.step,
                time_us: self.state.time * 1e6,
                element: None,
                remedy: format!("lower `chain.courant` (now {})", self.control.courant),
            }
            .into())
        };
        if energy.is_nan() || energy.abs() > ENERGY_TOLERANCE {
            return fail(format!(
                "the energy book is off by {energy:.2e} of the initial energy, more than {ENERGY_TOLERANCE:e},"
            ));
        }
        if momentum.is_nan() || momentum.abs() > MOMENTUM_TOLERANCE {
            return fail(format!(
                "the momentum book is off by {momentum:.2e} of the initial momentum, more than {MOMENTUM_TOLERANCE:e},"
            ));
        }
        Ok(())
    }

    fn progress(&self, end_time: f64) -> Progress {
        let (mass, momentum) = self.state.projectile_motion();
        let slowed = 1.0 - momentum / (mass * self.scenario.impact_speed);
        Progress {
            step: self.state.step,
            time: self.state.time,
            fraction: (self.state.time / end_time)
                .max(0.95 * slowed)
                .clamp(0.0, 1.0),
            depth: self.watch.largest_depth,
        }
    }

    fn record(&self, recorder: &mut Option<Recorder>) {
        let Some(recorder) = recorder else { return };
        let state = &self.state;
        if recorder.wants_sample(state.step) {
            recorder.sample(self.sample());
        }
        if recorder.wants_profile(state.step) {
            recorder.profile(self.profile());
        }
    }

    fn sample(&self) -> Sample {
        let state = &self.state;
        let tip = state.tip_segment().map(|tip| state.segments[tip].last_node);
        let tail = state
            .segments
            .first()
            .map_or(0, |segment| segment.first_node);
        let (mass, momentum) = state.projectile_motion();
        let face = state
            .face_segment()
            .map(|face| state.segments[face].first_node);
        let projectile_length = state
            .segments
            .iter()
            .filter(|segment| state.parts[segment.part].role == Role::Projectile)
            .map(|segment| {
                state.nodes[segment.last_node].position - state.nodes[segment.first_node].position
            })
            .sum();
        Sample {
            time: state.time,
            step: state.step,
            tip_velocity: tip.map_or(0.0, |i| state.nodes[i].velocity),
            tail_velocity: state.nodes[tail].velocity,
            interface_velocity: face.map_or(0.0, |i| state.nodes[i].velocity),
            mean_velocity: if mass > 0.0 { momentum / mass } else { 0.0 },
            tip_position: tip.map_or(0.0, |i| state.nodes[i].position),
            depth: self.depth(),
            projectile_length,
            contact_force: state.contact_force,
            back_force: state.back_force,
            energy: state.energy(),
            momentum: state.momentum(),
        }
    }

    fn profile(&self) -> Profile {
        let state = &self.state;
        let total: usize = state.segments.iter().map(|s| s.elements().len()).sum();
        // A finer mesh than a picture can show is thinned out.
        let stride = total.div_ceil(400).max(1);
        let mut elements = Vec::with_capacity(total / stride + 1);
        for segment in &state.segments {
            let part = &state.parts[segment.part];
            for e in segment.elements().step_by(stride) {
                let node = e + segment.part;
                elements.push(ElementState {
                    part: segment.part,
                    initial_position: state.elements[e].initial_position,
                    position: 0.5 * (state.nodes[node].position + state.nodes[node + 1].position),
                    length: state.elements[e].length,
                    stress: state.elements[e].stress,
                    strain: state.elements[e].strain,
                    plastic_strain: state.elements[e].plastic_strain,
                    diameter: part.diameter_at(state.elements[e].strain),
                    temperature: state.elements[e].temperature,
                });
            }
        }
        Profile {
            time: state.time,
            elements,
        }
    }

    fn finish(self, termination: Termination, recorder: Option<Recorder>) -> RunResult {
        let history = recorder.map(|mut recorder| {
            recorder.sample(self.sample());
            recorder.profile(self.profile());
            recorder.finish()
        });
        let state = &self.state;
        let mut result = RunResult {
            model: "chain",
            scheme: "conservative",
            outcome: self.outcome(termination),
            termination,
            depth_of_penetration: None,
            largest_depth: None,
            permanent_depth: None,
            residual_velocity: 0.0,
            projectile_final_length: 0.0,
            projectile_final_diameter: None,
            projectile_final_mass: 0.0,
            time_to_rest: None,
            peak_force: self.watch.peak_force,
            end_time: state.time,
            steps: state.step,
            first_time_step: self.watch.first_time_step,
            smallest_time_step: self.watch.smallest_time_step,
            eroded_elements: (0, 0),
            largest_plastic_strain: (0.0, 0.0),
            largest_temperature: (0.0, 0.0),
            energy: state.energy(),
            momentum: state.momentum(),
            energy_residual: self.watch.energy_residual,
            momentum_residual: self.watch.momentum_residual,
            warnings: Vec::new(),
            history,
        };
        let (mass, momentum) = state.projectile_motion();
        result.projectile_final_mass = mass;
        result.residual_velocity = if mass > 0.0 { momentum / mass } else { 0.0 };
        self.sum_up_elements(&mut result);
        result.time_to_rest = self.watch.at_rest.map(|(time, _)| time);
        if self.scenario.target != TargetBody::RigidWall {
            let largest = self.watch.largest_depth;
            result.largest_depth = Some(largest);
            result.depth_of_penetration =
                Some(self.watch.at_rest.map_or(largest, |(_, depth)| depth));
        }
        result.warnings = warnings(self.scenario, &result, self.control.erosion_strain);
        result
    }

    /// Results that are sums or extremes over all elements.
    fn sum_up_elements(&self, result: &mut RunResult) {
        let state = &self.state;
        let mut permanent_depth = 0.0;
        let mut length = 0.0;
        let mut diameter: Option<f64> = None;
        let mut first = 0;
        for part in &state.parts {
            for e in first..first + part.elements {
                let (strain, temperature) = (
                    state.elements[e].plastic_strain,
                    state.elements[e].temperature,
                );
                let rest = state.elements[e].rest_length;
                let unloaded = part.length_at(rest, state.elements[e].plastic_axial);
                match part.role {
                    Role::Projectile => {
                        let largest = &mut result.largest_plastic_strain.0;
                        *largest = largest.max(strain);
                        result.largest_temperature.0 =
                            result.largest_temperature.0.max(temperature);
                        result.eroded_elements.0 += usize::from(state.elements[e].eroded);
                        if !state.elements[e].eroded {
                            length += unloaded;
                            let here = part.diameter_at(state.elements[e].plastic_axial);
                            diameter = Some(diameter.map_or(here, |most| most.max(here)));
                        }
                    }
                    Role::Target => {
                        let largest = &mut result.largest_plastic_strain.1;
                        *largest = largest.max(strain);
                        result.largest_temperature.1 =
                            result.largest_temperature.1.max(temperature);
                        result.eroded_elements.1 += usize::from(state.elements[e].eroded);
                        permanent_depth += if state.elements[e].eroded {
                            rest
                        } else {
                            rest - unloaded
                        };
                    }
                }
            }
            first += part.elements;
        }
        result.projectile_final_length = length;
        result.projectile_final_diameter = diameter;
        result.permanent_depth = match self.scenario.target {
            TargetBody::Layers { .. } => Some(permanent_depth),
            TargetBody::ConstantPressure(_) => Some(self.watch.largest_depth),
            TargetBody::RigidWall => None,
        };
    }

    fn outcome(&self, termination: Termination) -> Outcome {
        match termination {
            Termination::PassedBackFace => return Outcome::Perforated,
            Termination::ProjectileConsumed => return Outcome::ProjectileEroded,
            Termination::EndTime | Termination::StepLimit => return Outcome::OutOfTime,
            Termination::NothingMoves => return Outcome::AtRest,
            Termination::Quiescent | Termination::TipStopped => {}
        }
        let (mass, momentum) = self.state.projectile_motion();
        let ratio = momentum / (mass * self.scenario.impact_speed);
        if ratio < -REST_FRACTION {
            Outcome::Rebounded
        } else if ratio > REST_FRACTION {
            Outcome::Separated
        } else {
            Outcome::AtRest
        }
    }
}
