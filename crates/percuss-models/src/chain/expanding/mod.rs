//! Target resistance model `expanding-cavity`: a projectile that takes time to widen, on a crater floor that advances against the pressure
//! of an expanding cavity, carried by an elastic cone.
//!
//! It has a solver of its own: no part of the column is left in it.

mod block;
mod blocks;
mod crater_floor;
mod delay_line;
mod far_field;
mod floor_contact;
mod forces;
mod node;
mod plane_impact;
#[cfg(test)]
mod plate_tests;
mod projectile;
mod rear_face;
mod resistance;
mod respond;
mod results;
mod rod;
mod slice;
mod state;
#[cfg(test)]
mod tests;
mod together;

use self::{
    crater_floor::{Contact, CraterFloor, TargetResistance},
    far_field::FarField,
    projectile::{Failure, Projectile},
    rear_face::RearFace,
    resistance::Resistance,
    results::Window,
    rod::Rod,
    slice::Metal,
    state::{Accumulators, State, TargetFailure},
};
use super::{
    column::{TOLERANCE, erosion_strain},
    cone::{Cone, Grading},
    solver::StepControl,
};
use crate::{
    Error, Refusal, Scenario,
    error::NumericalError,
    history::{Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    options::ChainOptions,
    outcome::{Outcome, RunResult, Termination},
    problem::RearFaceCondition,
    scenario::{Plate, TargetBody, modelled_thickness},
    solver::{
        Control,
        archive::Archive,
        driver::Drive,
        frames::Fields,
        interface::{Audit, Extremes, Retry, Solver, slowed},
        limits::Limits,
        monitor::{Clock, Probe, RunMonitor},
    },
};

/// Courant number below which a run is not repeated.
const SMALLEST_COURANT: f64 = 0.05;
/// Steps between two audits.
const AUDIT_INTERVAL: u64 = 64;

/// Why a case cannot be run with this target resistance model, if it cannot.
pub(super) fn not_applicable(scenario: &Scenario) -> Option<Refusal> {
    let Some(plate) = struck(scenario) else {
        return Some(
            "the target resistance model `expanding-cavity` needs a target of one layer".into(),
        );
    };
    if let Some(law) = &scenario.resistance {
        if scenario.has_heated_target() {
            let reason = "a resistance law of the caller's own does not depend on the temperature of the target";
            let remedy = "remove `target.temperature`, or take it into account in the law";
            return Some(Refusal::new(reason).with_remedy(remedy));
        }
        let speeds = [0.0, scenario.impact_velocity].into_iter();
        let mut pressures = speeds.map(|speed| (speed, law.0.pressure(0.0, speed)));
        let wrong = pressures.find(|(_, pressure)| !(*pressure >= 0.0 && pressure.is_finite()));
        return wrong.map(|(speed, pressure)| {
            let reason = format!(
                "the resistance law gives {pressure} Pa at the face and a speed of {speed} m/s"
            );
            Refusal::new(reason).with_remedy("allowed: a finite pressure, 0 or more")
        });
    }
    let yields = plate
        .material
        .strength
        .law()
        .initial_yield_stress(&plate.material);
    yields
        .is_none()
        .then(|| "the target resistance model `expanding-cavity` needs a target that yields".into())
}

fn struck(scenario: &Scenario) -> Option<&Plate> {
    match &scenario.target {
        TargetBody::Layers { layers, .. } if layers.len() == 1 => layers.first(),
        _ => None,
    }
}

/// The projectile, the crater floor and the ground under it.
#[derive(Debug)]
pub(crate) struct Cavity<'a> {
    scenario: &'a Scenario,
    plate: &'a Plate,
    control: StepControl,
    state: State,
    window: Window,
}

/// A run with this target resistance model.
pub(super) type CavityRun<'a> = Drive<'a, Cavity<'a>>;

impl<'a> Cavity<'a> {
    fn new(scenario: &'a Scenario, courant: f64) -> Result<Self, Error> {
        let refuse =
            || Error::not_applicable("chain", not_applicable(scenario).unwrap_or_default());
        let plate = struck(scenario).ok_or_else(refuse)?;
        let options = &scenario.options.chain;
        let projectile = &scenario.projectile;
        let area = projectile.mass / (projectile.material.density.si() * projectile.length);
        let heat = if options.adiabatic_heating() {
            options.heat_fraction()
        } else {
            0.0
        };
        let rate_effects = options.rate_effects();
        let metal = Metal::new(&projectile.material, heat, rate_effects);
        let temperature = projectile.start_temperature();
        let speed = scenario.impact_velocity;
        let count = options.projectile_elements();
        let rod = Rod::new(metal, count, projectile.length, area, temperature, speed);
        let radius = (area / std::f64::consts::PI).sqrt();
        // The floor advances at about half the impact velocity, and the flow under it is as deep as the projectile is thick.
        let rate = if rate_effects {
            speed / (2.0 * radius)
        } else {
            0.0
        };
        let free_rear_face = plate
            .thickness
            .filter(|_| rear_face(scenario) == RearFaceCondition::Free);
        let resistance_law = match &scenario.resistance {
            Some(own) => TargetResistance::Own(own.clone()),
            None => TargetResistance::Cavity(
                Resistance::new(
                    &plate.material,
                    plate.start_temperature(),
                    radius,
                    rate,
                    heat,
                    free_rear_face,
                )
                .ok_or_else(refuse)?,
            ),
        };
        let floor = CraterFloor::new(resistance_law, area, plate.material.density.si());
        let (far_field, rear_face, far_field_step) = far_field(scenario, plate, area, count);
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
            far_field,
            rear_face,
            accumulated: Accumulators::default(),
            time: 0.0,
            step: 0,
            time_step: 0.0,
            far_field_step,
            contact_force: 0.0,
            eroded: 0,
        };
        let erosion_strain = erosion_strain(options);
        let mut control = StepControl::new(options, courant, erosion_strain, f64::INFINITY);
        let slowness = state.rod.front.metal.slowness.max(state.far_field.slowness);
        control.courant *= control.step_factor(speed, slowness);
        state.accumulated.initial_energy = state.energy().kinetic_projectile;
        state.accumulated.initial_momentum = state.momentum().projectile;
        Ok(Self {
            scenario,
            plate,
            control,
            state,
            window: Window::default(),
        })
    }
}

impl<'a> Solver<'a> for Cavity<'a> {
    const NAMES: (&'static str, &'static str) = ("chain", "conservative");
    const AUDIT: Audit = Audit {
        interval: AUDIT_INTERVAL,
        report_interval: AUDIT_INTERVAL,
        tolerance: TOLERANCE,
        retry: Retry::OfAnyError {
            smallest: SMALLEST_COURANT,
        },
    };

    fn build(scenario: &'a Scenario, courant: f64, _: &mut Control<'_>) -> Result<Self, Error> {
        Self::new(scenario, courant)
    }

    fn size(&self) -> usize {
        let options = &self.scenario.options.chain;
        options.projectile_elements() + options.target_elements()
    }

    fn courant(scenario: &Scenario) -> (Option<f64>, f64) {
        (scenario.options.chain.courant, ChainOptions::COURANT)
    }

    fn limits(&self) -> Limits {
        let options = &self.scenario.options.chain;
        Limits::new(self.scenario, options.end_time, options.max_steps())
            .or_at_rest(self.scenario, options.end_at_rest())
    }

    fn advance(&mut self) -> Result<(), NumericalError> {
        self.state.advance(&self.control)
    }

    fn clock(&self) -> Clock {
        Clock {
            step: self.state.step,
            time: self.state.time,
            time_step: self.state.time_step,
        }
    }

    fn probe(&mut self, _: &RunMonitor) -> Probe {
        let state = &self.state;
        let touches = state.floor.contact == Contact::Closed;
        self.window.touched |= touches;
        Probe {
            depth: state.position(),
            contact_force: state.contact_force,
            contact_time: if touches { state.time_step } else { 0.0 },
        }
    }

    fn is_at_rest(&self) -> bool {
        self.state.rod.momentum() <= 0.0
    }

    fn energy(&self) -> EnergyLedger {
        self.state.energy()
    }

    fn momentum(&self) -> MomentumLedger {
        self.state.momentum()
    }

    fn progress(&self) -> f64 {
        slowed(self.state.rod.motion(), self.scenario.impact_velocity)
    }

    fn event(&mut self, monitor: &RunMonitor) -> Result<Option<Termination>, NumericalError> {
        let thickness = self.plate.thickness;
        if thickness.is_some_and(|thickness| self.state.floor.depth >= thickness) {
            return Ok(Some(Termination::PassedBackFace));
        }
        Ok(self.window.end(&self.state, self.scenario, monitor))
    }

    fn sample(&self, _: &RunMonitor) -> Sample {
        results::sample(&self.state)
    }

    fn profile(&self) -> Profile {
        results::profile(&self.state).thinned()
    }

    fn fields(&self) -> Fields<'_> {
        Fields::Elements(results::profile(&self.state).elements)
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.window)?;
        self.state.archive(archive)
    }

    fn outcome(&self, termination: Termination, monitor: &RunMonitor) -> (Outcome, String) {
        let impact_velocity = self.scenario.impact_velocity;
        results::outcome(termination, &self.state, monitor, impact_velocity)
    }

    fn extremes(&self) -> Extremes {
        let (options, state) = (&self.scenario.options.chain, &self.state);
        let [plastic_strain, _, temperature] = state.rod.reached();
        Extremes {
            elements: (options.projectile_elements(), options.target_elements()),
            eroded_elements: (state.eroded, 0),
            largest_plastic_strain: (plastic_strain, 0.0),
            largest_temperature: (temperature, state.far_field.temperature),
        }
    }

    fn complete(&self, result: &mut RunResult, monitor: &RunMonitor) {
        results::complete(self, result, monitor);
    }
}

/// The far_field, its rear face, and their largest stable step [s].
fn far_field(
    scenario: &Scenario,
    plate: &Plate,
    area: f64,
    rod_elements: usize,
) -> (FarField, Option<RearFace>, f64) {
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
    let constants = [density, modulus, plate.start_temperature()];
    let far_field = FarField::new(cone, grading, thickness, count, constants, beyond);
    let plane_modulus = material.bulk_modulus() + material.shear_modulus() / 0.75;
    let speeds = [material.bar_wave_speed(), (plane_modulus / density).sqrt()];
    let rear_face = RearFace::new(rear_face(scenario), cone, thickness, speeds);
    let smallest = grading.nodes(0.0, thickness, count);
    let smallest = smallest.windows(2).map(|pair| pair[1] - pair[0]);
    let step = smallest.fold(f64::INFINITY, f64::min) / material.bar_wave_speed();
    let longest = rear_face.as_ref().map_or(step, RearFace::longest_step);
    (far_field, rear_face, step.min(longest))
}

/// What holds the rear face of the target.
fn rear_face(scenario: &Scenario) -> RearFaceCondition {
    match &scenario.target {
        TargetBody::Layers { back_face, .. } => *back_face,
        _ => RearFaceCondition::NonReflecting,
    }
}
