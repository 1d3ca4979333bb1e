//! Contact between segments: one shared node while they press on each other, two when they do not.

use super::{BoundaryCondition, Grid, Law, kick::dry_friction, nodes::Node};

impl<L: Law> Grid<L> {
    /// Moves the shared node of a closed contact, or splits it when it would have to pull.
    pub(super) fn kick_joined(&mut self, s: usize, time_step: f64) {
        let a = self.span(s).1;
        let b = a + 1;
        if let BoundaryCondition::Driven(velocity) = self.hold(b) {
            let node = self.nodes.at(a);
            let impulse = node.force * time_step - node.mass * (velocity - node.before);
            if impulse < 0.0 {
                self.part(s, time_step);
                return;
            }
            self.nodes.velocity[a..=b].fill(velocity);
            self.accumulated.support_impulse += impulse;
            self.accumulated.boundary_work += impulse * velocity;
            self.back_force = impulse / time_step;
            self.note_contact(s, impulse / time_step);
            return;
        }
        let (back, front) = (self.nodes.at(a), self.nodes.at(b));
        let mass = back.mass + front.mass;
        let limit = back.friction + front.friction;
        let change = (back.force + front.force) * time_step / mass;
        let (velocity, taken) = dry_friction(back.velocity, change, limit * time_step / mass);
        let share = if limit > 0.0 {
            back.friction / limit
        } else {
            0.0
        };
        let own = mass * taken * share;
        let impulse = back.force * time_step - own - back.mass * (velocity - back.velocity);
        if impulse < 0.0 {
            self.part(s, time_step);
            return;
        }
        self.nodes.velocity[a..=b].fill(velocity);
        self.nodes.lost_impulse[a] = own;
        self.nodes.lost_impulse[b] = mass * taken - own;
        self.note_contact(s, impulse / time_step);
    }

    fn part(&mut self, s: usize, time_step: f64) {
        self.closed[s] = false;
        let a = self.span(s).1;
        self.kick_alone(a, time_step);
        self.kick_alone(a + 1, time_step);
    }

    fn note_contact(&mut self, s: usize, force: f64) {
        if self.segments[s].body == 0 && self.segments[s + 1].body == 1 {
            self.contact_force = force;
        }
    }

    /// Detects the gaps that this step closes, and stops their faces at the point of contact.
    pub(super) fn detect_contact(&mut self, time_step: f64) {
        for s in 0..self.closed.len() {
            if self.closed[s] {
                continue;
            }
            let a = self.span(s).1;
            let (back, front) = (self.nodes.at(a), self.nodes.at(a + 1));
            let gap = front.position - back.position;
            let approach = |end: fn(&Node) -> f64| end(&back) - end(&front);
            let mean = 0.5 * (approach(|node| node.before) + approach(|node| node.velocity));
            if gap - mean * time_step > 0.0 {
                continue;
            }
            // The mean speed that just closes the gap needs this much less at the end of the step.
            let excess = 2.0 * (mean - gap.max(0.0) / time_step);
            self.push_apart(a, excess);
            self.closed[s] = true;
        }
    }

    /// Brings faces that have met to one velocity.
    pub(super) fn join_met(&mut self) {
        for s in 0..self.closed.len() {
            let a = self.span(s).1;
            let approach = self.nodes.velocity[a] - self.nodes.velocity[a + 1];
            if !self.closed[s] || approach == 0.0 {
                continue;
            }
            for i in [a, a + 1] {
                self.nodes.before[i] = self.nodes.velocity[i];
            }
            self.push_apart(a, approach);
            // Both have one velocity now, whatever the last digit says.
            self.nodes.velocity[a] = self.nodes.velocity[a + 1];
            if L::STORED_ACROSS_STEPS {
                // The stored energy is half the product of the loads on either side of a time. The one ahead changes with
                // the jump now; the one behind will differ from it by the jump when the next step begins.
                for i in [a, a + 1] {
                    let node = self.nodes.at(i);
                    let jump = node.velocity - node.before;
                    self.nodes.jump[i] = jump;
                    self.accumulated.contact_loss += 0.25 * node.force * jump * self.time_step;
                }
            }
        }
    }

    /// Completes the account of the jumps of the last step, now that the load ahead of them is known.
    pub(super) fn account_for_jumps(&mut self, time_step: f64) {
        // Only nodes that touch have a jump, or touched.
        for s in 0..self.closed.len() {
            let a = self.span(s).1;
            for i in [a, a + 1] {
                let jump = std::mem::take(&mut self.nodes.jump[i]);
                self.accumulated.contact_loss -= 0.25 * self.nodes.force[i] * jump * time_step;
            }
        }
    }

    /// Brings bodies that touch and approach at the start to one velocity; bodies that part there do part.
    pub(super) fn join_moving(&mut self) {
        for s in 0..self.closed.len() {
            let a = self.span(s).1;
            if self.nodes.velocity[a] < self.nodes.velocity[a + 1] {
                self.closed[s] = false;
            }
        }
    }

    /// Takes `change` [m/s] off the approach of the nodes `a` and `a + 1`, conserving momentum, and accounts for the loss.
    fn push_apart(&mut self, a: usize, change: f64) {
        let b = a + 1;
        let driven = matches!(self.hold(b), BoundaryCondition::Driven(_));
        let (back, front) = (self.nodes.at(a), self.nodes.at(b));
        let impulse = if driven {
            back.mass * change
        } else {
            change * back.mass * front.mass / (back.mass + front.mass)
        };
        self.nodes.velocity[a] -= impulse / back.mass;
        let work_back = impulse * 0.5 * (back.before + self.nodes.velocity[a]);
        let work_front = if driven {
            let work = impulse * front.velocity;
            self.accumulated.support_impulse += impulse;
            self.accumulated.boundary_work += work;
            work
        } else {
            self.nodes.velocity[b] += impulse / front.mass;
            impulse * 0.5 * (front.before + self.nodes.velocity[b])
        };
        self.accumulated.contact_loss += work_back - work_front;
    }
}
