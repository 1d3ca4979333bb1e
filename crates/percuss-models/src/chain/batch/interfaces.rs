//! Joints between pieces of eroded bodies: contact of their ends, one by one.

use super::{bundle::Bundle, step::Step};
use crate::lanes::PerLane;

/// Two ends of a lane that may touch, other than tip and face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Interface {
    /// The nodes behind it and ahead of it, which nothing else kicks or moves.
    pub(super) ahead: usize,
    pub(super) behind: usize,
    pub(super) lane: usize,
    /// Its place among the interfaces of the run.
    pub(super) place: usize,
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
        let is_behind = |interface: &Interface| interface.ahead < ahead;
        let first = self.interfaces.partition_point(is_behind);
        for j in first..self.interfaces.len() {
            if self.interfaces[j].ahead > ahead {
                break;
            }
            self.kick_joint(j, step);
        }
    }

    fn kick_joint(&mut self, j: usize, step: &Step) {
        let interface = self.interfaces[j];
        let lane = interface.lane;
        let pair = self.pair(interface.nodes(), lane);
        let sums = &mut self.scalars.accumulated.kicks;
        let (kick, drift) = (step.kick.0[lane], step.before.0[lane]);
        let kicked = pair.kick(interface.closed, 0.0, [kick, drift], sums.lane(lane));
        sums.set_lane(lane, kicked.sums);
        self.interfaces[j].closed = kicked.closed;
        for (node, velocity) in interface.nodes().into_iter().zip(kicked.velocity) {
            self.nodes[node].velocity.0[lane] = velocity;
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
        let Interface { lane, closed, .. } = self.interfaces[j];
        let nodes = self.interfaces[j].nodes();
        self.interfaces[j].closed = self.close(closed, nodes, lane, step);
    }
}
