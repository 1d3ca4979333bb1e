//! Local non-viscous damping: a force against the motion of every node, in proportion to the force that accelerates it
//! \[cundall1987\].

use super::state::State;

impl State {
    /// Adds the damping forces of a fraction of the unbalanced forces. Two ends in contact are one node.
    pub(super) fn damp_locally(&mut self, fraction: f64) {
        let nodes = &mut self.nodes;
        nodes.damping.fill(0.0);
        for segment in &self.segments {
            for i in segment.first_node..=segment.last_node {
                nodes.damping[i] = against(fraction, nodes.force[i], nodes.velocity[i]);
            }
        }
        for s in 0..self.interfaces.len() {
            if !self.interfaces[s].closed {
                continue;
            }
            let (a, b) = (self.segments[s].last_node, self.segments[s + 1].first_node);
            if self.is_fixed(b) {
                // What stands still has nothing to damp.
                self.nodes.damping[a] = 0.0;
                continue;
            }
            let mass = self.nodes.mass[a] + self.nodes.mass[b];
            let velocity = (self.nodes.mass[a] * self.nodes.velocity[a]
                + self.nodes.mass[b] * self.nodes.velocity[b])
                / mass;
            let force = self.nodes.force[a] + self.nodes.force[b];
            // Shared by mass, it leaves the force between the two as it is.
            let damping = against(fraction, force, velocity) / mass;
            self.nodes.damping[a] = self.nodes.mass[a] * damping;
            self.nodes.damping[b] = self.nodes.mass[b] * damping;
        }
        let back = self.nodes.len() - 1;
        if self.is_fixed(back) {
            self.nodes.damping[back] = 0.0;
        }
        for (force, damping) in self.nodes.force.iter_mut().zip(&self.nodes.damping) {
            *force += damping;
        }
    }

    /// Accumulators work and impulse of the damping forces over a kick.
    pub(super) fn account_for_local_damping(&mut self, kick: f64) {
        for i in 0..self.nodes.len() {
            let node = self.nodes.at(i);
            let impulse = -node.damping * kick;
            self.accumulated.damping_impulse += impulse;
            self.accumulated.viscous_work += impulse * 0.5 * (node.velocity_before + node.velocity);
        }
    }
}

/// Force of local damping on a node [N]: a fraction of the force that accelerates it, against its motion.
pub(super) fn against(fraction: f64, force: f64, velocity: f64) -> f64 {
    if velocity == 0.0 {
        0.0
    } else {
        -fraction * force.abs() * velocity.signum()
    }
}
