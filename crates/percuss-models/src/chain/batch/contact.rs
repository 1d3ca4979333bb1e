//! Contact of tip and face in every lane at once, and of two ends of a lane.

use super::{bundle::Bundle, step::Step};
use crate::{
    chain::pair::{Pair, overlap},
    lanes::{LANES, Lanes, PerLane},
};

impl Bundle {
    /// Kicks tip and face, together where they touch and stay so.
    #[inline(always)]
    pub(super) fn kick_contact(&mut self, force_behind: Lanes, step: &Step) {
        let [projectile, _] = self.mesh.elements;
        let whole = [projectile, projectile + 1];
        let pairs = self.contact_pairs(whole, force_behind);
        let (closed, sums) = (self.scalars.closed, self.scalars.accumulated.kicks);
        let (mut next_closed, mut next_sums) = (closed, sums);
        let mut velocity = pairs.velocity;
        let mut contact_force = Lanes::all(0.0);
        for l in 0..LANES {
            let (kick, drift) = (step.kick.0[l], step.before.0[l]);
            let pair = pairs.lane(l);
            let kicked = pair.kick_beside(closed.0[l], [kick, drift], sums.lane(l));
            velocity.set_lane(l, kicked.velocity);
            next_closed.0[l] = kicked.closed;
            next_sums.set_lane(l, kicked.sums);
            contact_force.0[l] = kicked.push;
        }
        self.scalars.closed = next_closed;
        self.scalars.accumulated.kicks = next_sums;
        self.scalars.contact_force = contact_force;
        let mut of_whole = velocity;
        for l in set_bits(self.displaced) {
            for (end, i) in whole.into_iter().enumerate() {
                of_whole[end].0[l] = self.nodes[i].velocity.0[l];
            }
        }
        for (i, velocity) in whole.into_iter().zip(of_whole) {
            self.nodes[i].velocity = velocity;
        }
        for l in set_bits(self.displaced) {
            for (i, velocity) in self.contacts[l].into_iter().zip(velocity) {
                self.nodes[i].velocity.0[l] = velocity.0[l];
            }
        }
    }

    /// Tip and face of every lane.
    #[inline(always)]
    fn contact_pairs(&self, [a, b]: [usize; 2], force_behind: Lanes) -> Pair<Lanes> {
        let bodies = [&self.bodies[0], &self.bodies[1]];
        let ahead = self.forces[a];
        let mut force = [force_behind, ahead];
        for l in 0..LANES {
            force[1].0[l] = 0.0 - ahead.0[l];
        }
        let mut pairs = Pair {
            mass: bodies.map(|body| body.end_mass),
            velocity: [self.nodes[a].velocity, self.nodes[b].velocity],
            force,
            spring_force: force,
            friction: [Lanes::all(0.0), bodies[1].first_friction],
        };
        for l in set_bits(self.displaced) {
            pairs.set_lane(l, self.pair(self.contacts[l], l));
        }
        pairs
    }

    /// Lets tip and face meet where they would overlap at the end of the step, and moves them where they are not those of whole bodies.
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
        for l in set_bits(self.displaced) {
            self.scalars.closed.0[l] = self.close(closed[l], self.contacts[l], l, step);
        }
    }

    /// Lets tip and face of some lanes meet.
    #[cold]
    #[inline(never)]
    fn meet_at_face(&mut self, lanes: u8, step: &Step) {
        for lane in set_bits(lanes) {
            self.meet(self.contacts[lane], lane, step);
            self.scalars.closed.0[lane] = true;
        }
    }

    /// Lets two ends of a lane meet where they would overlap at the end of the step, and moves them; says whether they touch.
    pub(super) fn close(
        &mut self,
        mut closed: bool,
        nodes: [usize; 2],
        lane: usize,
        step: &Step,
    ) -> bool {
        let projectile = self.mesh.elements[0];
        let length = step.length.0[lane];
        if !closed {
            let [a, b] = nodes.map(|node| &self.nodes[node]);
            let velocity = [a.velocity.0[lane], b.velocity.0[lane]];
            let gap = b.position.0[lane] - a.position.0[lane];
            if overlap(velocity, gap, length) {
                self.meet(nodes, lane, step);
                closed = true;
            }
        }
        for i in nodes {
            // Tip and face of whole bodies are moved in all lanes.
            if i != projectile && i != projectile + 1 {
                let node = &mut self.nodes[i];
                node.position.0[lane] += node.velocity.0[lane] * length;
                self.moves[i] |= node.velocity.0[lane] != 0.0;
            }
        }
        closed
    }

    /// Lets two ends of a lane meet.
    fn meet(&mut self, [a, b]: [usize; 2], lane: usize, step: &Step) {
        let mut pair = self.pair([a, b], lane);
        let gap = self.nodes[b].position.0[lane] - self.nodes[a].position.0[lane];
        let shares = pair.shares();
        let mut sums = self.scalars.accumulated.kicks.lane(lane);
        pair.let_go(step.kick.0[lane], shares, &mut sums.friction);
        pair.meet(gap, step.length.0[lane], shares, &mut sums.contact_loss);
        self.scalars.accumulated.kicks.set_lane(lane, sums);
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

/// Numbers of the bits that are set.
#[inline(always)]
fn set_bits(bits: u8) -> impl Iterator<Item = usize> {
    (0..LANES).filter(move |l| bits >> l & 1 == 1)
}
