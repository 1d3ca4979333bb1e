//! Time step of the projectile, the crater floor and the far field, with its energy and momentum balance.

use serde::{Deserialize, Serialize};

use super::{
    crater_floor::{Contact, CraterFloor},
    far_field::FarField,
    projectile::Projectile,
    rear_face::RearFace,
    together::{Drift, Push},
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
        let is_plain = !control.is_damped() && !control.fails;
        if is_plain {
            // The tip and the mouth are not kicked here.
            self.push(kick);
            self.limit_approach(0.0, -step.before);
        } else {
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
        }
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
        if !is_plain {
            self.account_for_damping(kick);
            self.rod.close_interfaces(kick, time_step);
        }
        self.close(time_step);
        let drifted = if is_plain {
            self.drift(time_step)
        } else {
            self.far_field.drift(time_step);
            self.rod.drift(time_step)
        };
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

    /// Collects forces and gives new velocities to all but the tip and the mouth.
    fn push(&mut self, kick: f64) {
        let (rod, far_field) = (&mut self.rod.front, &mut self.far_field);
        let arch = rod.arch;
        arch.dispatch(Push {
            rod,
            far_field,
            kick,
        });
    }

    /// Moves the projectile, of one rod, and the far field on.
    fn drift(&mut self, time_step: f64) -> Result<f64, usize> {
        let (rod, far_field) = (&mut self.rod.front, &mut self.far_field);
        let arch = rod.arch;
        arch.dispatch(Drift {
            rod,
            far_field,
            time_step,
        })
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
                strain_rate: 0.0,
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
            Some(face) => face.support_force(),
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
            Some(face) => face.support_impulse(),
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
