//! Joints between pieces of eroded bodies: contact of their ends, one by one.

use super::{
    bundle::Bundle,
    contact::{Account, overlap},
    step::Step,
};

/// Two ends of a lane that may touch, other than the tip and the face of whole bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Joint {
    /// The nodes behind it and ahead of it, which nothing else kicks or moves.
    pub(super) ahead: usize,
    pub(super) behind: usize,
    pub(super) lane: usize,
    /// Its place among the joints of the shot.
    pub(super) place: usize,
    /// Whether projectile and target meet there.
    pub(super) is_contact: bool,
    pub(super) closed: bool,
}

impl Joint {
    fn nodes(&self) -> [usize; 2] {
        [self.behind, self.ahead]
    }
}

impl Bundle {
    /// Kicks the joints behind a node.
    #[inline(always)]
    pub(super) fn kick_joints(&mut self, ahead: usize, step: &Step) {
        for j in 0..self.joints.len() {
            if self.joints[j].ahead == ahead {
                self.kick_joint(j, step);
            }
        }
    }

    fn kick_joint(&mut self, j: usize, step: &Step) {
        let joint = self.joints[j];
        let l = joint.lane;
        let whole = &self.whole;
        let account = Account {
            loss: whole.contact_loss.0[l],
            work: whole.friction_work.0[l],
            impulse: whole.friction_impulse.0[l],
        };
        let pair = self.pair(joint.nodes(), l, joint.closed);
        let kicked = pair.kick::<true>(step.kick.0[l], step.before.0[l], account);
        self.joints[j].closed = kicked.closed;
        let whole = &mut self.whole;
        whole.contact_loss.0[l] = kicked.account.loss;
        whole.friction_work.0[l] = kicked.account.work;
        whole.friction_impulse.0[l] = kicked.account.impulse;
        if joint.is_contact {
            whole.closed.0[l] = f64::from(kicked.closed);
            whole.contact_force.0[l] = kicked.push;
        }
        for (node, velocity) in joint.nodes().into_iter().zip(kicked.velocity) {
            self.nodes[node].velocity.0[l] = velocity;
        }
    }

    /// Lets ends meet that would overlap at the end of the step, in the order of the joints.
    #[inline(always)]
    pub(super) fn close_joints(&mut self, step: &Step) {
        let projectile = self.mesh.elements[0];
        let inside = self
            .joints
            .partition_point(|joint| joint.ahead <= projectile);
        for j in 0..inside {
            self.close_joint(j, step);
        }
        self.close_contact(step);
        for j in inside..self.joints.len() {
            self.close_joint(j, step);
        }
    }

    fn close_joint(&mut self, j: usize, step: &Step) {
        let projectile = self.mesh.elements[0];
        let joint = self.joints[j];
        let l = joint.lane;
        let length = step.length.0[l];
        let nodes = joint.nodes();
        if !joint.closed {
            let [a, b] = nodes.map(|node| &self.nodes[node]);
            let gap = b.position.0[l] - a.position.0[l];
            if overlap(gap, a.velocity.0[l] - b.velocity.0[l], length) {
                let pair = self.pair(nodes, l, false);
                let (velocity, lost) = pair.meet(gap, length, self.whole.contact_loss.0[l]);
                for (node, velocity) in nodes.into_iter().zip(velocity) {
                    self.nodes[node].velocity.0[l] = velocity;
                }
                let whole = &mut self.whole;
                whole.contact_loss.0[l] = lost;
                whole.meetings.0[l] += 1.0;
                self.joints[j].closed = true;
                if joint.is_contact {
                    whole.closed.0[l] = 1.0;
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
