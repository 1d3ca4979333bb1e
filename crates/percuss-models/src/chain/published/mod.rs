//! Scheme `published`: the equations of the seed paper as printed \[paper, eqs 7–28\], every ambiguous reading selectable.
//!
//! Nothing here is improved on: strain is small strain at any strain, springs unload along the loading curve, and
//! the joined interface gives the first target mass its speed from nothing. The warnings of a run say so.

mod record;
mod springs;

use std::f64::consts::PI;

use super::friction::dry_friction;
use crate::{
    Error, Refusal, Scenario,
    error::NumericalError,
    history::{Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    material::Material,
    options::{
        ContactSpring, Interface, PublishedBorderShear, PublishedOptions, PublishedTimeStep,
        constraint_factor,
    },
    outcome::{Outcome, RunResult, Termination},
    solver::{
        Control,
        archive::Archive,
        driver::Drive,
        frames::Fields,
        interface::{Audit, BalanceTolerance, Extremes, Retry, Solver},
        limits::Limits,
        monitor::{Clock, Probe, RunMonitor},
    },
};

use springs::{Springs, law, single_plate};

/// A run of the published scheme.
pub(super) type PublishedRun<'a> = Drive<'a, Published<'a>>;

/// Rod and target of the published scheme. Index 0 is the mass at the interface in both bodies.
#[derive(Debug)]
pub struct Published<'a> {
    scenario: &'a Scenario,
    options: PublishedOptions,
    rod: Springs,
    target: Springs,
    thickness: f64,
    time_step: f64,
    rod_displacement: Vec<f64>,
    rod_velocity: Vec<f64>,
    rod_force: Vec<f64>,
    target_displacement: Vec<f64>,
    target_velocity: Vec<f64>,
    target_force: Vec<f64>,
    contact_force: f64,
    back_force: f64,
    step: u64,
    spring_work: [f64; 2],
    friction_work: f64,
    friction_impulse: f64,
    support_impulse: f64,
    initial: (f64, f64),
}

impl<'a> Published<'a> {
    pub(super) fn not_applicable(scenario: &Scenario) -> Option<Refusal> {
        let Some((plate, _, _)) = single_plate(scenario) else {
            return Some(
                "scheme `published` has one plate of finite thickness with a fixed rear face"
                    .into(),
            );
        };
        for material in [&scenario.projectile.material, &plate.material] {
            if law(material, 1.0, 1.0).is_none() {
                return Some(Refusal::new(format!(
                    "scheme `published` has the strength laws power_law and elastic, and {} has {}",
                    material.name,
                    material.strength.key()
                )));
            }
        }
        None
    }

    /// The chain at the moment of impact.
    ///
    /// # Errors
    /// [`Error::NotApplicable`] for anything but one plate with a fixed rear face and power-law or elastic materials.
    pub fn new(scenario: &'a Scenario) -> Result<Self, Error> {
        if let Some(refusal) = Self::not_applicable(scenario) {
            return Err(Error::not_applicable("chain", refusal));
        }
        let (Some((plate, thickness, column)), options) =
            (single_plate(scenario), scenario.options.chain.published())
        else {
            return Err(Error::not_applicable("chain", "no plate"));
        };
        let chain = &scenario.options.chain;
        let body = &scenario.projectile;
        let springs = |material: &Material,
                       factor: f64,
                       diameter: f64,
                       length: f64,
                       elements: usize,
                       mass: f64| {
            let area = PI * diameter * diameter / 4.0;
            let size = length / elements as f64;
            let (strength, exponent) = law(material, factor, area).unwrap_or((0.0, 1.0));
            let flow_stress = material.strength.law().flow_stress_at_unit_strain(material);
            Springs {
                length: size,
                stiffness: material.youngs_modulus.si() * area / size,
                strength,
                exponent,
                small_strain: options.small_strain,
                mass: mass / elements as f64,
                border_shear: chain.border_shear()
                    * PI
                    * diameter
                    * size
                    * flow_stress.unwrap_or(0.0),
            }
        };
        let (rod_elements, target_elements) =
            (chain.projectile_elements(), chain.target_elements());
        let rod = springs(
            &body.material,
            1.0,
            body.diameter,
            body.length,
            rod_elements,
            body.mass,
        );
        let factor = constraint_factor(
            chain.constraint_factor(),
            &plate.material,
            plate.start_temperature(),
        );
        let column_mass = plate.material.density.si() * PI * column * column / 4.0 * thickness;
        let column_mass = options.target_mass.map_or(column_mass, |mass| mass.si());
        let target = springs(
            &plate.material,
            factor,
            column,
            thickness,
            target_elements,
            column_mass,
        );
        // Equations (20) and (21), with the elastic stiffness as the largest.
        let critical = (rod.mass.min(target.mass) / rod.stiffness.max(target.stiffness)).sqrt();
        let time_step = 0.1
            * critical
            * match options.time_step {
                PublishedTimeStep::Table1 => 1.0,
                PublishedTimeStep::Equation21 => 2.0,
            };
        let speed = scenario.impact_velocity;
        let mut target_velocity = vec![0.0; target_elements];
        if options.interface != Interface::Chain {
            target_velocity[0] = speed;
        }
        Ok(Self {
            scenario,
            options,
            rod,
            target,
            thickness,
            time_step,
            rod_displacement: vec![0.0; rod_elements],
            rod_velocity: vec![speed; rod_elements],
            rod_force: vec![0.0; rod_elements],
            target_displacement: vec![0.0; target_elements],
            target_velocity,
            target_force: vec![0.0; target_elements],
            contact_force: 0.0,
            back_force: 0.0,
            step: 0,
            spring_work: [0.0; 2],
            friction_work: 0.0,
            friction_impulse: 0.0,
            support_impulse: 0.0,
            initial: (0.5 * body.mass * speed * speed, body.mass * speed),
        })
    }

    /// Time step [s].
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    fn time(&self) -> f64 {
        self.step as f64 * self.time_step
    }

    /// One step of equations (22)–(28).
    fn integrate(&mut self) {
        self.collect_forces();
        let joined = self.options.interface != Interface::Chain;
        let rod_before = self.rod_velocity.clone();
        let target_before = self.target_velocity.clone();
        let mut joined_velocity = 0.0;
        if joined {
            let mut force = self.target_force[0];
            if self.options.interface == Interface::JoinedPushed {
                force += self.rod_force[0];
            }
            let mut shear = self.target.border_shear;
            if self.options.border_shear == PublishedBorderShear::FrictionAndPenetrator {
                shear += self.rod.border_shear;
            }
            let mass = self.rod.mass + self.target.mass;
            joined_velocity = self.kick(self.rod_velocity[0], force, mass, shear, true);
        }
        for i in usize::from(joined)..self.rod_velocity.len() {
            let centre = -(i as f64 + 0.5) * self.rod.length + self.rod_displacement[i];
            let inside = self.options.border_shear == PublishedBorderShear::FrictionAndPenetrator
                && centre > 0.0;
            let shear = if inside { self.rod.border_shear } else { 0.0 };
            self.rod_velocity[i] = self.kick(
                self.rod_velocity[i],
                self.rod_force[i],
                self.rod.mass,
                shear,
                inside,
            );
        }
        let last = self.target_velocity.len() - 1;
        for i in usize::from(joined)..last.max(usize::from(joined)) {
            let moves = self.target_displacement[i] != 0.0 || self.target_force[i] != 0.0;
            self.target_velocity[i] = self.kick(
                self.target_velocity[i],
                self.target_force[i],
                self.target.mass,
                self.target.border_shear,
                moves,
            );
        }
        if joined {
            self.rod_velocity[0] = joined_velocity;
            self.target_velocity[0] = joined_velocity;
        }
        if last > 0 || !joined {
            // Equation (15): the last target mass is fixed.
            self.target_velocity[last] = 0.0;
            self.back_force = self.target_force[last];
            self.support_impulse += self.target_force[last] * self.time_step;
        }
        self.account_for_springs(&rod_before, &target_before);
        for (x, v) in self.rod_displacement.iter_mut().zip(&self.rod_velocity) {
            *x += v * self.time_step;
        }
        for (x, v) in self
            .target_displacement
            .iter_mut()
            .zip(&self.target_velocity)
        {
            *x += v * self.time_step;
        }
        self.step += 1;
    }

    fn collect_forces(&mut self) {
        self.rod_force.fill(0.0);
        self.target_force.fill(0.0);
        for i in 1..self.rod_displacement.len() {
            let shortening = self.rod_displacement[i] - self.rod_displacement[i - 1];
            let force = self.rod.force(shortening, self.rod.length);
            self.rod_force[i - 1] += force;
            self.rod_force[i] -= force;
        }
        for i in 1..self.target_displacement.len() {
            let shortening = self.target_displacement[i - 1] - self.target_displacement[i];
            let force = self.target.force(shortening, self.target.length);
            self.target_force[i - 1] -= force;
            self.target_force[i] += force;
        }
        self.contact_force = match self.options.interface {
            Interface::Chain => self.series_contact_force(),
            Interface::Joined | Interface::JoinedPushed => -self.target_force[0],
        };
        if self.options.interface == Interface::Chain {
            self.rod_force[0] -= self.contact_force;
            self.target_force[0] += self.contact_force;
        }
    }

    /// Equation (22): both stiffnesses in series carry the same force; each secant stiffness belongs to its own strain.
    fn series_contact_force(&self) -> f64 {
        let shortening = self.rod_displacement[0] - self.target_displacement[0];
        if shortening <= 0.0 {
            return 0.0;
        }
        let share = match self.options.contact_spring {
            ContactSpring::HalfElements => 0.5,
            ContactSpring::WholeElements => 1.0,
        };
        let rod = |u: f64| self.rod.force(u, share * self.rod.length);
        let target = |u: f64| self.target.force(u, share * self.target.length);
        let (mut low, mut high) = (0.0, shortening);
        while high - low > 1e-15 * shortening {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if rod(middle) < target(shortening - middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (rod(low) + target(shortening - low))
    }

    /// New velocity of a mass, with its border shear.
    fn kick(&mut self, before: f64, force: f64, mass: f64, shear: f64, moves: bool) -> f64 {
        let change = force * self.time_step / mass;
        let limit = shear * self.time_step / mass;
        let after = match self.options.border_shear {
            PublishedBorderShear::None => before + change,
            PublishedBorderShear::Constant if moves => before + change - limit,
            PublishedBorderShear::Constant => before + change,
            PublishedBorderShear::Friction | PublishedBorderShear::FrictionAndPenetrator => {
                dry_friction(before, change, limit)
            }
        };
        let impulse = mass * (before + change - after);
        self.friction_impulse += impulse;
        self.friction_work += impulse * 0.5 * (before + after);
        after
    }

    /// Work done on the springs: force times the mean of the velocities before and after the kick.
    fn account_for_springs(&mut self, rod_before: &[f64], target_before: &[f64]) {
        let power = |force: &[f64], before: &[f64], after: &[f64]| -> f64 {
            force
                .iter()
                .zip(before)
                .zip(after)
                .map(|((f, b), a)| -0.5 * f * (b + a))
                .sum()
        };
        self.spring_work[0] +=
            self.time_step * power(&self.rod_force, rod_before, &self.rod_velocity);
        self.spring_work[1] +=
            self.time_step * power(&self.target_force, target_before, &self.target_velocity);
        if self.options.interface == Interface::Joined {
            // The rod's next spring does not act on the joined mass: its work there is nobody's.
            self.spring_work[0] +=
                self.time_step * 0.5 * self.rod_force[0] * (rod_before[0] + self.rod_velocity[0]);
        }
    }
}

impl<'a> Solver<'a> for Published<'a> {
    const NAMES: (&'static str, &'static str) = ("chain", "published");
    /// The scheme has no energy balance that could close; its time step has no Courant number.
    const AUDIT: Audit = Audit {
        interval: u64::MAX,
        report_interval: 256,
        tolerance: BalanceTolerance {
            energy: f64::INFINITY,
            momentum: f64::INFINITY,
        },
        retry: Retry::Never,
    };

    fn build(scenario: &'a Scenario, _: f64, _: &mut Control<'_>) -> Result<Self, Error> {
        Self::new(scenario)
    }

    fn size(&self) -> usize {
        self.rod_velocity.len() + self.target_velocity.len()
    }

    fn courant(_: &Scenario) -> (Option<f64>, f64) {
        (None, 1.0)
    }

    fn limits(&self) -> Limits {
        let options = &self.scenario.options.chain;
        Limits::new(self.scenario, options.end_time, options.max_steps())
    }

    fn advance(&mut self) -> Result<(), NumericalError> {
        self.integrate();
        if self.rod_velocity[0].is_finite() {
            return Ok(());
        }
        let mut error = self.clock().failure(
            "a velocity is not finite".to_owned(),
            "use scheme = \"conservative\"".to_owned(),
        );
        error.element = Some(0);
        Err(error)
    }

    fn clock(&self) -> Clock {
        Clock {
            step: self.step,
            time: self.time(),
            time_step: self.time_step,
        }
    }

    fn probe(&mut self, _: &RunMonitor) -> Probe {
        let touches = self.options.interface != Interface::Chain || self.contact_force > 0.0;
        Probe {
            depth: self.rod_displacement[0],
            contact_force: self.contact_force,
            contact_time: if touches { self.time_step } else { 0.0 },
        }
    }

    fn is_at_rest(&self) -> bool {
        self.rod_velocity[0] <= 0.0
    }

    fn energy(&self) -> EnergyLedger {
        self.ledgers().0
    }

    fn momentum(&self) -> MomentumLedger {
        self.ledgers().1
    }

    fn progress(&self) -> f64 {
        1.0 - self.rod_velocity[0] / self.scenario.impact_velocity
    }

    /// The run ends when the first mass of the penetrator stops, section 3.6 of the paper.
    fn event(&mut self, _: &RunMonitor) -> Result<Option<Termination>, NumericalError> {
        Ok(if self.is_at_rest() {
            Some(Termination::TipStopped)
        } else if self.rod_displacement[0] >= self.thickness {
            Some(Termination::PassedBackFace)
        } else {
            None
        })
    }

    fn sample(&self, _: &RunMonitor) -> Sample {
        self.state_at_nodes()
    }

    fn profile(&self) -> Profile {
        self.state_in_springs().thinned()
    }

    fn fields(&self) -> Fields<'_> {
        Fields::Elements(self.state_in_springs().elements)
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.rod_displacement)?;
        archive.item(&mut self.rod_velocity)?;
        archive.item(&mut self.rod_force)?;
        archive.item(&mut self.target_displacement)?;
        archive.item(&mut self.target_velocity)?;
        archive.item(&mut self.target_force)?;
        archive.item(&mut self.contact_force)?;
        archive.item(&mut self.back_force)?;
        archive.item(&mut self.step)?;
        archive.item(&mut self.spring_work)?;
        archive.item(&mut self.friction_work)?;
        archive.item(&mut self.friction_impulse)?;
        archive.item(&mut self.support_impulse)
    }

    fn outcome(&self, termination: Termination, _: &RunMonitor) -> (Outcome, String) {
        let outcome = match termination {
            Termination::PassedBackFace => Outcome::Perforated,
            Termination::EndTime | Termination::StepLimit => Outcome::OutOfTime,
            _ => Outcome::AtRest,
        };
        (outcome, String::new())
    }

    fn extremes(&self) -> Extremes {
        let room = self.scenario.projectile.material.room_temperature.si();
        Extremes {
            elements: (self.rod_velocity.len(), self.target_velocity.len()),
            largest_temperature: (room, room),
            ..Extremes::default()
        }
    }

    fn complete(&self, result: &mut RunResult, monitor: &RunMonitor) {
        self.complete_result(result, monitor);
    }
}
