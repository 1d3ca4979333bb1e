//! Two ends that touch, part or meet.

use serde::{Deserialize, Serialize};

use super::friction::{FrictionSums, dry_friction, kick, lost_impulse};
use crate::lanes::larger;

percuss_core::per_lane! {
    /// Two ends at the start of a kick, or of a drift.
    #[derive(Clone, Copy)]
    pub(super) struct Pair<R = f64> {
        pub(super) mass: [R; 2],
        pub(super) velocity: [R; 2],
        pub(super) force: [R; 2],
        /// Force of the elements without viscosity.
        pub(super) spring_force: [R; 2],
        /// Largest friction on them.
        pub(super) friction: [R; 2],
    }
}

/// Two ends that move as one in a kick.
#[derive(Clone, Copy)]
struct Joined {
    /// Their common velocity at its start and at its end.
    before: f64,
    velocity: f64,
    /// Force with which they push each other.
    push: f64,
    /// Impulse that friction took.
    lost: f64,
    /// Energy that contact has taken so far.
    contact_loss: f64,
}

percuss_core::per_lane! {
    /// What kicks take.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct KickSums<R = f64> {
        /// Energy that contact takes.
        pub(super) contact_loss: R,
        pub(super) friction: FrictionSums<R>,
    }
}

/// Two ends after a kick.
pub(super) struct KickedPair {
    /// Velocities from which the kick started.
    pub(super) start: [f64; 2],
    pub(super) velocity: [f64; 2],
    /// Whether they touch still.
    pub(super) closed: bool,
    /// Force with which they push each other.
    pub(super) push: f64,
    pub(super) sums: KickSums,
}

impl Pair {
    /// Kicks two ends as one. Whether friction acts on the first of them, too, is known beforehand; `drift` is the length of the step
    /// before.
    ///
    /// Both start the kick with their common velocity; what that costs is the loss of a plastic impact. It is never negative while the
    /// ends push each other: the forces then accelerate them towards each other.
    #[inline(always)]
    fn join<const BOTH_RUB: bool>(&self, kick: f64, drift: f64, contact_loss: f64) -> Joined {
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

    /// Kicks two ends, together where they touch and stay so. They part where they would pull each other by more than `holds`, and
    /// that pulls from then on. Ends that nothing holds part from their own velocities: joined first, ends that have just met would gain
    /// energy. The times are those of the kick and of the drift before it.
    #[inline(always)]
    pub(super) fn kick(
        &self,
        closed: bool,
        holds: f64,
        [time, drift]: [f64; 2],
        mut sums: KickSums,
    ) -> KickedPair {
        let (mut start, mut pull) = (self.velocity, 0.0);
        if closed {
            let joined = self.join::<true>(time, drift, sums.contact_loss);
            if joined.push >= -holds {
                sums.contact_loss = joined.contact_loss;
                sums.friction
                    .add(joined.lost, joined.before, joined.velocity);
                return KickedPair {
                    start: [joined.before; 2],
                    velocity: [joined.velocity; 2],
                    closed,
                    push: joined.push,
                    sums,
                };
            }
            if holds > 0.0 {
                sums.contact_loss = joined.contact_loss;
                start = [joined.before; 2];
                pull = holds;
            }
        }
        let mut velocity = start;
        for (end, pulled) in [pull, -pull].into_iter().enumerate() {
            let force = [self.force[end] + pulled, self.friction[end]];
            let (mass, before) = (self.mass[end], start[end]);
            let kicked = kick([mass, before], force, time / mass);
            sums.friction.add(kicked.lost, before, kicked.velocity);
            velocity[end] = kicked.velocity;
        }
        KickedPair {
            start,
            velocity,
            closed: false,
            push: 0.0,
            sums,
        }
    }

    /// The same, to the same bits, where nothing holds the ends and no friction acts on the first one.
    // Both cases are worked out and one is chosen, so that a loop over many pairs becomes vector instructions.
    #[inline(always)]
    pub(super) fn kick_beside(
        &self,
        closed: bool,
        [time, drift]: [f64; 2],
        mut sums: KickSums,
    ) -> KickedPair {
        let joined = self.join::<false>(time, drift, sums.contact_loss);
        let stays = closed & (joined.push >= 0.0);
        let [mass_a, mass_b] = self.mass;
        let [velocity_a, velocity_b] = self.velocity;
        let start_a = if stays { joined.before } else { velocity_a };
        let start_b = if stays { joined.before } else { velocity_b };
        let alone_a = velocity_a + self.force[0] * (time / mass_a);
        let force = [self.force[1], self.friction[1]];
        let alone_b = kick([mass_b, velocity_b], force, time / mass_b);
        let velocity_a = if stays { joined.velocity } else { alone_a };
        let velocity_b = if stays {
            joined.velocity
        } else {
            alone_b.velocity
        };
        let lost = if stays { joined.lost } else { alone_b.lost };
        sums.friction.add(lost, start_b, velocity_b);
        sums.contact_loss = if stays {
            joined.contact_loss
        } else {
            sums.contact_loss
        };
        KickedPair {
            start: [start_a, start_b],
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

    /// Lets ends go that are to meet, and that friction held in the kick before although springs push them together. Held friction would
    /// push an end that the other one sets in motion, and so give energy. Returns the speed [m/s] by which they approach faster.
    ///
    /// An end without a share in the change of velocity is held by a wall.
    pub(super) fn let_go(
        &mut self,
        kick: f64,
        shares: [f64; 2],
        friction: &mut FrictionSums,
    ) -> f64 {
        let mut faster = 0.0;
        for (end, towards) in [1.0, -1.0].into_iter().enumerate() {
            let is_held = self.velocity[end] == 0.0 && self.friction[end] > 0.0;
            if is_held && shares[end] > 0.0 && towards * self.spring_force[end] > 0.0 {
                let impulse = self.spring_force[end] * kick;
                friction.impulse -= impulse;
                self.velocity[end] = impulse / self.mass[end];
                faster += towards * self.velocity[end];
            }
        }
        faster
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
