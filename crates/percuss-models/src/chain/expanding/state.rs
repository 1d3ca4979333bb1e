//! Time step of the projectile, the crater floor and the far field, with its energy and momentum balance.

use serde::{Deserialize, Serialize};

use super::{
    crater_floor::{Contact, CraterFloor, Tip},
    far_field::FarField,
    projectile::Projectile,
    rear_face::RearFace,
};
use crate::{
    Error,
    chain::{
        part::Role,
        solver::{StepControl, StepTimes},
    },
    error::NumericalError,
    ledger::{EnergyLedger, MomentumLedger},
    material::{FailureState, PreparedFailure},
    solver::archive::Archive,
};

/// Largest change of strain that a slice may make in one step.
const LARGEST_STRAIN_STEP: f64 = 0.02;

/// Work and impulse that have gone where the state itself does not show them.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Accumulators {
    pub(super) initial_energy: f64,
    pub(super) initial_momentum: f64,
    pub(super) plastic: [f64; 2],
    pub(super) contact_loss: f64,
    pub(super) step_changes: f64,
    /// Work of the contact force on the displacement of the mouth by reflected waves [J].
    pub(super) reflected_work: f64,
    pub(super) damping_impulse: f64,
    pub(super) damping_work: f64,
    /// Impulse of the contact force [N s].
    pub(super) contact_impulse: f64,
    pub(super) eroded_energy: f64,
    pub(super) eroded_momentum: f64,
}

/// Everything that moves.
#[derive(Debug)]
pub(super) struct State {
    pub(super) rod: Projectile,
    pub(super) floor: CraterFloor,
    pub(super) far_field: FarField,
    /// A rear face that sends waves back.
    pub(super) rear_face: Option<RearFace>,
    pub(super) accumulated: Accumulators,
    pub(super) time: f64,
    pub(super) step: u64,
    pub(super) time_step: f64,
    /// Largest stable step of the ground [s].
    pub(super) far_field_step: f64,
    pub(super) contact_force: f64,
    pub(super) eroded: usize,
    /// Initial position [m] and time [s] of every crack.
    pub(super) cracks: Vec<(f64, f64)>,
    pub(super) target_failure: Option<TargetFailure>,
}

/// Watches whether the target would fail in tension, which its elastic ground cannot do.
#[derive(Debug)]
pub(super) struct TargetFailure {
    pub(super) law: Box<dyn PreparedFailure>,
    /// Of each spring of the ground.
    pub(super) damage: Vec<f64>,
    /// Depth [m] and time [s] at which it first would.
    pub(super) first: Option<(f64, f64)>,
}

impl State {
    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        self.rod.archive(archive)?;
        self.floor.archive(archive)?;
        self.far_field.archive(archive)?;
        if let Some(face) = &mut self.rear_face {
            face.archive(archive)?;
        }
        archive.item(&mut self.accumulated)?;
        archive.item(&mut self.time)?;
        archive.item(&mut self.step)?;
        archive.item(&mut self.time_step)?;
        archive.item(&mut self.contact_force)?;
        archive.item(&mut self.eroded)?;
        archive.item(&mut self.cracks)?;
        if let Some(failure) = &mut self.target_failure {
            archive.item(&mut failure.damage)?;
            archive.item(&mut failure.first)?;
        }
        Ok(())
    }

    /// Advances by one step.
    pub(super) fn advance(&mut self, control: &StepControl) -> Result<(), NumericalError> {
        let stable = self
            .rod
            .stable_step(LARGEST_STRAIN_STEP)
            .min(self.far_field_step);
        let allowed = (control.courant * stable).min(control.longest_step);
        let step = StepTimes::choose(self.time_step, allowed);
        let (kick, time_step) = (step.kick, step.length);
        self.rod.collect();
        self.far_field.collect();
        self.limit_approach(0.0, -step.before);
        if control.is_damped() {
            let force = self.contact_force;
            self.rod.damp(control, -force);
            self.far_field.damp(control, force);
        }
        self.rod.kick(kick);
        self.far_field.kick(kick);
        let gain = self
            .rear_face
            .as_mut()
            .map_or(0.0, |face| face.begin_step(self.time, time_step));
        self.kick_floor(kick, gain);
        let change = step.length - step.before;
        if change != 0.0 {
            let forced = self.rod.forced_change(kick) + self.far_field.forced_change();
            self.accumulated.step_changes += 0.25 * change * forced;
        }
        if control.is_damped() || control.fails {
            self.account_for_damping(kick);
            self.rod.close_interfaces(kick, time_step);
        }
        self.close(time_step);
        let drifted = self.rod.drift(time_step);
        self.far_field.drift(time_step);
        self.floor.depth += self.floor.speed * time_step;
        self.time += time_step;
        self.time_step = time_step;
        self.step += 1;
        if let Some(face) = &mut self.rear_face {
            let outgoing = self.far_field.mouth().position;
            face.end_step(
                self.time,
                time_step,
                outgoing,
                self.accumulated.contact_impulse,
            );
        }
        match drifted {
            Ok(work) => self.accumulated.plastic[Role::Projectile as usize] += work,
            Err(slice) => return Err(self.crushed(slice)),
        }
        self.erode(control.erosion_strain);
        if control.fails {
            let cracks = self.rod.split_failed_interfaces(time_step);
            let time = self.time;
            self.cracks
                .extend(cracks.into_iter().map(|place| (place, time)));
            self.watch_target(time_step);
        }
        Ok(())
    }

    fn watch_target(&mut self, time_step: f64) {
        let Some(failure) = self.target_failure.as_mut().filter(|f| f.first.is_none()) else {
            return;
        };
        for (damage, mut spring) in failure.damage.iter_mut().zip(self.far_field.strained()) {
            if let Some(face) = &self.rear_face {
                spring.superpose(face.reflected(spring.middle, self.time));
            }
            let state = FailureState {
                tension: -spring.stress,
                triaxiality: (-spring.stress).signum() / 3.0,
                plastic_strain_increment: 0.0,
                temperature: self.far_field.temperature,
            };
            *damage = failure.law.damage(*damage, &state, time_step);
            if *damage >= 1.0 {
                failure.first = Some((spring.middle, self.time));
                return;
            }
        }
    }

    fn account_for_damping(&mut self, kick: f64) {
        for node in self.rod.nodes().chain(self.far_field.nodes.iter()) {
            let [impulse, work] = node.taken_by_damping(kick);
            self.accumulated.damping_impulse += impulse;
            self.accumulated.damping_work += work;
        }
    }

    /// What the tip brings to the floor.
    fn tip(&self) -> Tip {
        let (Some(node), Some(slice)) = (self.rod.front.tip(), self.rod.front.slices.last()) else {
            return Tip::default();
        };
        Tip {
            area: slice.area(),
            flow_stress: slice.flow_stress(),
            density: self.rod.front.metal.density,
            closing: (self.rod.front.nodes.get(0).velocity - node.velocity).max(0.0),
        }
    }

    /// Speed at which the tip comes closer to the floor [m/s].
    fn approach(&self) -> f64 {
        let tip = self.rod.front.tip().map_or(0.0, |node| node.velocity);
        tip - self.far_field_velocity() - self.floor.speed
    }

    /// Velocity of the ground under the floor [m/s].
    pub(super) fn far_field_velocity(&self) -> f64 {
        self.far_field.mouth().velocity + self.echo_velocity()
    }

    /// Part of it that reflected waves bring along [m/s].
    fn echo_velocity(&self) -> f64 {
        self.rear_face.as_ref().map_or(0.0, |face| face.velocity)
    }

    /// Limits the approach velocity of a tip in contact with the floor, as a plastic impact.
    fn limit_approach(&mut self, allowed: f64, drift: f64) {
        if self.floor.contact == Contact::Open {
            return;
        }
        let change = self.approach() - allowed;
        let mobility = self.floor.mobility();
        let before = self.floor.kinetic_energy();
        let (Some(mut tip), mut far_field) = (self.rod.front.tip(), self.far_field.mouth()) else {
            return;
        };
        let impulse = change / (tip.mobility() + far_field.mobility() + mobility);
        let mut loss = tip.jump(-impulse * tip.mobility(), drift);
        loss += far_field.jump(impulse * far_field.mobility(), drift);
        self.rod.front.nodes.set_last(tip);
        self.far_field.nodes.set(0, far_field);
        self.floor.speed = (self.floor.speed + impulse * mobility).max(0.0);
        let reflected = impulse * self.echo_velocity();
        self.accumulated.contact_impulse += impulse;
        self.accumulated.reflected_work += reflected;
        self.accumulated.contact_loss += loss + before - self.floor.kinetic_energy() - reflected;
    }

    /// New velocities of the tip, the floor and the ground under it, whose velocity gains something by reflected waves [m/s].
    fn kick_floor(&mut self, kick: f64, echo_gain: f64) {
        let echo = self.echo_velocity();
        let echo_mean = echo - 0.5 * echo_gain;
        let echo_pull = echo_gain / kick;
        let resisting = self.floor.resistance(self.tip());
        let tip = self.rod.front.tip();
        let (tip_force, tip_mass) = tip.map_or((0.0, 0.0), |n| (n.whole_force(), n.mass()));
        let mut far_field = self.far_field.mouth();
        let far_field_force = far_field.whole_force();
        let force = match self.floor.contact {
            Contact::Open => None,
            Contact::Closed => {
                let together = (tip_force + far_field_force + far_field.mass() * echo_pull)
                    / (tip_mass + far_field.mass());
                let held = tip_force - tip_mass * together;
                if self.floor.speed == 0.0 && held <= resisting {
                    Some((held, 0.0))
                } else {
                    let added = self.floor.added_mass();
                    let pull = (tip_force - resisting) / tip_mass
                        - (resisting + far_field_force) / far_field.mass()
                        - echo_pull;
                    let gain = pull / (1.0 + added * (1.0 / tip_mass + 1.0 / far_field.mass()));
                    Some((resisting + added * gain, gain))
                }
            }
        };
        let Some((force, gain)) = force.filter(|(force, _)| *force >= 0.0) else {
            self.floor.contact = Contact::Open;
            self.contact_force = 0.0;
            self.accumulated.plastic[Role::Target as usize] += self.floor.coast(kick);
            if let Some(mut tip) = tip {
                tip.kick(tip_force * kick);
                self.rod.front.nodes.set_last(tip);
            }
            far_field.kick(far_field_force * kick);
            self.far_field.nodes.set(0, far_field);
            return;
        };
        self.contact_force = force;
        let before = self.floor.speed;
        let after = before + gain * kick;
        let Some(mut tip) = tip else {
            return;
        };
        if after >= 0.0 {
            tip.kick((tip_force - force) * kick);
            far_field.kick((far_field_force + force) * kick);
            self.rod.front.nodes.set_last(tip);
            self.far_field.nodes.set(0, far_field);
            self.floor.speed = after;
            self.accumulated.contact_impulse += force * kick;
            self.accumulated.reflected_work += force * kick * echo_mean;
            let work = resisting * 0.5 * (before + after) * kick;
            self.accumulated.plastic[Role::Target as usize] += if gain == 0.0 { 0.0 } else { work };
            return;
        }
        // The floor comes to rest on the way: tip and ground go on together, and the target has taken what they lose.
        let kinetic =
            tip.kinetic_energy() + far_field.kinetic_energy() + self.floor.kinetic_energy();
        let momentum = tip.mass() * tip.velocity
            + far_field.mass() * far_field.velocity
            + (tip_force + far_field_force) * kick;
        let common = (momentum + far_field.mass() * echo) / (tip.mass() + far_field.mass());
        let below = common - echo;
        let work = kick
            * 0.5
            * (tip_force * (tip.velocity + common)
                + far_field_force * (far_field.velocity + below));
        let impulse = far_field.mass() * (below - far_field.velocity) - far_field_force * kick;
        tip.take_velocity(common);
        far_field.take_velocity(below);
        self.rod.front.nodes.set_last(tip);
        self.far_field.nodes.set(0, far_field);
        self.floor.speed = 0.0;
        let left = tip.kinetic_energy() + far_field.kinetic_energy();
        self.accumulated.contact_impulse += impulse;
        self.accumulated.reflected_work += impulse * echo_mean;
        self.accumulated.plastic[Role::Target as usize] +=
            kinetic + work - left - impulse * echo_mean;
    }

    /// Brings a tip that would pass the floor within the step to touch it at the end of the step.
    fn close(&mut self, time_step: f64) {
        if self.floor.contact == Contact::Closed {
            return;
        }
        let Some(tip) = self.rod.front.tip() else {
            return;
        };
        let gap = self.position() - (tip.position + self.floor.lost_length);
        if gap > self.approach() * time_step {
            return;
        }
        self.floor.contact = Contact::Closed;
        self.limit_approach(gap.max(0.0) / time_step, time_step);
    }

    fn erode(&mut self, limit: f64) {
        while self
            .rod
            .front
            .slices
            .last()
            .is_some_and(|slice| slice.strain >= limit)
        {
            let loss = self.rod.erode_tip();
            self.accumulated.eroded_energy += loss.energy;
            self.accumulated.eroded_momentum += loss.momentum;
            self.floor.lost_length += loss.length;
            self.eroded += 1;
        }
        if self.rod.front.slices.is_empty() {
            self.floor.contact = Contact::Open;
        }
    }

    /// Position of the crater floor below the original face [m].
    pub(super) fn position(&self) -> f64 {
        let echo = self
            .rear_face
            .as_ref()
            .map_or(0.0, |face| face.displacement);
        self.far_field.mouth().position + echo + self.floor.depth
    }

    /// Force on what holds the rear face [N].
    pub(super) fn support_force(&self) -> f64 {
        match &self.rear_face {
            Some(face) => face.support_force,
            None => self.far_field.passing_force,
        }
    }

    pub(super) fn energy(&self) -> EnergyLedger {
        let [kinetic_projectile, elastic_projectile] = self.rod.energies();
        let [kinetic_target, elastic_target] = self.far_field.energies();
        let mut energy = EnergyLedger::default();
        energy.initial = self.accumulated.initial_energy;
        energy.kinetic_projectile = kinetic_projectile;
        energy.kinetic_target = kinetic_target + self.floor.kinetic_energy();
        energy.elastic_projectile = elastic_projectile;
        energy.elastic_target = elastic_target;
        energy.plastic_projectile = self.accumulated.plastic[Role::Projectile as usize];
        energy.plastic_target = self.accumulated.plastic[Role::Target as usize];
        energy.border_shear = 0.0;
        energy.viscous = self.accumulated.damping_work - self.rod.fracture_work;
        energy.fracture = self.rod.fracture_work;
        energy.contact = self.accumulated.contact_loss + self.rod.contact_loss;
        energy.boundary = self.far_field.passed_work + self.accumulated.reflected_work;
        energy.eroded = self.accumulated.eroded_energy;
        energy.step_changes = self.accumulated.step_changes;
        energy
    }

    pub(super) fn momentum(&self) -> MomentumLedger {
        // Waves that left through the last node are in the plate still, except for what its support has taken.
        let passed = self.far_field.passed_impulse;
        let support = match &self.rear_face {
            Some(face) => face.support_impulse,
            None => passed,
        };
        let mut momentum = MomentumLedger::default();
        momentum.initial = self.accumulated.initial_momentum;
        momentum.projectile = self.rod.momentum();
        momentum.target = self.far_field.momentum() + (passed - support);
        momentum.support = support;
        momentum.border_shear = 0.0;
        momentum.damping = self.accumulated.damping_impulse;
        momentum.eroded = self.accumulated.eroded_momentum;
        momentum
    }

    fn crushed(&self, slice: usize) -> NumericalError {
        NumericalError {
            what: "a slice of the projectile was crushed to nothing".to_owned(),
            step: self.step,
            time_us: self.time * 1e6,
            element: Some(slice),
            remedy: "lower `chain.courant` or `chain.erosion_strain`".to_owned(),
        }
    }
}
