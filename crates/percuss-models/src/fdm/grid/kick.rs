//! New velocities from the forces of a step.

use std::ops::Range;

use super::{BoundaryCondition, Grid, Law, nodes::Kick};

/// Velocity after a change by forces and one of at most `limit` by friction, and what friction took.
///
/// Friction opposes the velocity after the kick and holds the node still when it can. Where the velocity turns within the
/// step it could push on average: it may not, and the node is left to the force alone.
#[inline(always)]
pub(super) fn dry_friction(before: f64, change: f64, limit: f64) -> (f64, f64) {
    let free = before + change;
    // Without branches: which way they go changes from node to node.
    let slowed = free - limit.copysign(free);
    let after = if free.abs() <= limit { 0.0 } else { slowed };
    let taken = free - after;
    let is_free = (taken * (before + after) < 0.0) | (limit == 0.0);
    let velocity = if is_free { free } else { after };
    (velocity, if is_free { 0.0 } else { taken })
}

impl<L: Law> Grid<L> {
    pub(super) fn kick(&mut self, time_step: f64) {
        self.contact_force = 0.0;
        self.back_force = 0.0;
        self.nodes.before.copy_from_slice(&self.nodes.velocity);
        self.nodes.lost_impulse.fill(0.0);
        let segments = self.segments.len();
        let mut joined_ahead = false;
        for s in 0..segments {
            let (first, last) = self.span(s);
            let joined_behind = self.closed.get(s) == Some(&true);
            if !joined_ahead && (first < last || !joined_behind) {
                self.kick_alone(first, time_step);
            }
            if first < last {
                // Nothing holds the nodes in between.
                self.kick_free(first + 1..last, time_step);
                if !joined_behind {
                    self.kick_alone(last, time_step);
                }
            }
            if joined_behind {
                self.kick_joined(s, time_step);
            }
            joined_ahead = joined_behind;
        }
        if self.tip_pressure > 0.0 {
            let last = self.nodes.last().unwrap_or_default();
            self.contact_force = last.lost_impulse / time_step;
        }
    }

    /// What holds a node, if it stands at an end of the grid.
    pub(super) fn hold(&self, i: usize) -> BoundaryCondition {
        match self.ends {
            [end, _] if i == 0 && end != BoundaryCondition::Free => end,
            [_, end] if i + 1 == self.nodes.len() => end,
            _ => BoundaryCondition::Free,
        }
    }

    fn kick_free(&mut self, range: Range<usize>, time_step: f64) {
        pulp::Arch::new().dispatch(Kick {
            nodes: &mut self.nodes,
            range,
            time_step,
        });
    }

    pub(super) fn kick_alone(&mut self, i: usize, time_step: f64) {
        let node = self.nodes.at(i);
        let velocity = match self.hold(i) {
            BoundaryCondition::Free => return self.kick_free(i..i + 1, time_step),
            BoundaryCondition::Driven(velocity) => velocity,
            BoundaryCondition::Dashpot(impedance) => {
                let inertia = node.mass / time_step;
                ((inertia - 0.5 * impedance) * node.before + node.force)
                    / (inertia + 0.5 * impedance)
            }
        };
        self.nodes.velocity[i] = velocity;
        // What the end took follows from what the node did not gain.
        let impulse = node.force * time_step - node.mass * (velocity - node.before);
        let work = impulse * 0.5 * (node.before + velocity);
        self.accumulated.support_impulse += impulse;
        self.accumulated.boundary_work += work;
        if i + 1 == self.nodes.len() {
            self.back_force = impulse / time_step;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::dry_friction;

    #[test]
    fn friction_holds_slows_and_never_pushes() {
        assert_eq!(dry_friction(0.0, 0.5, 1.0), (0.0, 0.5));
        assert_eq!(dry_friction(0.0, 1.5, 1.0), (0.5, 1.0));
        assert_eq!(dry_friction(3.0, -0.5, 1.0), (1.5, 1.0));
        for i in 0..200 {
            for j in 0..200 {
                let (before, change) = (i as f64 * 0.05 - 5.0, j as f64 * 0.05 - 5.0);
                for limit in [0.1, 1.0, 3.0] {
                    let (after, taken) = dry_friction(before, change, limit);
                    assert!(taken.abs() <= limit + before.abs() + 1e-12);
                    assert!(taken * (before + after) >= -1e-12);
                }
            }
        }
    }
}
