//! Contact of tip and face in every lane at once, and of two ends of a lane.

use super::{bundle::Bundle, step::Step};
use crate::{
    chain::pair::{ContactSums, Pair, overlap},
    lanes::{LANES, Lanes, PerLane},
};

impl Bundle {
    /// Kicks tip and face, together where they touch and stay so.
    #[inline(always)]
    pub(super) fn kick_contact(&mut self, force_behind: Lanes, step: &Step) {
        let [projectile, _] = self.mesh.elements;
        let (a, b) = (projectile, projectile + 1);
        let ahead = self.forces[projectile];
        let bodies = [&self.bodies[0], &self.bodies[1]];
        let [mass_a, mass_b] = bodies.map(|body| body.end_mass);
        let friction = bodies[1].first_friction;
        let (before_a, before_b) = (self.nodes[a].velocity, self.nodes[b].velocity);
        let (mut velocity_a, mut velocity_b) = (before_a, before_b);
        let closed = self.scalars.closed;
        let loss = self.scalars.accumulated.contact_loss;
        let sums = self.scalars.accumulated.friction;
        let (mut next_closed, mut next_loss, mut next_sums) = (closed, loss, sums);
        let mut contact_force = Lanes::all(0.0);
        for l in 0..LANES {
            let force = [force_behind.0[l], 0.0 - ahead.0[l]];
            let pair = Pair {
                mass: [mass_a.0[l], mass_b.0[l]],
                velocity: [before_a.0[l], before_b.0[l]],
                force,
                spring_force: force,
                friction: [0.0, friction.0[l]],
            };
            let sums = ContactSums {
                loss: loss.0[l],
                friction: sums.lane(l),
            };
            let (kick, drift) = (step.kick.0[l], step.before.0[l]);
            let kicked = pair.kick_beside(closed.0[l], [kick, drift], sums);
            velocity_a.0[l] = kicked.velocity[0];
            velocity_b.0[l] = kicked.velocity[1];
            next_closed.0[l] = kicked.closed;
            next_loss.0[l] = kicked.sums.loss;
            next_sums.set_lane(l, kicked.sums.friction);
            contact_force.0[l] = kicked.push;
        }
        // Where other nodes than these meet, they do so by themselves.
        for l in (0..LANES).filter(|l| self.displaced >> l & 1 == 1) {
            velocity_a.0[l] = before_a.0[l];
            velocity_b.0[l] = before_b.0[l];
            next_closed.0[l] = closed.0[l];
            next_loss.0[l] = loss.0[l];
            next_sums.set_lane(l, sums.lane(l));
            contact_force.0[l] = 0.0;
        }
        self.scalars.closed = next_closed;
        self.scalars.accumulated.contact_loss = next_loss;
        self.scalars.accumulated.friction = next_sums;
        self.scalars.contact_force = contact_force;
        self.nodes[a].velocity = velocity_a;
        self.nodes[b].velocity = velocity_b;
    }

    /// Lets tip and face meet where they would overlap at the end of the step.
    #[inline(always)]
    pub(super) fn close_contact(&mut self, step: &Step) {
        let projectile = self.mesh.elements[0];
        let [a, b] = [projectile, projectile + 1].map(|node| self.nodes[node]);
        let closed = self.scalars.closed.0;
        let mut meets = 0;
        for l in 0..LANES {
            let velocity = [a.velocity.0[l], b.velocity.0[l]];
            let overlaps = overlap(
                velocity,
                b.position.0[l] - a.position.0[l],
                step.length.0[l],
            );
            meets |= u8::from(overlaps & !closed[l]) << l;
        }
        meets &= !self.displaced;
        if meets != 0 {
            self.meet_at_face(meets, step);
        }
    }

    /// Lets tip and face of some lanes meet.
    #[cold]
    #[inline(never)]
    fn meet_at_face(&mut self, lanes: u8, step: &Step) {
        let projectile = self.mesh.elements[0];
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 == 1) {
            self.meet([projectile, projectile + 1], lane, step);
            self.scalars.closed.0[lane] = true;
        }
    }

    /// Lets two ends of a lane meet.
    pub(super) fn meet(&mut self, [a, b]: [usize; 2], lane: usize, step: &Step) {
        let mut pair = self.pair([a, b], lane);
        let gap = self.nodes[b].position.0[lane] - self.nodes[a].position.0[lane];
        let shares = pair.shares();
        let loss = &mut self.scalars.accumulated.contact_loss.0[lane];
        pair.meet(gap, step.length.0[lane], shares, loss);
        for (node, velocity) in [a, b].into_iter().zip(pair.velocity) {
            self.nodes[node].velocity.0[lane] = velocity;
        }
        self.scalars.meetings.0[lane] += 1.0;
    }

    /// Two ends of a lane.
    pub(super) fn pair(&self, [a, b]: [usize; 2], lane: usize) -> Pair {
        let behind = &self.forces[a - 1 - self.body_of(a)];
        let ahead = &self.forces[b - self.body_of(b)];
        let of = |numbers: &[Lanes]| [numbers[a].0[lane], numbers[b].0[lane]];
        let force = [behind.0[lane], 0.0 - ahead.0[lane]];
        Pair {
            mass: of(&self.masses),
            velocity: [a, b].map(|node| self.nodes[node].velocity.0[lane]),
            force,
            spring_force: force,
            friction: of(&self.frictions),
        }
    }

    /// Body of a node: the projectile (0) or the target (1).
    #[inline(always)]
    fn body_of(&self, node: usize) -> usize {
        usize::from(node > self.mesh.elements[0])
    }
}
