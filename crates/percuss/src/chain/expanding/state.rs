//! One step of the projectile, the crater floor and the ground, with books.

use super::{
    floor::{Contact, Floor, Tip},
    ground::Ground,
    rod::Rod,
};
use crate::{
    chain::{part::Role, solver::choose_time_step},
    error::NumericalError,
    ledger::{EnergyLedger, MomentumLedger},
};

/// Largest change of strain that a slice may make in one step.
const LARGEST_STRAIN_STEP: f64 = 0.02;

/// Work and impulse that have gone where the state itself does not show them.
#[derive(Debug, Default)]
pub(super) struct Books {
    pub(super) initial_energy: f64,
    pub(super) initial_momentum: f64,
    pub(super) plastic: [f64; 2],
    pub(super) contact_loss: f64,
    pub(super) eroded_energy: f64,
    pub(super) eroded_momentum: f64,
}

/// Everything that moves.
#[derive(Debug)]
pub(super) struct State {
    pub(super) rod: Rod,
    pub(super) floor: Floor,
    pub(super) ground: Ground,
    pub(super) books: Books,
    pub(super) time: f64,
    pub(super) step: u64,
    pub(super) time_step: f64,
    /// Largest stable step of the ground [s].
    pub(super) ground_step: f64,
    pub(super) contact_force: f64,
    pub(super) eroded: usize,
}

impl State {
    /// Advances by one step.
    pub(super) fn advance(
        &mut self,
        courant: f64,
        erosion_strain: f64,
    ) -> Result<(), NumericalError> {
        let previous = self.time_step;
        let stable = self
            .rod
            .stable_step(LARGEST_STRAIN_STEP)
            .min(self.ground_step);
        let time_step = choose_time_step(previous, courant * stable);
        let kick = 0.5 * (previous + time_step);
        self.rod.collect();
        self.ground.collect();
        self.meet(0.0, -previous);
        self.rod.kick(kick);
        self.ground.kick(kick);
        self.kick_floor(kick);
        self.close(time_step);
        let drifted = self.rod.drift(time_step);
        self.ground.drift(time_step);
        self.floor.depth += self.floor.speed * time_step;
        self.time += time_step;
        self.time_step = time_step;
        self.step += 1;
        match drifted {
            Ok(work) => self.books.plastic[Role::Projectile as usize] += work,
            Err(slice) => return Err(self.crushed(slice)),
        }
        self.erode(erosion_strain);
        Ok(())
    }

    /// What the tip brings to the floor.
    fn tip(&self) -> Tip {
        let (Some(node), Some(slice)) = (self.rod.tip(), self.rod.slices.last()) else {
            return Tip::default();
        };
        Tip {
            area: slice.area(),
            flow_stress: slice.flow_stress(),
            density: self.rod.metal.density,
            closing: (self.rod.nodes[0].velocity - node.velocity).max(0.0),
        }
    }

    /// Speed at which the tip comes closer to the floor [m/s].
    fn approach(&self) -> f64 {
        let tip = self.rod.tip().map_or(0.0, |node| node.velocity);
        tip - self.ground.nodes[0].velocity - self.floor.speed
    }

    /// Takes the speed at which a tip that touches the floor approaches it down to an allowed one, as a plastic impact.
    fn meet(&mut self, allowed: f64, drift: f64) {
        if self.floor.contact == Contact::Open {
            return;
        }
        let change = self.approach() - allowed;
        let mobility = self.floor.mobility();
        let before = self.floor.kinetic_energy();
        let Some(tip) = self.rod.nodes.last_mut() else {
            return;
        };
        let ground = &mut self.ground.nodes[0];
        let impulse = change / (1.0 / tip.mass + 1.0 / ground.mass + mobility);
        let mut loss = tip.jump(-impulse / tip.mass, drift);
        loss += ground.jump(impulse / ground.mass, drift);
        self.floor.speed = (self.floor.speed + impulse * mobility).max(0.0);
        self.books.contact_loss += loss + before - self.floor.kinetic_energy();
    }

    /// New velocities of the tip, the floor and the ground under it.
    fn kick_floor(&mut self, kick: f64) {
        let resisting = self.floor.resistance(self.tip());
        let (tip_force, tip_mass) = self.rod.tip().map_or((0.0, 0.0), |n| (n.force, n.mass));
        let ground = self.ground.nodes[0];
        let force = match self.floor.contact {
            Contact::Open => None,
            Contact::Closed => {
                let together = (tip_force + ground.force) / (tip_mass + ground.mass);
                let held = tip_force - tip_mass * together;
                if self.floor.speed == 0.0 && held <= resisting {
                    Some((held, 0.0))
                } else {
                    let added = self.floor.added_mass();
                    let pull = (tip_force - resisting) / tip_mass
                        - (resisting + ground.force) / ground.mass;
                    let gain = pull / (1.0 + added * (1.0 / tip_mass + 1.0 / ground.mass));
                    Some((resisting + added * gain, gain))
                }
            }
        };
        let Some((force, gain)) = force.filter(|(force, _)| *force >= 0.0) else {
            self.floor.contact = Contact::Open;
            self.contact_force = 0.0;
            self.books.plastic[Role::Target as usize] += self.floor.coast(kick);
            if let Some(tip) = self.rod.nodes.last_mut() {
                tip.kick(tip_force * kick);
            }
            self.ground.nodes[0].kick(ground.force * kick);
            return;
        };
        self.contact_force = force;
        let before = self.floor.speed;
        let after = before + gain * kick;
        let (Some(tip), ground) = (self.rod.nodes.last_mut(), &mut self.ground.nodes[0]) else {
            return;
        };
        if after >= 0.0 {
            tip.kick((tip_force - force) * kick);
            ground.kick((ground.force + force) * kick);
            self.floor.speed = after;
            let work = resisting * 0.5 * (before + after) * kick;
            self.books.plastic[Role::Target as usize] += if gain == 0.0 { 0.0 } else { work };
            return;
        }
        // The floor comes to rest on the way: tip and ground go on together, and the target has taken what they lose.
        let kinetic = tip.kinetic_energy() + ground.kinetic_energy() + self.floor.kinetic_energy();
        let momentum = tip.mass * tip.velocity
            + ground.mass * ground.velocity
            + (tip_force + ground.force) * kick;
        let common = momentum / (tip.mass + ground.mass);
        let work = kick
            * 0.5
            * (tip_force * (tip.velocity + common) + ground.force * (ground.velocity + common));
        tip.velocity = common;
        ground.velocity = common;
        self.floor.speed = 0.0;
        let left = tip.kinetic_energy() + ground.kinetic_energy();
        self.books.plastic[Role::Target as usize] += kinetic + work - left;
    }

    /// Brings a tip that would pass the floor within the step to touch it at the end of the step.
    fn close(&mut self, time_step: f64) {
        if self.floor.contact == Contact::Closed {
            return;
        }
        let Some(tip) = self.rod.tip() else { return };
        let gap = self.position() - (tip.position + self.floor.lost_length);
        if gap > self.approach() * time_step {
            return;
        }
        self.floor.contact = Contact::Closed;
        self.meet(gap.max(0.0) / time_step, time_step);
    }

    fn erode(&mut self, limit: f64) {
        while self
            .rod
            .slices
            .last()
            .is_some_and(|slice| slice.strain() >= limit)
        {
            let loss = self.rod.erode_tip();
            self.books.eroded_energy += loss.energy;
            self.books.eroded_momentum += loss.momentum;
            self.floor.lost_length += loss.length;
            self.eroded += 1;
        }
        if self.rod.slices.is_empty() {
            self.floor.contact = Contact::Open;
        }
    }

    /// Position of the crater floor below the original face [m].
    pub(super) fn position(&self) -> f64 {
        self.ground.nodes[0].position + self.floor.depth
    }

    pub(super) fn energy(&self) -> EnergyLedger {
        let [kinetic_projectile, elastic_projectile] = self.rod.energies();
        let [kinetic_target, elastic_target] = self.ground.energies();
        EnergyLedger {
            initial: self.books.initial_energy,
            kinetic_projectile,
            kinetic_target: kinetic_target + self.floor.kinetic_energy(),
            elastic_projectile,
            elastic_target,
            plastic_projectile: self.books.plastic[Role::Projectile as usize],
            plastic_target: self.books.plastic[Role::Target as usize],
            border_shear: 0.0,
            viscous: 0.0,
            contact: self.books.contact_loss,
            boundary: self.ground.boundary_work,
            eroded: self.books.eroded_energy,
            ..EnergyLedger::default()
        }
    }

    pub(super) fn momentum(&self) -> MomentumLedger {
        MomentumLedger {
            initial: self.books.initial_momentum,
            projectile: self.rod.motion().1,
            target: self.ground.momentum(),
            support: self.ground.support_impulse,
            border_shear: 0.0,
            eroded: self.books.eroded_momentum,
            ..MomentumLedger::default()
        }
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
