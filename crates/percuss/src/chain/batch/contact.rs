//! Contact of tip and face in every lane at once, and of two ends of a lane.

use super::{bundle::Bundle, step::Step};
use crate::{
    chain::pair::{Pair, Times},
    lanes::{LaneMask, Lanes, Mask, PerLane, Real},
};

impl Bundle {
    /// Kicks tip and face, together where they touch and stay so.
    #[inline(always)]
    pub(super) fn kick_contact(&mut self, force_behind: Lanes, step: &Step) {
        let [projectile, _] = self.mesh.elements;
        let (a, b) = (projectile, projectile + 1);
        let zero = Lanes::all(0.0);
        let force = [force_behind, zero - self.springs[projectile].axial_force];
        let pair = Pair {
            mass: [self.bodies[0].end_mass, self.bodies[1].end_mass],
            velocity: [self.nodes[a].velocity, self.nodes[b].velocity],
            force,
            spring_force: force,
            friction: [zero, self.bodies[1].first_friction],
        };
        let scalars = &mut self.scalars;
        let (closed, mut sums) = (scalars.closed, scalars.accumulated);
        let kicked = pair.kick::<false>(closed, zero, step.times, &mut sums);
        let [mut velocity_a, mut velocity_b] = kicked.velocity;
        (scalars.closed, scalars.contact_force) = (kicked.closed, kicked.push);
        // Where other nodes than these meet, they do so by themselves.
        if self.displaced != 0 {
            let displaced = LaneMask::of_bits(self.displaced);
            velocity_a = Lanes::select(displaced, pair.velocity[0], velocity_a);
            velocity_b = Lanes::select(displaced, pair.velocity[1], velocity_b);
            sums = PerLane::choose(displaced, scalars.accumulated, sums);
            scalars.closed = (closed & displaced) | (kicked.closed & !displaced);
            scalars.contact_force = Lanes::select(displaced, zero, kicked.push);
        }
        scalars.accumulated = sums;
        self.nodes[a].velocity = velocity_a;
        self.nodes[b].velocity = velocity_b;
    }

    /// Lets tip and face meet where they would overlap at the end of the step.
    #[inline(always)]
    pub(super) fn close_contact(&mut self, step: &Step) {
        let projectile = self.mesh.elements[0];
        let [a, b] = [projectile, projectile + 1].map(|node| self.nodes[node]);
        let gap = b.position - a.position;
        let overlap = Pair::overlap([a.velocity, b.velocity], gap, step.length);
        let meets = overlap & !self.scalars.closed & !LaneMask::of_bits(self.displaced);
        if meets.any() {
            self.meet_at_face(meets, step);
        }
    }

    /// Lets tip and face of some lanes meet.
    #[cold]
    #[inline(never)]
    fn meet_at_face(&mut self, lanes: LaneMask, step: &Step) {
        let projectile = self.mesh.elements[0];
        for lane in lanes.lanes() {
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
        let behind = &self.springs[a - 1 - self.body_of(a)];
        let ahead = &self.springs[b - self.body_of(b)];
        let of = |numbers: &[Lanes]| [numbers[a].0[lane], numbers[b].0[lane]];
        let force = [behind.axial_force.0[lane], 0.0 - ahead.axial_force.0[lane]];
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

impl Step {
    /// Times of a lane.
    pub(super) fn times_of(&self, lane: usize) -> Times {
        Times {
            kick: self.times.kick.0[lane],
            drift: self.times.drift.0[lane],
        }
    }
}
