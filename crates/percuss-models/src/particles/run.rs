//! A lattice that meets a rigid body, as a solver.

use std::borrow::Cow;

use super::{
    AUDIT, INTERVAL,
    bonded::{At, Bonded, Load, from_axis},
    cracks::{Front, Notches},
    debris::{ContactLaw, Debris},
    fields,
    flight::{Flight, Inertia, Pose},
    results, setup,
    shape::{Contact, Moving, Rigid, Shape, contact},
};
use crate::{
    Error, Scenario,
    error::NumericalError,
    history::{ElementState, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    outcome::{Outcome, RunResult, Termination},
    solver::{
        Control, Particle,
        archive::Archive,
        driver::Drive,
        frames::{Across, Bond, BondSource, Bonds, Fields, PointSource, Points},
        gauge::Gauge,
        interface::{Audit, Extremes, Solver},
        limits::Limits,
        monitor::{Clock, Probe, RunMonitor},
    },
};

/// Steps between two looks at the cracks.
const LOOK: u64 = 10;
/// Steps between two looks at the largest stable step, and the part of it that a smaller step takes, so that changes are few.
const STEP_LOOK: u64 = 10;
const SMALLER_STEP: f64 = 0.9;
/// Round trips of a wave through the lattice, or from its middle to its side, without contact after which the bodies have parted.
const PARTED_AFTER: f64 = 2.0;

/// A lattice and the rigid body that it meets.
#[derive(Debug)]
pub(crate) struct Impact<'a, B, const D: usize> {
    pub(super) scenario: &'a Scenario,
    pub(super) body: B,
    /// Particles next to the axis on both faces across it.
    pub(super) faces: [At; 2],
    pub(super) rigid: Rigid,
    pub(super) inertia: Inertia,
    pub(super) state: State,
    pub(super) time_step: f64,
    /// Time step of the bodies at rest [s].
    first_step: f64,
    contact: Contact<D>,
    debris: Debris<D>,
    law: ContactLaw,
    pub(super) front: Front,
    pub(super) notches: Notches<D>,
    /// Forces of both, in the order of the rows.
    loads: Vec<Load<D>>,
    initial: (f64, f64),
}

/// What a step changes beside the lattice.
#[derive(Debug, Clone, Copy, serde::Serialize, serde::Deserialize)]
pub(super) struct State {
    step: u64,
    pub(super) time: f64,
    /// Motion of a rigid projectile.
    pub(super) flight: Flight,
    /// Impulse on what holds the rear face, or on the wall [N s per m].
    support: f64,
    /// Force on it in the last step [N per m].
    pub(super) support_force: f64,
    /// Time of the last contact [s]; negative before the first.
    last_contact: f64,
    /// Largest stretch of a bond so far.
    pub(super) largest_stretch: f64,
    /// Largest principal tension of a particle so far [Pa].
    pub(super) largest_tension: f64,
    /// Energy that changes of the time step took [J per m].
    step_changes: f64,
}

/// A run of the model.
pub(super) type ParticlesRun<'a, B, const D: usize> = Drive<'a, Impact<'a, B, D>>;

impl<B: Bonded<D>, const D: usize> Impact<'_, B, D> {
    /// Part of the lattice in results: the projectile is 0.
    pub(super) fn part(&self) -> usize {
        usize::from(self.rigid != Rigid::Wall)
    }

    /// Momentum of the projectile along the normal of the face [N s per m].
    pub(super) fn projectile_momentum(&self) -> f64 {
        match self.rigid {
            Rigid::Wall => self.initial.1 - self.state.support,
            Rigid::Projectile(_) => self.inertia.mass * self.state.flight.velocity[1],
        }
    }

    /// Force between the bodies along the normal of the face [N per m].
    pub(super) fn contact_force(&self) -> f64 {
        self.contact.force[1].abs()
    }

    pub(super) fn pose(&self) -> Pose {
        self.state.flight.pose(&self.inertia)
    }

    fn find_contact(&mut self) {
        let moving = self.body.begins_within_steps().then_some(Moving {
            step: self.time_step,
            flight: match self.rigid {
                Rigid::Wall => None,
                Rigid::Projectile(_) => Some(&self.state.flight),
            },
        });
        self.contact = contact(&self.body, self.rigid, self.pose(), moving);
        self.loads.clone_from(&self.contact.loads);
        let of_pieces = self.debris.loads(&self.body, &self.law);
        self.loads.extend(of_pieces);
        self.loads.sort_by_key(|load| (load.row, load.place));
    }

    /// Makes the time step smaller where the body has become stiffer for its size.
    fn limit_step(&mut self) {
        let stable = self.body.stable_part() * self.first_step;
        // What is no number stops the run in the next check.
        if self.time_step > stable && stable > 0.0 {
            let before = Solver::energy(self).total();
            self.time_step = SMALLER_STEP * stable;
            self.find_contact();
            self.state.step_changes += before - Solver::energy(self).total();
        }
    }

    /// Whether nothing stands in the way of a projectile that it would meet.
    fn has_free_way(&self, shape: &Shape) -> bool {
        let flight = &self.state.flight;
        let speed = flight.velocity[0].hypot(flight.velocity[1]);
        let [across, along] = flight.velocity.map(|part| part / speed);
        let pose = self.pose();
        let corners = [-shape.radius, shape.radius].map(|x| [[x, 0.0], [x, -shape.length]]);
        let (mut tail, mut sides) = (f64::INFINITY, [f64::INFINITY, f64::NEG_INFINITY]);
        for corner in corners.as_flattened() {
            let [x, z] = pose.place(*corner);
            let side = along * x - across * z;
            tail = tail.min(across * x + along * z);
            sides = [sides[0].min(side), sides[1].max(side)];
        }
        self.body.particles().all(|(row, place)| {
            let (at, velocity) = (
                self.body.position(row, place),
                self.body.velocity(row, place),
            );
            let (x, z) = (from_axis(at), at[D - 1]);
            let side = along * x - across * z;
            let is_ahead = side > sides[0] && side < sides[1] && across * x + along * z > tail;
            let its_speed = across * velocity[0] + along * velocity[D - 1];
            !is_ahead || its_speed >= speed
        })
    }

    /// Largest stretch of a bond and largest tension of a particle, now or before.
    fn survey(&mut self) {
        let (stretch, tension) = self.body.extremes();
        self.state.largest_stretch = self.state.largest_stretch.max(stretch);
        self.state.largest_tension = self.state.largest_tension.max(tension);
    }
}

impl<B: Bonded<D>, const D: usize> PointSource for Impact<'_, B, D> {
    fn len(&self) -> usize {
        self.body.particles().count()
    }

    /// Particles of the lattice.
    fn points(&self) -> Box<dyn Iterator<Item = Particle> + '_> {
        let body = &self.body;
        Box::new((body.particles()).map(|(row, place)| body.particle(row, place)))
    }
}

impl<B: Bonded<D>, const D: usize> BondSource for Impact<'_, B, D> {
    fn bonds(&self, first: u32) -> Box<dyn Iterator<Item = Bond> + '_> {
        Box::new(fields::bonds(&self.body, first))
    }
}

impl<'a, B: Bonded<D>, const D: usize> Solver<'a> for Impact<'a, B, D> {
    const NAMES: (&'static str, &'static str) = ("particles", B::LATTICE);
    const AUDIT: Audit = AUDIT;

    fn build(
        scenario: &'a Scenario,
        courant: f64,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        let (mut body, rigid) = B::build(scenario, control)?;
        let speed = scenario.impact_velocity;
        let angle = scenario.obliquity;
        let inertia = body.inertia(scenario, rigid);
        let flight = setup::flight(scenario, &inertia);
        let mass = inertia.mass;
        // A particle of the surface has half the mass of one inside, and a spring of the contact beside its bonds.
        let frequency = body.frequency(control)?;
        let of_contact =
            (frequency * frequency + 2.0 * body.contact_stiffness() / body.inner_mass()).sqrt();
        let time_step = courant * 2.0 / of_contact;
        let on_axis: Vec<At> = (0..body.row_count())
            .filter_map(|row| body.nearest_to_axis(row))
            .collect();
        let faces = [on_axis.first(), on_axis.last()].map(|face| *face.unwrap_or(&(0, 0)));
        let mut impact = Self {
            scenario,
            faces,
            time_step,
            first_step: time_step,
            inertia,
            rigid,
            state: State {
                flight,
                last_contact: -1.0,
                step: 0,
                time: 0.0,
                support: 0.0,
                support_force: 0.0,
                largest_stretch: 0.0,
                largest_tension: 0.0,
                step_changes: 0.0,
            },
            contact: Contact::default(),
            debris: Debris::default(),
            law: body.contact_law(scenario),
            front: Front::default(),
            notches: body.notches(scenario),
            loads: Vec::new(),
            initial: (0.5 * mass * speed * speed, mass * speed * angle.cos()),
            body,
        };
        control.ask()?;
        impact.find_contact();
        Ok(impact)
    }

    fn size(&self) -> usize {
        self.body.row_count() * self.body.row_places()
    }

    fn courant(scenario: &Scenario) -> (Option<f64>, f64) {
        super::courant(scenario)
    }

    fn limits(&self) -> Limits {
        let breaks = self.body.softening().is_some();
        setup::limits(self.scenario, self.body.wave_speed(), breaks)
    }

    fn advance(&mut self) -> Result<(), NumericalError> {
        let step = self.time_step;
        let mut impulse = self.body.advance(step, &self.loads);
        match self.rigid {
            Rigid::Wall => impulse -= step * self.contact.force[1],
            Rigid::Projectile(_) => {
                (self.state.flight).advance(step, &self.inertia, &self.contact);
            }
        }
        self.state.support += impulse;
        self.state.support_force = impulse / step;
        self.state.step += 1;
        self.state.time += step;
        let is_due = self.state.step.is_multiple_of(INTERVAL);
        self.debris
            .meet(&self.body, &self.law, self.time_step, is_due);
        self.find_contact();
        if !self.contact.loads.is_empty() {
            self.state.last_contact = self.state.time;
        }
        if self.state.step.is_multiple_of(INTERVAL) {
            self.survey();
        }
        if self.state.step.is_multiple_of(STEP_LOOK) {
            self.limit_step();
        }
        if self.body.softening().is_some() && self.state.step.is_multiple_of(LOOK) {
            self.front
                .follow(&self.body, &self.notches, self.state.time);
        }
        Ok(())
    }

    fn clock(&self) -> Clock {
        Clock {
            step: self.state.step,
            time: self.state.time,
            time_step: self.time_step,
        }
    }

    fn probe(&mut self, monitor: &RunMonitor) -> Probe {
        let (row, place) = self.faces[0];
        let [start, now] = [
            self.body.reference(row, place),
            self.body.position(row, place),
        ]
        .map(|at| at[D - 1]);
        let touches = !self.contact.loads.is_empty();
        Probe {
            depth: match self.rigid {
                Rigid::Wall => 0.0,
                // A splinter that flies ahead is no floor.
                Rigid::Projectile(shape) if self.body.is_loose(row, place) => {
                    let tip = self.pose().deepest(&shape);
                    (now - start).min(tip.max(monitor.largest_depth))
                }
                Rigid::Projectile(_) => now - start,
            },
            contact_force: self.contact_force(),
            contact_time: if touches { self.time_step } else { 0.0 },
        }
    }

    fn is_at_rest(&self) -> bool {
        self.projectile_momentum() <= 0.0
    }

    fn energy(&self) -> EnergyLedger {
        let sums = self.body.sums(self.time_step, &self.loads);
        let of_pieces = self.debris.energy(&self.body, &self.law);
        let elastic = sums.elastic + self.contact.energy + of_pieces;
        let mut energy = EnergyLedger::default();
        energy.initial = self.initial.0;
        energy.fracture = sums.fracture;
        energy.contact = self.debris.lost;
        energy.viscous = sums.viscous;
        energy.stabilisation = sums.stabilisation;
        energy.step_changes = self.state.step_changes;
        match self.rigid {
            Rigid::Wall => {
                energy.kinetic_projectile = sums.kinetic;
                energy.elastic_projectile = elastic;
                energy.plastic_projectile = sums.plastic;
            }
            Rigid::Projectile(_) => {
                let flight = &self.state.flight;
                energy.kinetic_projectile =
                    flight.kinetic_energy(self.time_step, &self.inertia, &self.contact);
                energy.kinetic_target = sums.kinetic;
                energy.elastic_target = elastic;
                energy.plastic_target = sums.plastic;
            }
        }
        energy
    }

    fn momentum(&self) -> MomentumLedger {
        let lattice = self.body.momentum();
        let mut momentum = MomentumLedger::default();
        momentum.initial = self.initial.1;
        match self.rigid {
            Rigid::Wall => momentum.projectile = lattice,
            Rigid::Projectile(_) => {
                momentum.projectile = self.projectile_momentum();
                momentum.target = lattice;
            }
        }
        momentum.support = self.state.support;
        momentum
    }

    fn progress(&self) -> f64 {
        let lost = 1.0 - self.projectile_momentum() / self.initial.1;
        (0.5 * lost).clamp(0.0, 1.0)
    }

    fn check(&self, _: &RunMonitor) -> Result<(), NumericalError> {
        match self.body.unbearable(self.state.largest_stretch) {
            None => Ok(()),
            Some((why, remedy)) => Err(self.clock().failure(why, remedy)),
        }
    }

    fn event(&mut self, _: &RunMonitor) -> Result<Option<Termination>, NumericalError> {
        let State {
            time, last_contact, ..
        } = self.state;
        let extent = setup::extent(self.scenario);
        let free =
            PARTED_AFTER * 2.0 * extent.length.max(0.5 * extent.width) / self.body.wave_speed();
        let parted = last_contact >= 0.0 && time > last_contact + free;
        if !parted || !self.state.step.is_multiple_of(INTERVAL) {
            return Ok(None);
        }
        // A free target may still be slower than a projectile that goes on: then they meet again, unless it has come through.
        let target = self.body.momentum() / self.body.mass();
        let Rigid::Projectile(shape) = self.rigid else {
            return Ok(Some(Termination::Parted));
        };
        if self.state.flight.velocity[1] < target {
            return Ok(Some(Termination::Parted));
        }
        let is_through = self.pose().deepest(&shape) > extent.start + extent.length;
        let has_left = is_through && self.has_free_way(&shape);
        Ok(has_left.then_some(Termination::LeftTarget))
    }

    fn sample(&self, monitor: &RunMonitor) -> Sample {
        results::sample(self, monitor)
    }

    fn gauges(&self, gauges: &[Gauge]) -> Vec<ElementState> {
        if gauges.is_empty() {
            return Vec::new();
        }
        let rows = fields::along_axis(&self.body, self.part());
        gauges
            .iter()
            .map(|gauge| results::at_gauge(self, gauge.position, &rows))
            .collect()
    }

    fn profile(&self) -> Profile {
        Profile {
            time: self.state.time,
            elements: fields::along_axis(&self.body, self.part()),
        }
    }

    fn fields(&self) -> Fields<'_> {
        let mut bodies: Vec<Points<'_>> = Vec::new();
        let mut across = Vec::new();
        if self.rigid != Rigid::Wall {
            let (points, beside) = self.body.show_rigid(self);
            bodies.push(Points::Kept(Cow::Owned(points)));
            across = beside;
        }
        let before: usize = bodies.iter().map(Points::len).sum();
        bodies.push(Points::Made(self));
        let of_body =
            (self.body.particles()).filter_map(|(row, place)| self.body.across(row, place));
        across.extend(of_body);
        Fields::Particles {
            cell: self.body.spacing(),
            bonds: Bonds::Made(self, before as u32),
            bodies,
            across: (D == 3).then(|| Across {
                places: across,
                section: self.body.section(),
            }),
        }
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.state)?;
        archive.item(&mut self.time_step)?;
        self.body.archive(archive)?;
        archive.item(&mut self.debris)?;
        archive.item(&mut self.front)?;
        if archive.is_read() {
            self.find_contact();
        }
        Ok(())
    }

    fn outcome(&self, termination: Termination, _: &RunMonitor) -> (Outcome, String) {
        (results::outcome(self, termination), String::new())
    }

    fn extremes(&self) -> Extremes {
        let particles = self.body.particles().count();
        let flow = self.body.flow();
        let of_body = |number: f64| match self.rigid {
            Rigid::Wall => (number, 0.0),
            Rigid::Projectile(_) => (0.0, number),
        };
        Extremes {
            elements: match self.rigid {
                Rigid::Wall => (particles, 0),
                Rigid::Projectile(_) => (0, particles),
            },
            largest_plastic_strain: of_body(flow.plastic_strain),
            largest_temperature: of_body(flow.temperature),
            ..Extremes::default()
        }
    }

    fn complete(&self, result: &mut RunResult, monitor: &RunMonitor) {
        results::complete(self, result, monitor);
    }
}
