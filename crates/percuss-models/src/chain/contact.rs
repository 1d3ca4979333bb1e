//! Contact between the ends of two segments: closing, moving as one, parting, and what holds across a gap.

use super::{
    pair::{Pair, overlap},
    state::State,
};

impl State {
    /// Moves the two nodes of a closed contact as one, or lets them part when the contact would pull.
    pub(super) fn kick_contact(&mut self, s: usize, kick: f64) {
        let ends = self.ends(s);
        if self.is_fixed(ends[1]) {
            return self.kick_wall(s, kick);
        }
        let holds = self.interfaces[s].bond.holds();
        let times = [kick, self.time_step];
        let kicked = (self.pair(ends)).kick(true, holds, times, self.accumulated.kicks);
        self.accumulated.kicks = kicked.sums;
        for (end, i) in ends.into_iter().enumerate() {
            self.nodes.velocity_before[i] = kicked.start[end];
            self.nodes.velocity[i] = kicked.velocity[end];
        }
        if !kicked.closed {
            self.part_ends(s);
        } else if Some(s) == self.tip_segment() {
            self.contact_force = kicked.push;
        }
    }

    /// Holds the end that touches a wall, or lets it leave.
    fn kick_wall(&mut self, s: usize, kick: f64) {
        let [a, b] = self.ends(s);
        let push = self.nodes.force[a];
        if push < -self.interfaces[s].bond.holds() {
            self.part_ends(s);
            self.kick_free(a, kick);
            self.kick_boundary(b, kick);
            return;
        }
        for i in [a, b] {
            let jump = 0.0 - self.nodes.velocity[i];
            self.account_for_jump(i, jump, -self.time_step);
            if i == a {
                self.accumulated.support_impulse -= self.nodes.mass[i] * jump;
            }
            self.nodes.velocity_before[i] = 0.0;
            self.nodes.velocity[i] = 0.0;
        }
        self.back_force = push + self.nodes.force[b];
        self.accumulated.support_impulse += self.back_force * kick;
        if Some(s) == self.tip_segment() {
            self.contact_force = push;
        }
    }

    /// Parts two ends, which what still holds goes on to pull together.
    fn part_ends(&mut self, s: usize) {
        let [a, b] = self.ends(s);
        let pull = self.interfaces[s].part();
        self.nodes.force[a] += pull;
        self.nodes.force[b] -= pull;
    }

    /// The nodes on both sides of an interface.
    fn ends(&self, s: usize) -> [usize; 2] {
        [self.segments[s].last_node, self.segments[s + 1].first_node]
    }

    fn pair(&self, [a, b]: [usize; 2]) -> Pair {
        let [a, b] = [self.nodes.at(a), self.nodes.at(b)];
        Pair {
            mass: [a.mass, b.mass],
            velocity: [a.velocity, b.velocity],
            force: [a.force, b.force],
            spring_force: [a.spring_force, b.spring_force],
            friction: [a.friction, b.friction],
        }
    }

    /// Lets what still holds across the gaps pull their ends together.
    pub(super) fn apply_cohesive_traction(&mut self) {
        for s in 0..self.interfaces.len() {
            let (a, b) = (self.segments[s].last_node, self.segments[s + 1].first_node);
            let gap = self.nodes.position[b] - self.nodes.position[a];
            let pull = self.interfaces[s].pull_at(gap);
            self.nodes.force[a] += pull;
            self.nodes.force[b] -= pull;
        }
    }

    /// Accumulators the work of the kick against what holds across the gaps.
    pub(super) fn account_for_fracture(&mut self, kick: f64) {
        for (s, interface) in self.interfaces.iter().enumerate() {
            if interface.pull > 0.0 {
                let a = self.nodes.at(self.segments[s].last_node);
                let b = self.nodes.at(self.segments[s + 1].first_node);
                let before = b.velocity_before - a.velocity_before;
                let after = b.velocity - a.velocity;
                self.accumulated.fracture_work += interface.pull * 0.5 * (before + after) * kick;
            }
        }
    }

    /// Accounts for the energy of a sudden change of a node's velocity: see [`Pair::jump_energy`].
    pub(super) fn account_for_jump(&mut self, i: usize, jump: f64, drift: f64) {
        self.accumulated.kicks.contact_loss -= self.pair([i, i]).jump_energy(0, jump, drift);
    }

    /// Closes every gap that would overlap at the end of the step, so that it is zero then.
    pub(super) fn close_contacts(&mut self, kick: f64, time_step: f64) {
        for s in 0..self.interfaces.len() {
            if self.interfaces[s].closed {
                continue;
            }
            let [a, b] = self.ends(s);
            let gap = self.nodes.position[b] - self.nodes.position[a];
            let velocity = [self.nodes.velocity[a], self.nodes.velocity[b]];
            if !overlap(velocity, gap, time_step) {
                continue;
            }
            let mut pair = self.pair([a, b]);
            let fixed = self.is_fixed(b);
            let shares = if fixed { [1.0, 0.0] } else { pair.shares() };
            let accumulated = &mut self.accumulated;
            let faster = pair.let_go(kick, shares, &mut accumulated.kicks.friction);
            let loss = &mut accumulated.kicks.contact_loss;
            let change = pair.meet(gap, time_step, shares, loss);
            if fixed {
                accumulated.support_impulse += pair.mass[0] * change;
            }
            // What holds across the gap pulls over the way that is left, and no more at its end: the half drift before the kick
            // was accounted for at the speed before the jump, the one before the next kick will not be.
            let pull = self.interfaces[s].pull;
            let pulled = 0.5 * pull * (time_step * (change - faster) - gap.max(0.0));
            accumulated.fracture_work += pulled;
            accumulated.kicks.contact_loss -= pulled;
            [self.nodes.velocity[a], self.nodes.velocity[b]] = pair.velocity;
            self.interfaces[s].closed = true;
            self.meetings += 1;
        }
    }
}
