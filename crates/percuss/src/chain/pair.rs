//! Two ends that touch, part or meet.

use super::friction::{FrictionSums, Kicked, dry_friction, kick, lost_impulse};
use crate::lanes::larger;

/// Two ends at the start of a kick, or of a drift.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub(super) mass: [f64; 2],
    pub(super) velocity: [f64; 2],
    pub(super) force: [f64; 2],
    /// Force of the elements without viscosity.
    pub(super) spring_force: [f64; 2],
    /// Largest friction on them.
    pub(super) friction: [f64; 2],
}

/// Two ends that move as one in a kick.
#[derive(Clone, Copy)]
pub(super) struct Joined {
    /// Their common velocity at its start and at its end.
    pub(super) before: f64,
    pub(super) velocity: f64,
    /// Force with which they push each other.
    pub(super) push: f64,
    /// Impulse that friction took.
    pub(super) lost: f64,
    /// Energy that contact has taken so far.
    pub(super) contact_loss: f64,
}

/// What contact takes.
#[derive(Clone, Copy)]
pub(super) struct ContactSums {
    pub(super) loss: f64,
    pub(super) friction: FrictionSums,
}

/// Two ends after a kick.
pub(super) struct KickedPair {
    pub(super) velocity: [f64; 2],
    /// Whether they touch still.
    pub(super) closed: bool,
    /// Force with which they push each other.
    pub(super) push: f64,
    pub(super) sums: ContactSums,
}

impl Pair {
    /// Kicks two ends as one. Whether friction acts on the first of them, too, is known beforehand; `drift` is the length of the step
    /// before.
    ///
    /// Both start the kick with their common velocity; what that costs is the loss of a plastic impact.
    #[inline(always)]
    pub(super) fn join<const BOTH_RUB: bool>(
        &self,
        kick: f64,
        drift: f64,
        contact_loss: f64,
    ) -> Joined {
        let ([mass_a, mass_b], [velocity_a, velocity_b]) = (self.mass, self.velocity);
        let ([force_a, force_b], [friction_a, friction_b]) = (self.force, self.friction);
        let mass = mass_a + mass_b;
        let before = (mass_a * velocity_a + mass_b * velocity_b) / mass;
        let contact_loss = contact_loss - self.jump_energy(0, before - velocity_a, -drift);
        let contact_loss = contact_loss - self.jump_energy(1, before - velocity_b, -drift);
        let change = (force_a + force_b) * kick / mass;
        let friction = if BOTH_RUB {
            friction_a + friction_b
        } else {
            friction_b
        };
        let velocity = dry_friction(before, change, friction * kick / mass);
        let mut on_a = force_a;
        if BOTH_RUB && friction != 0.0 {
            on_a += mass * (velocity - before - change) / kick * friction_a / friction;
        }
        Joined {
            before,
            velocity,
            push: on_a - mass_a * (velocity - before) / kick,
            lost: lost_impulse(mass, before, change, velocity),
            contact_loss,
        }
    }

    /// Kicks two ends, together where they touch and stay so.
    // Both cases are worked out and one is chosen, so that a loop over many pairs becomes vector instructions.
    #[inline(always)]
    pub(super) fn kick<const BOTH_RUB: bool>(
        &self,
        closed: bool,
        time: f64,
        drift: f64,
        mut sums: ContactSums,
    ) -> KickedPair {
        let joined = self.join::<BOTH_RUB>(time, drift, sums.loss);
        let stays = closed & (joined.push >= 0.0);
        let [mass_a, mass_b] = self.mass;
        let start_a = if closed {
            joined.before
        } else {
            self.velocity[0]
        };
        let start_b = if closed {
            joined.before
        } else {
            self.velocity[1]
        };
        let mut alone_a = Kicked {
            velocity: start_a + self.force[0] * (time / mass_a),
            lost: 0.0,
        };
        if BOTH_RUB {
            let force = [self.force[0], self.friction[0]];
            alone_a = kick([mass_a, start_a], force, time / mass_a);
        }
        let force = [self.force[1], self.friction[1]];
        let alone_b = kick([mass_b, start_b], force, time / mass_b);
        if BOTH_RUB && !stays {
            sums.friction.add(alone_a.lost, start_a, alone_a.velocity);
        }
        let lost = if stays { joined.lost } else { alone_b.lost };
        let velocity_a = if stays {
            joined.velocity
        } else {
            alone_a.velocity
        };
        let velocity_b = if stays {
            joined.velocity
        } else {
            alone_b.velocity
        };
        sums.friction.add(lost, start_b, velocity_b);
        sums.loss = if closed {
            joined.contact_loss
        } else {
            sums.loss
        };
        KickedPair {
            velocity: [velocity_a, velocity_b],
            closed: stays,
            push: if stays { joined.push } else { 0.0 },
            sums,
        }
    }

    /// Energy of a sudden change of a node's velocity.
    ///
    /// A kick does its work at the mean of the velocities before and after it, the springs do theirs at the velocities of
    /// the two drifts around it: a jump between kick and drift leaves half a drift's work to account for. `drift` is the length
    /// of the drift on the jump's side of the kick, negative when the jump comes before the kick.
    #[inline(always)]
    pub(super) fn jump_energy(&self, end: usize, jump: f64, drift: f64) -> f64 {
        let (before, after) = (self.velocity[end], self.velocity[end] + jump);
        let kinetic = 0.5 * self.mass[end] * (after * after - before * before);
        kinetic - 0.5 * drift * self.spring_force[end] * jump
    }

    /// Lets two ends across a gap meet at the end of a drift, each taking its share of the change of velocity; gives the change.
    pub(super) fn meet(
        &mut self,
        gap: f64,
        drift: f64,
        [share_a, share_b]: [f64; 2],
        contact_loss: &mut f64,
    ) -> f64 {
        let approach = self.velocity[0] - self.velocity[1];
        let change = approach - larger(gap, 0.0) / drift;
        for (end, jump) in [-share_a * change, share_b * change]
            .into_iter()
            .enumerate()
        {
            *contact_loss -= self.jump_energy(end, jump, drift);
            self.velocity[end] += jump;
        }
        change
    }

    /// Shares of two free ends in a change of their velocities.
    pub(super) fn shares(&self) -> [f64; 2] {
        let [mass_a, mass_b] = self.mass;
        let mass = mass_a + mass_b;
        [mass_b / mass, mass_a / mass]
    }
}

/// Whether two ends across a gap would overlap at the end of a drift.
#[inline(always)]
pub(super) fn overlap(velocity: [f64; 2], gap: f64, drift: f64) -> bool {
    gap - (velocity[0] - velocity[1]) * drift <= 0.0
}
