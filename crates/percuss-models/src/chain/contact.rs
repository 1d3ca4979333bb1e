//! Contact between the ends of two segments: closing, moving as one, parting, and what holds across a gap.

use super::{friction::dry_friction, state::State};

impl State {
    /// Moves the two nodes of a closed contact as one, or lets them part when the contact would pull.
    pub(super) fn kick_contact(&mut self, s: usize, kick: f64) {
        let (a, b) = (self.segments[s].last_node, self.segments[s + 1].first_node);
        let fixed = self.is_fixed(b);
        let (before, combined_mass) = if fixed {
            (0.0, f64::INFINITY)
        } else {
            let mass = self.nodes[a].mass + self.nodes[b].mass;
            let momentum = self.nodes[a].mass * self.nodes[a].velocity
                + self.nodes[b].mass * self.nodes[b].velocity;
            (momentum / mass, mass)
        };
        // Both nodes start the kick with their common velocity; what that costs is the loss of a plastic impact.
        for i in [a, b] {
            let jump = before - self.nodes[i].velocity;
            self.account_for_jump(i, jump, -self.time_step);
            if fixed && i == a {
                self.accumulated.support_impulse -= self.nodes[i].mass * jump;
            }
            self.nodes[i].velocity_before = before;
        }
        let contact_force = if fixed {
            self.nodes[a].velocity = 0.0;
            self.nodes[b].velocity = 0.0;
            self.nodes[a].force
        } else {
            let change = (self.nodes[a].force + self.nodes[b].force) * kick / combined_mass;
            let friction = self.nodes[a].friction + self.nodes[b].friction;
            let after = dry_friction(before, change, friction * kick / combined_mass);
            self.nodes[a].velocity = after;
            self.nodes[b].velocity = after;
            let own_friction = friction_force(
                self.nodes[a].friction,
                friction,
                combined_mass,
                before,
                change,
                after,
                kick,
            );
            self.nodes[a].force + own_friction - self.nodes[a].mass * (after - before) / kick
        };
        if contact_force < -self.interfaces[s].bond.holds() {
            let pull = self.interfaces[s].part();
            self.nodes[a].force += pull;
            self.nodes[b].force -= pull;
            self.nodes[a].velocity = before;
            self.nodes[b].velocity = before;
            self.kick_free(a, kick);
            if self.is_boundary(b) {
                self.kick_boundary(b, kick);
            } else {
                self.kick_free(b, kick);
            }
            return;
        }
        if fixed {
            self.accumulated.support_impulse += (self.nodes[a].force + self.nodes[b].force) * kick;
            self.back_force = self.nodes[a].force + self.nodes[b].force;
        } else {
            let change = (self.nodes[a].force + self.nodes[b].force) * kick / combined_mass;
            self.account_for_friction(combined_mass, before, change, self.nodes[a].velocity);
        }
        if Some(s) == self.tip_segment() {
            self.contact_force = contact_force;
        }
    }

    /// Lets what still holds across the gaps pull their ends together.
    pub(super) fn apply_cohesive_traction(&mut self) {
        for s in 0..self.interfaces.len() {
            let (a, b) = (self.segments[s].last_node, self.segments[s + 1].first_node);
            let gap = self.nodes[b].position - self.nodes[a].position;
            let pull = self.interfaces[s].pull_at(gap);
            self.nodes[a].force += pull;
            self.nodes[b].force -= pull;
        }
    }

    /// Accumulators the work of the kick against what holds across the gaps.
    pub(super) fn account_for_fracture(&mut self, kick: f64) {
        for (s, interface) in self.interfaces.iter().enumerate() {
            if interface.pull > 0.0 {
                let a = &self.nodes[self.segments[s].last_node];
                let b = &self.nodes[self.segments[s + 1].first_node];
                let before = b.velocity_before - a.velocity_before;
                let after = b.velocity - a.velocity;
                self.accumulated.fracture_work += interface.pull * 0.5 * (before + after) * kick;
            }
        }
    }

    /// Accumulators the energy of a sudden change of a node's velocity.
    ///
    /// A kick does its work at the mean of the velocities before and after it, the springs do theirs at the velocities of
    /// the two drifts around it: a jump between kick and drift leaves half a drift's work to account for. `drift` is the length
    /// of the drift on the jump's side of the kick, negative when the jump comes before the kick.
    pub(super) fn account_for_jump(&mut self, i: usize, jump: f64, drift: f64) {
        let velocity = self.nodes[i].velocity;
        let kinetic = 0.5 * self.nodes[i].mass * ((velocity + jump).powi(2) - velocity.powi(2));
        self.accumulated.contact_loss -= kinetic - 0.5 * drift * self.nodes[i].spring_force * jump;
    }

    /// Closes every gap that would overlap at the end of the step, so that it is zero then.
    pub(super) fn close_contacts(&mut self, time_step: f64) {
        for s in 0..self.interfaces.len() {
            if self.interfaces[s].closed {
                continue;
            }
            let (a, b) = (self.segments[s].last_node, self.segments[s + 1].first_node);
            let gap = self.nodes[b].position - self.nodes[a].position;
            let approach = self.nodes[a].velocity - self.nodes[b].velocity;
            if gap - approach * time_step > 0.0 {
                continue;
            }
            let allowed = gap.max(0.0) / time_step;
            let (share_a, share_b) = if self.is_fixed(b) {
                (1.0, 0.0)
            } else {
                let mass = self.nodes[a].mass + self.nodes[b].mass;
                (self.nodes[b].mass / mass, self.nodes[a].mass / mass)
            };
            let change = approach - allowed;
            for (i, jump) in [(a, -share_a * change), (b, share_b * change)] {
                self.account_for_jump(i, jump, time_step);
                self.nodes[i].velocity += jump;
            }
            if self.is_fixed(b) {
                self.accumulated.support_impulse += self.nodes[a].mass * change;
            }
            // What holds across the gap pulls over the way that is left, and no more at its end: the half drift before the kick
            // was accounted for at the speed before the jump, the one before the next kick will not be.
            let pulled = 0.5 * self.interfaces[s].pull * (time_step * change - gap.max(0.0));
            self.accumulated.fracture_work += pulled;
            self.accumulated.contact_loss -= pulled;
            self.interfaces[s].closed = true;
            self.meetings += 1;
        }
    }
}

/// Part of the friction on a pair of nodes that acts on the first of them [N].
fn friction_force(
    own_limit: f64,
    limit: f64,
    mass: f64,
    before: f64,
    change: f64,
    after: f64,
    kick: f64,
) -> f64 {
    if limit == 0.0 {
        return 0.0;
    }
    let impulse = mass * (after - before - change);
    impulse / kick * own_limit / limit
}
