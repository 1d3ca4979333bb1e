//! New velocities of projectile and target, and the way that their nodes go in a step.

use std::ops::Range;

use super::{
    bundle::{Bundle, Node},
    step::Step,
};
use crate::{
    chain::{
        friction::{KickedMasses, kick},
        solver::OpenEnd,
    },
    lanes::{LANES, Lanes, PerLane},
    problem::RearFaceCondition,
};

impl Bundle {
    /// Kicks and moves all of the projectile but its tip; returns the force on the tip.
    #[inline(always)]
    pub(super) fn kick_projectile(&mut self, step: &Step) -> Lanes {
        let tip = self.mesh.elements[0];
        let mut from = 0;
        while from < tip {
            let irregular = self.next_irregular(from, tip);
            self.kick_rod(from..irregular, step);
            if irregular < tip {
                self.kick_irregular(irregular, step);
            }
            from = irregular + 1;
        }
        self.forces[tip - 1]
    }

    /// Kicks and moves nodes of the projectile that are like each other.
    #[inline(always)]
    fn kick_rod(&mut self, nodes: Range<usize>, step: &Step) {
        if nodes.is_empty() {
            return;
        }
        let body = self.bodies[0];
        let (mut ratio, mut end_ratio) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            ratio[l] = step.kick.0[l] / body.mass.0[l];
            end_ratio[l] = step.kick.0[l] / body.end_mass.0[l];
        }
        let mut force_behind = match nodes.start {
            0 => Lanes::all(0.0),
            first => self.forces[first - 1],
        };
        // Told that no index is out of range, the compiler would take several nodes at once, lane by lane.
        for i in nodes {
            let ratio = if i == 0 { end_ratio } else { ratio };
            let force_ahead = self.forces[i];
            let mut velocity = self.nodes[i].velocity;
            for l in 0..LANES {
                velocity.0[l] += (force_behind.0[l] - force_ahead.0[l]) * ratio[l];
            }
            self.moves[i] = self.nodes[i].go_on(velocity, step);
            force_behind = force_ahead;
        }
    }

    /// Kicks the target behind its face, which has been kicked, and moves what is between its ends.
    #[inline(always)]
    pub(super) fn kick_target(&mut self, step: &Step) {
        let [projectile, count] = self.mesh.elements;
        let back = projectile + 1 + count;
        let mut from = projectile + 2;
        while from < back {
            let irregular = self.next_irregular(from, back);
            self.kick_column(from..irregular, step);
            if irregular < back {
                self.kick_irregular(irregular, step);
            }
            from = irregular + 1;
        }
        self.kick_back(back, self.forces[back - 2], step);
    }

    /// Kicks and moves nodes of the target that are like each other.
    #[inline(always)]
    fn kick_column(&mut self, inner: Range<usize>, step: &Step) {
        if inner.is_empty() {
            return;
        }
        let body = self.bodies[1];
        let mut sums = self.scalars.accumulated.kicks.friction;
        let kicked = KickedMasses::of(body.mass, body.friction, step);
        let mut force_behind = self.forces[inner.start - 2];
        let forces = &self.forces[inner.start - 1..];
        let nodes = self.nodes[inner.clone()].iter_mut();
        let nodes = nodes.zip(&mut self.moves[inner]);
        for ((node, is_moving), &force_ahead) in nodes.zip(forces) {
            let mut force = Lanes::all(0.0);
            for l in 0..LANES {
                force.0[l] = force_behind.0[l] - force_ahead.0[l];
            }
            force_behind = force_ahead;
            if let Some(velocity) = sums.kick(&kicked, node.velocity, *is_moving, force) {
                *is_moving = node.go_on(velocity, step);
            }
        }
        self.scalars.accumulated.kicks.friction = sums;
    }

    /// The next node from one on that is not like the others of its body in every lane, or else the end.
    #[inline(always)]
    fn next_irregular(&self, from: usize, end: usize) -> usize {
        let passed = self.irregular.partition_point(|&node| node < from);
        let next = self.irregular.get(passed);
        next.map_or(end, |&node| node.min(end))
    }

    /// Kicks and moves a node that is not like the others of its body, and the interfaces behind it.
    #[inline(always)]
    fn kick_irregular(&mut self, i: usize, step: &Step) {
        let body = usize::from(i > self.mesh.elements[0]);
        let behind = match i {
            0 => Lanes::all(0.0),
            _ => self.forces[i - 1 - body],
        };
        let ahead = self.forces[i - body];
        let in_contact = self.in_contact[i];
        let mut kicked = KickedMasses::of(self.masses[i], self.frictions[i], step);
        let mut force = Lanes::all(0.0);
        for l in 0..LANES {
            // What an interface kicks goes on as it is.
            let is_free = in_contact >> l & 1 == 0;
            let net = behind.0[l] - ahead.0[l];
            force.0[l] = if is_free { net } else { 0.0 };
            kicked.limit.0[l] = if is_free { kicked.limit.0[l] } else { 0.0 };
        }
        let mut sums = self.scalars.accumulated.kicks.friction;
        let mut node = self.nodes[i];
        if let Some(velocity) = sums.kick(&kicked, node.velocity, self.moves[i], force) {
            let position = node.position;
            self.moves[i] = node.go_on(velocity, step);
            for l in 0..LANES {
                let is_free = in_contact >> l & 1 == 0;
                node.position.0[l] = if is_free {
                    node.position.0[l]
                } else {
                    position.0[l]
                };
            }
            self.nodes[i] = node;
        }
        self.scalars.accumulated.kicks.friction = sums;
        if in_contact != 0 {
            self.kick_joints(i, step);
        }
    }

    /// Kicks the back of the target.
    #[inline(always)]
    fn kick_back(&mut self, node: usize, force: Lanes, step: &Step) {
        let body = self.bodies[1];
        let (mass, friction) = (body.end_mass, body.last_friction);
        let (before, impedance) = (self.nodes[node].velocity, self.scalars.impedance);
        let mut velocity = Lanes::all(0.0);
        let sums = &mut self.scalars.accumulated;
        for l in 0..LANES {
            let (mass, before, kick_time) = (mass.0[l], before.0[l], step.kick.0[l]);
            match self.mesh.back {
                RearFaceCondition::Fixed => sums.support_impulse.0[l] += force.0[l] * kick_time,
                RearFaceCondition::Free => {
                    let force = [force.0[l], friction.0[l]];
                    let kicked = kick([mass, before], force, kick_time / mass);
                    let mut friction = sums.kicks.friction.lane(l);
                    friction.add(kicked.lost, before, kicked.velocity);
                    sums.kicks.friction.set_lane(l, friction);
                    velocity.0[l] = kicked.velocity;
                }
                RearFaceCondition::NonReflecting => {
                    let end = OpenEnd {
                        impedance: impedance.0[l],
                        spring: 0.0,
                    };
                    let [after, mean, back] = end.kick(mass, before, force.0[l], kick_time);
                    sums.support_impulse.0[l] += back * kick_time;
                    sums.boundary_work.0[l] += back * mean * kick_time;
                    velocity.0[l] = after;
                }
            }
        }
        self.nodes[node].velocity = velocity;
    }

    #[inline(always)]
    pub(super) fn drift(&mut self, i: usize, step: &Step) {
        let velocity = self.nodes[i].velocity;
        self.moves[i] = self.nodes[i].go_on(velocity, step);
    }
}

impl KickedMasses<Lanes> {
    /// Masses with the largest friction on them in a step.
    #[inline(always)]
    fn of(mass: Lanes, friction: Lanes, step: &Step) -> Self {
        let mut kicked = Self {
            mass,
            ratio: mass,
            limit: mass,
        };
        for l in 0..LANES {
            kicked.ratio.0[l] = step.kick.0[l] / mass.0[l];
            kicked.limit.0[l] = friction.0[l] * kicked.ratio.0[l];
        }
        kicked
    }
}

impl Node {
    /// Moves the node at a velocity for a step; says whether it moves in any lane.
    #[inline(always)]
    fn go_on(&mut self, velocity: Lanes, step: &Step) -> bool {
        let mut position = self.position;
        for l in 0..LANES {
            position.0[l] += velocity.0[l] * step.length.0[l];
        }
        (self.velocity, self.position) = (velocity, position);
        self.moves()
    }

    #[inline(always)]
    fn moves(&self) -> bool {
        let velocity = self.velocity.0;
        let mut moves = false;
        for l in 0..LANES {
            moves |= velocity[l] != 0.0;
        }
        moves
    }
}
