//! Target closure `expanding-cavity`: a projectile that takes time to widen, on a crater floor that advances against the pressure
//! of an expanding cavity, carried by an elastic cone.
//!
//! It has a solver of its own: no part of the column is left in it.

mod block;
mod delay_line;
mod floor;
mod forces;
mod ground;
mod node;
mod plane_impact;
#[cfg(test)]
mod plate_tests;
mod projectile;
mod rear_face;
mod resistance;
mod results;
mod rod;
mod slice;
mod state;
#[cfg(test)]
mod tests;

use self::{
    floor::{Contact, Floor, Opposition},
    ground::Ground,
    projectile::{Failure, Projectile},
    rear_face::RearFace,
    resistance::Resistance,
    results::Watch,
    rod::Rod,
    slice::Metal,
    state::{Books, State, TargetFailure},
};
use super::{
    between::Moment,
    cone::{Cone, Grading},
    solver::StepControl,
};
use crate::{
    Error, Scenario,
    courant_retry::CourantRetry,
    history::Recorder,
    options::ErosionStrain,
    outcome::{RunResult, Termination},
    problem::BackFace,
    scenario::{Plate, TargetBody, modelled_thickness},
    solver::{Control, Progress},
};

const DEFAULT_COURANT: f64 = 0.5;
/// A run that fails numerically at the default Courant number is repeated with half of it, down to this one.
const SMALLEST_COURANT: f64 = 0.05;
const DEFAULT_EROSION_STRAIN: f64 = 2.0;
const DEFAULT_MAX_STEPS: u64 = 20_000_000;
/// Steps between two looks at the books.
const AUDIT_INTERVAL: u64 = 64;

/// Why a case cannot be run with this closure, if it cannot.
pub(super) fn not_applicable(scenario: &Scenario) -> Option<String> {
    let Some(plate) = struck(scenario) else {
        return Some(
            "the target closure `expanding-cavity` needs a target of one material".to_owned(),
        );
    };
    if scenario.resistance.is_some() {
        return None;
    }
    let yields = plate
        .material
        .strength
        .law()
        .initial_yield_stress(&plate.material);
    yields
        .is_none()
        .then(|| "the target closure `expanding-cavity` needs a target that yields".to_owned())
}

fn struck(scenario: &Scenario) -> Option<&Plate> {
    match &scenario.target {
        TargetBody::Layers { layers, .. } if layers.len() == 1 => layers.first(),
        _ => None,
    }
}

/// A run with this closure.
pub(super) struct Expanding<'a> {
    scenario: &'a Scenario,
    plate: &'a Plate,
    control: StepControl,
    state: State,
    watch: Watch,
}

impl<'a> Expanding<'a> {
    /// Runs to the end.
    ///
    /// # Errors
    /// [`Error::NotApplicable`] when [`not_applicable`] has a reason; [`Error::Numerical`] when a slice is crushed or the books do not balance;
    /// [`Error::Cancelled`].
    pub(super) fn run(
        scenario: &'a Scenario,
        control: &mut Control<'_>,
    ) -> Result<RunResult, Error> {
        let mut courant = CourantRetry::new(
            scenario.options.chain.courant,
            DEFAULT_COURANT,
            SMALLEST_COURANT,
        );
        loop {
            let mut run = Self::new(scenario, courant.number())?;
            match run.attempt(control) {
                Err(Error::Numerical(error)) => courant.halve(*error)?,
                Ok(mut result) => {
                    result.warnings.extend(courant.warning());
                    return Ok(result);
                }
                Err(error) => return Err(error),
            }
        }
    }

    fn new(scenario: &'a Scenario, courant: f64) -> Result<Self, Error> {
        let refuse = || Error::NotApplicable {
            model: "chain",
            reason: not_applicable(scenario).unwrap_or_default(),
        };
        let plate = struck(scenario).ok_or_else(refuse)?;
        let options = &scenario.options.chain;
        let projectile = &scenario.projectile;
        let area = projectile.mass / (projectile.material.density.si() * projectile.length);
        let heat = if options.adiabatic_heating.unwrap_or(true) {
            options.heat_fraction.unwrap_or(0.9)
        } else {
            0.0
        };
        let rate_effects = options.rate_effects.unwrap_or(true);
        let metal = Metal::new(&projectile.material, heat, rate_effects);
        let temperature = projectile
            .temperature
            .unwrap_or(projectile.material.room_temperature.si());
        let speed = scenario.impact_speed;
        let count = options.projectile_elements();
        let rod = Rod::new(metal, count, projectile.length, area, temperature, speed);
        let radius = (area / std::f64::consts::PI).sqrt();
        // The floor advances at about half the impact speed, and the flow under it is as deep as the projectile is thick.
        let rate = if rate_effects {
            speed / (2.0 * radius)
        } else {
            0.0
        };
        let free_rear_face = plate
            .thickness
            .filter(|_| rear_face(scenario) == BackFace::Free);
        let opposition = match &scenario.resistance {
            Some(own) => Opposition::Own(own.clone()),
            None => Opposition::Cavity(
                Resistance::new(&plate.material, radius, rate, heat, free_rear_face)
                    .ok_or_else(refuse)?,
            ),
        };
        let floor = Floor::new(opposition, area, plate.material.density.si());
        let (ground, rear_face, ground_step) = ground(scenario, plate, area, count);
        let of_case = options.failure.as_ref();
        let failure = of_case.and_then(|failure| failure.law().prepare(&projectile.material));
        let target_failure = of_case.and_then(|failure| failure.law().prepare(&plate.material));
        let mut state = State {
            rod: Projectile::new(
                rod,
                failure.map(|law| Failure {
                    law,
                    energy: options.fracture_energy.map_or(0.0, |energy| energy.si()),
                }),
            ),
            cracks: Vec::new(),
            target_failure: target_failure.map(|law| TargetFailure {
                law,
                damage: vec![0.0; options.target_elements()],
                first: None,
            }),
            floor,
            ground,
            rear_face,
            books: Books::default(),
            time: 0.0,
            step: 0,
            time_step: 0.0,
            ground_step,
            contact_force: 0.0,
            eroded: 0,
        };
        let erosion_strain = match options.erosion_strain {
            Some(ErosionStrain::At(strain)) => strain,
            Some(ErosionStrain::Never) => f64::INFINITY,
            None => DEFAULT_EROSION_STRAIN,
        };
        let mut control = StepControl::new(options, courant, erosion_strain, f64::INFINITY);
        let slowness = state.rod.front.metal.slowness.max(state.ground.slowness);
        control.courant *= control.step_factor(speed, slowness);
        state.books.initial_energy = state.energy().kinetic_projectile;
        state.books.initial_momentum = state.momentum().projectile;
        Ok(Self {
            scenario,
            plate,
            control,
            state,
            watch: Watch::default(),
        })
    }

    fn attempt(&mut self, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let options = &self.scenario.options.chain;
        let mut recorder = control.record.then(Recorder::new);
        let end_time = options.end_time.map_or(f64::INFINITY, |time| time.si());
        let max_steps = options.max_steps.unwrap_or(DEFAULT_MAX_STEPS);
        self.record(&mut recorder);
        let termination = loop {
            if self.scenario.impact_speed == 0.0 {
                break Termination::NothingMoves;
            }
            self.state.advance(&self.control)?;
            self.watch.follow(&self.state);
            self.record(&mut recorder);
            if self.state.step.is_multiple_of(AUDIT_INTERVAL) {
                self.audit()?;
                control.report(self.progress(end_time))?;
            }
            if self
                .plate
                .thickness
                .is_some_and(|h| self.state.floor.depth >= h)
            {
                break Termination::PassedBackFace;
            }
            if self.state.time >= end_time {
                break Termination::EndTime;
            }
            if self.state.step >= max_steps {
                break Termination::StepLimit;
            }
            if let Some(termination) = self.watch.end(&self.state, self.scenario) {
                break termination;
            }
        };
        self.audit()?;
        Ok(results::sum_up(
            self.scenario,
            &self.state,
            &self.watch,
            termination,
            recorder,
            self.control.erosion_strain,
        ))
    }

    fn audit(&mut self) -> Result<(), Error> {
        let residuals = [
            self.state.energy().residual(),
            self.state.momentum().residual(),
        ];
        let moment = self.moment();
        Ok(self
            .watch
            .residuals
            .audit(residuals, moment, self.control.courant)?)
    }

    fn moment(&self) -> Moment {
        Moment {
            step: self.state.step,
            time: self.state.time,
        }
    }

    fn progress(&self, end_time: f64) -> Progress {
        let motion = self.state.rod.motion();
        let depth = self.watch.largest_depth;
        self.moment()
            .progress(end_time, motion, self.scenario.impact_speed, depth)
    }

    fn record(&self, recorder: &mut Option<Recorder>) {
        let state = &self.state;
        self.moment().record(
            recorder,
            || results::sample(state),
            || results::profile(state),
        );
    }
}

/// The ground, its rear face, and their largest stable step [s].
fn ground(
    scenario: &Scenario,
    plate: &Plate,
    area: f64,
    rod_elements: usize,
) -> (Ground, Option<RearFace>, f64) {
    let material = &plate.material;
    let thickness = modelled_thickness(plate, scenario);
    let cone = Cone::under_disc(area, material.poissons_ratio);
    let first = scenario.projectile.length / rod_elements as f64;
    let count = scenario.options.chain.target_elements();
    let grading = Grading::new(first, thickness, count);
    let modulus = material.youngs_modulus.si();
    let beyond = [
        material.bar_impedance() * cone.area_at(thickness),
        modulus * cone.stiffness_beyond(thickness),
    ];
    let density = material.density.si();
    let constants = [density, modulus, material.room_temperature.si()];
    let ground = Ground::new(cone, grading, thickness, count, constants, beyond);
    let plane_modulus = material.bulk_modulus() + material.shear_modulus() / 0.75;
    let speeds = [material.bar_wave_speed(), (plane_modulus / density).sqrt()];
    let rear_face = RearFace::new(rear_face(scenario), cone, thickness, speeds);
    let smallest = grading.nodes(0.0, thickness, count);
    let smallest = smallest.windows(2).map(|pair| pair[1] - pair[0]);
    let step = smallest.fold(f64::INFINITY, f64::min) / material.bar_wave_speed();
    let longest = rear_face.as_ref().map_or(step, RearFace::longest_step);
    (ground, rear_face, step.min(longest))
}

/// What holds the rear face of the target.
fn rear_face(scenario: &Scenario) -> BackFace {
    match &scenario.target {
        TargetBody::Layers { back_face, .. } => *back_face,
        _ => BackFace::NonReflecting,
    }
}

/// Whether the tip has left the floor, or is gone.
fn parted(state: &State) -> bool {
    state.floor.contact == Contact::Open
}
