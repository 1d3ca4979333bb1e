//! New velocities of projectile and target, and the way that their nodes go in a step.

use std::ops::Range;

use super::{
    bundle::{Back, Bundle, Node},
    step::Step,
};
use crate::{
    chain::{
        friction::{dry_friction, kick, lost_impulse, slide},
        solver::OpenEnd,
    },
    lanes::{LANES, Lanes, PerLane},
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
        let mut sums = self.scalars.accumulated.friction;
        let mut ratio = Lanes::all(0.0);
        let mut limit = Lanes::all(0.0);
        for l in 0..LANES {
            ratio.0[l] = step.kick.0[l] / body.mass.0[l];
            limit.0[l] = body.friction.0[l] * ratio.0[l];
        }
        let mut force_behind = self.forces[inner.start - 2];
        let forces = &self.forces[inner.start - 1..];
        let nodes = self.nodes[inner.clone()].iter_mut();
        let nodes = nodes.zip(&mut self.moves[inner]);
        for ((node, is_moving), &force_ahead) in nodes.zip(forces) {
            let mut change = [0.0; LANES];
            let mut is_held = true;
            for l in 0..LANES {
                change[l] = (force_behind.0[l] - force_ahead.0[l]) * ratio.0[l];
                is_held &= change[l].abs() <= limit.0[l];
            }
            force_behind = force_ahead;
            if is_held & !*is_moving {
                for l in 0..LANES {
                    sums.impulse.0[l] += body.mass.0[l] * change[l];
                }
                continue;
            }
            let velocity = node.velocity.0;
            let mut after = Lanes::all(0.0);
            let mut is_sliding = true;
            for l in 0..LANES {
                let (slides, _, slides_on) = slide(velocity[l], change[l], limit.0[l]);
                after.0[l] = slides;
                is_sliding &= (slides_on & (velocity[l] != 0.0)) | (limit.0[l] == 0.0);
            }
            if !is_sliding {
                for l in 0..LANES {
                    after.0[l] = dry_friction(velocity[l], change[l], limit.0[l]);
                }
            }
            let mut next = sums;
            for l in 0..LANES {
                let (before, after) = (velocity[l], after.0[l]);
                let mut sums = sums.lane(l);
                sums.add(
                    lost_impulse(body.mass.0[l], before, change[l], after),
                    before,
                    after,
                );
                next.set_lane(l, sums);
            }
            sums = next;
            *is_moving = node.go_on(after, step);
        }
        self.scalars.accumulated.friction = sums;
    }

    /// The next node from one on that is not like the others of its body in every lane, or else the end.
    #[inline(always)]
    fn next_irregular(&self, from: usize, end: usize) -> usize {
        let irregular = self.irregular.iter().copied().find(|&node| node >= from);
        irregular.map_or(end, |node| node.min(end))
    }

    /// Kicks and moves a node that is not like the others of its body, and the interfaces behind it.
    #[inline(always)]
    fn kick_irregular(&mut self, i: usize, step: &Step) {
        let body = usize::from(i > self.mesh.elements[0]);
        let (mass, friction) = (self.masses[i].0, self.frictions[i].0);
        let behind = match i {
            0 => Lanes::all(0.0),
            _ => self.forces[i - 1 - body],
        };
        let ahead = self.forces[i - body];
        let in_contact = self.in_contact[i];
        let sums = self.scalars.accumulated.friction;
        let (velocity, position) = (self.nodes[i].velocity, self.nodes[i].position);
        let (mut node, mut next) = (self.nodes[i], sums);
        for l in 0..LANES {
            let (before, mut sums) = (velocity.0[l], sums.lane(l));
            let force = [behind.0[l] - ahead.0[l], friction[l]];
            let kicked = kick([mass[l], before], force, step.kick.0[l] / mass[l]);
            let is_free = in_contact >> l & 1 == 0;
            let lost = if is_free { kicked.lost } else { 0.0 };
            sums.add(lost, before, kicked.velocity);
            next.set_lane(l, sums);
            let moved = position.0[l] + kicked.velocity * step.length.0[l];
            node.velocity.0[l] = if is_free { kicked.velocity } else { before };
            node.position.0[l] = if is_free { moved } else { position.0[l] };
        }
        self.scalars.accumulated.friction = next;
        self.moves[i] = node.moves();
        self.nodes[i] = node;
        self.kick_joints(i, step);
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
                Back::Fixed => sums.support_impulse.0[l] += force.0[l] * kick_time,
                Back::Free => {
                    let force = [force.0[l], friction.0[l]];
                    let kicked = kick([mass, before], force, kick_time / mass);
                    let mut friction = sums.friction.lane(l);
                    friction.add(kicked.lost, before, kicked.velocity);
                    sums.friction.set_lane(l, friction);
                    velocity.0[l] = kicked.velocity;
                }
                Back::Open => {
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
