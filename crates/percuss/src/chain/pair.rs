//! Two ends that touch, part or meet.

use super::{
    friction::{dry_friction, kick},
    state::Accumulators,
};
use crate::lanes::{Mask, Real, larger};

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

/// Time of a kick [s], and of the drift before it.
#[derive(Clone, Copy)]
pub(super) struct Times<R = f64> {
    pub(super) kick: R,
    pub(super) drift: R,
}

/// Two ends after a kick.
pub(super) struct KickedPair<R: Real> {
    /// Velocities from which the kick started.
    pub(super) start: [R; 2],
    pub(super) velocity: [R; 2],
    /// Where they touch still.
    pub(super) closed: R::Mask,
    /// Force with which they push each other; 0 where they do not touch.
    pub(super) push: R,
}

impl<R: Real> Pair<R> {
    /// Kicks two ends, together where they touch and stay so: those that touch part where they would pull each other by more than
    /// `holds`, and what still holds pulls from then on. `RUBS`: whether friction acts on the first of them, too.
    ///
    /// Ends that touch start the kick with their common velocity; what that costs is the loss of a plastic impact.
    #[inline(always)]
    pub(super) fn kick<const RUBS: bool>(
        &self,
        closed: R::Mask,
        holds: R,
        times: Times<R>,
        sums: &mut Accumulators<R>,
    ) -> KickedPair<R> {
        let (zero, velocity) = (R::all(0.0), self.velocity);
        let [mass_a, mass_b] = self.mass;
        let ([force_a, force_b], [friction_a, friction_b]) = (self.force, self.friction);
        let mass = mass_a + mass_b;
        let common = (mass_a * velocity[0] + mass_b * velocity[1]) / mass;
        let mut loss = sums.contact_loss;
        for end in 0..2 {
            loss -= self.jump_energy(end, common - velocity[end], -times.drift);
        }
        sums.contact_loss = R::select(closed, loss, sums.contact_loss);
        let change = (force_a + force_b) * times.kick / mass;
        let friction = if RUBS {
            friction_a + friction_b
        } else {
            friction_b
        };
        let together = dry_friction(common, change, friction * times.kick / mass);
        let mut on_a = force_a;
        if RUBS {
            let impulse = mass * (together - common - change);
            let own = impulse / times.kick * friction_a / friction;
            on_a += R::select(friction.equals(zero), zero, own);
        }
        let push = on_a - mass_a * (together - common) / times.kick;
        let stays = closed & push.at_least(-holds);
        let lost = mass * (common + change - together);
        let start = velocity.map(|velocity| R::select(closed, common, velocity));
        if stays.every() {
            sums.friction.add(lost, common, together);
            return KickedPair {
                start,
                velocity: [together; 2],
                closed: stays,
                push,
            };
        }
        let pull = R::select(closed, holds, zero);
        let ratio = [times.kick / mass_a, times.kick / mass_b];
        let force = [force_a + pull, force_b - pull];
        let mut a = start[0] + force[0] * ratio[0];
        if RUBS {
            let kicked = kick(mass_a, start[0], force[0], friction_a, ratio[0]);
            let lost = R::select(stays, zero, kicked.lost);
            sums.friction.add(lost, start[0], kicked.velocity);
            a = kicked.velocity;
        }
        let b = kick(mass_b, start[1], force[1], friction_b, ratio[1]);
        let velocity = [a, b.velocity];
        let velocity = velocity.map(|alone| R::select(stays, together, alone));
        let lost = R::select(stays, lost, b.lost);
        sums.friction.add(lost, start[1], velocity[1]);
        KickedPair {
            start,
            velocity,
            closed: stays,
            push: R::select(stays, push, zero),
        }
    }

    /// Energy of a sudden change of a node's velocity.
    ///
    /// A kick does its work at the mean of the velocities before and after it, the springs do theirs at the velocities of
    /// the two drifts around it: a jump between kick and drift leaves half a drift's work to account for. `drift` is the length
    /// of the drift on the jump's side of the kick, negative when the jump comes before the kick.
    #[inline(always)]
    pub(super) fn jump_energy(&self, end: usize, jump: R, drift: R) -> R {
        let (mass, velocity) = (self.mass[end], self.velocity[end]);
        jump_energy(mass, velocity, self.spring_force[end], jump, drift)
    }

    /// Lets two ends across a gap meet at the end of a drift, the first one taking a share of the change of velocity, the second one
    /// the other; gives the change.
    #[inline(always)]
    pub(super) fn meet(&mut self, gap: R, drift: R, shares: [R; 2], loss: &mut R) -> R {
        let approach = self.velocity[0] - self.velocity[1];
        let change = approach - larger(gap, R::all(0.0)) / drift;
        for (end, jump) in [-shares[0] * change, shares[1] * change]
            .into_iter()
            .enumerate()
        {
            *loss -= self.jump_energy(end, jump, drift);
            self.velocity[end] = self.velocity[end] + jump;
        }
        change
    }

    /// Shares of two free ends in a change of their velocities.
    #[inline(always)]
    pub(super) fn shares(&self) -> [R; 2] {
        let mass = self.mass[0] + self.mass[1];
        [self.mass[1] / mass, self.mass[0] / mass]
    }

    /// Whether two ends across a gap would overlap at the end of a drift.
    #[inline(always)]
    pub(super) fn overlap(velocity: [R; 2], gap: R, drift: R) -> R::Mask {
        (gap - (velocity[0] - velocity[1]) * drift).at_most(R::all(0.0))
    }
}

/// [`Pair::jump_energy`] of one node.
#[inline(always)]
pub(super) fn jump_energy<R: Real>(mass: R, velocity: R, spring_force: R, jump: R, drift: R) -> R {
    let after = velocity + jump;
    let kinetic = mass * 0.5 * (after * after - velocity * velocity);
    kinetic - drift * 0.5 * spring_force * jump
}
