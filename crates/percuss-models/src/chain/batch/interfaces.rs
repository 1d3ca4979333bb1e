//! Joints between pieces of eroded bodies: contact of their ends, one by one.

use super::{
    bundle::Bundle,
    contact::{Account, overlap},
    step::Step,
};

/// Two ends of a lane that may touch, other than the tip and the face of whole bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Interface {
    /// The nodes behind it and ahead of it, which nothing else kicks or moves.
    pub(super) ahead: usize,
    pub(super) behind: usize,
    pub(super) lane: usize,
    /// Its place among the interfaces of the shot.
    pub(super) place: usize,
    /// Whether projectile and target meet there.
    pub(super) is_contact: bool,
    pub(super) closed: bool,
}

impl Interface {
    fn nodes(&self) -> [usize; 2] {
        [self.behind, self.ahead]
    }
}

impl Bundle {
    /// Kicks the interfaces behind a node.
    #[inline(always)]
    pub(super) fn kick_joints(&mut self, ahead: usize, step: &Step) {
        for j in 0..self.interfaces.len() {
            if self.interfaces[j].ahead == ahead {
                self.kick_joint(j, step);
            }
        }
    }

    fn kick_joint(&mut self, j: usize, step: &Step) {
        let interface = self.interfaces[j];
        let l = interface.lane;
        let scalars = &self.scalars;
        let account = Account {
            loss: scalars.contact_loss.0[l],
            work: scalars.friction_work.0[l],
            impulse: scalars.friction_impulse.0[l],
        };
        let pair = self.pair(interface.nodes(), l, interface.closed);
        let kicked = pair.kick::<true>(step.kick.0[l], step.before.0[l], account);
        self.interfaces[j].closed = kicked.closed;
        let scalars = &mut self.scalars;
        scalars.contact_loss.0[l] = kicked.account.loss;
        scalars.friction_work.0[l] = kicked.account.work;
        scalars.friction_impulse.0[l] = kicked.account.impulse;
        if interface.is_contact {
            scalars.closed.0[l] = f64::from(kicked.closed);
            scalars.contact_force.0[l] = kicked.push;
        }
        for (node, velocity) in interface.nodes().into_iter().zip(kicked.velocity) {
            self.nodes[node].velocity.0[l] = velocity;
        }
    }

    /// Lets ends meet that would overlap at the end of the step, in the order of the interfaces.
    #[inline(always)]
    pub(super) fn close_joints(&mut self, step: &Step) {
        let projectile = self.mesh.elements[0];
        let inside = self
            .interfaces
            .partition_point(|interface| interface.ahead <= projectile);
        for j in 0..inside {
            self.close_joint(j, step);
        }
        self.close_contact(step);
        for j in inside..self.interfaces.len() {
            self.close_joint(j, step);
        }
    }

    fn close_joint(&mut self, j: usize, step: &Step) {
        let projectile = self.mesh.elements[0];
        let interface = self.interfaces[j];
        let l = interface.lane;
        let length = step.length.0[l];
        let nodes = interface.nodes();
        if !interface.closed {
            let [a, b] = nodes.map(|node| &self.nodes[node]);
            let gap = b.position.0[l] - a.position.0[l];
            if overlap(gap, a.velocity.0[l] - b.velocity.0[l], length) {
                let pair = self.pair(nodes, l, false);
                let (velocity, lost) = pair.meet(gap, length, self.scalars.contact_loss.0[l]);
                for (node, velocity) in nodes.into_iter().zip(velocity) {
                    self.nodes[node].velocity.0[l] = velocity;
                }
                let scalars = &mut self.scalars;
                scalars.contact_loss.0[l] = lost;
                scalars.meetings.0[l] += 1.0;
                self.interfaces[j].closed = true;
                if interface.is_contact {
                    scalars.closed.0[l] = 1.0;
                }
            }
        }
        // Tip and face are moved in all lanes.
        for i in nodes
            .into_iter()
            .filter(|i| ![projectile, projectile + 1].contains(i))
        {
            let node = &mut self.nodes[i];
            node.position.0[l] += node.velocity.0[l] * length;
            self.moves[i] |= node.velocity.0[l] != 0.0;
        }
    }
}
