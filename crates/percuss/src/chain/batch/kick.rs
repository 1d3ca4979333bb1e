//! New velocities of projectile and target, and the way that their nodes go in a step.

use std::ops::Range;

use super::{
    bundle::{Back, Bundle, Node},
    step::Step,
};
use crate::{
    chain::{
        friction::{dry_friction, kick},
        solver::kick_open_end,
    },
    lanes::{LaneMask, Lanes, Mask, Real},
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
        self.springs[tip - 1].axial_force
    }

    /// Kicks and moves nodes of the projectile that are like each other.
    #[inline(always)]
    fn kick_rod(&mut self, nodes: Range<usize>, step: &Step) {
        if nodes.is_empty() {
            return;
        }
        let body = self.bodies[0];
        let inner_ratio = step.times.kick / body.mass;
        let end_ratio = step.times.kick / body.end_mass;
        let mut behind = match nodes.start {
            0 => Lanes::all(0.0),
            first => self.springs[first - 1].axial_force,
        };
        // Told that no index is out of range, the compiler would take several nodes at once, lane by lane.
        for i in nodes {
            let ratio = if i == 0 { end_ratio } else { inner_ratio };
            let ahead = self.springs[i].axial_force;
            let velocity = self.nodes[i].velocity + (behind - ahead) * ratio;
            self.moves[i] = self.nodes[i].go_on(velocity, step);
            behind = ahead;
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
        self.kick_back(back, self.springs[back - 2].axial_force, step);
    }

    /// Kicks and moves nodes of the target that are like each other.
    #[inline(always)]
    fn kick_column(&mut self, inner: Range<usize>, step: &Step) {
        if inner.is_empty() {
            return;
        }
        let body = self.bodies[1];
        let mut sums = self.scalars.accumulated.friction;
        let ratio = step.times.kick / body.mass;
        let limit = body.friction * ratio;
        let mut behind = self.springs[inner.start - 2].axial_force;
        let springs = &self.springs[inner.start - 1..];
        let nodes = self.nodes[inner.clone()].iter_mut();
        let nodes = nodes.zip(&mut self.moves[inner]);
        for ((node, is_moving), spring) in nodes.zip(springs) {
            let ahead = spring.axial_force;
            let change = (behind - ahead) * ratio;
            behind = ahead;
            if !*is_moving && change.size().at_most(limit).every() {
                sums.impulse += body.mass * change;
                continue;
            }
            let before = node.velocity;
            let after = dry_friction(before, change, limit);
            sums.add(body.mass * (before + change - after), before, after);
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
        let behind = match i {
            0 => Lanes::all(0.0),
            _ => self.springs[i - 1 - body].axial_force,
        };
        let force = behind - self.springs[i - body].axial_force;
        let is_free = !LaneMask::of_bits(self.in_contact[i]);
        let (mass, before) = (self.masses[i], self.nodes[i].velocity);
        let ratio = step.times.kick / mass;
        let kicked = kick(mass, before, force, self.frictions[i], ratio);
        let lost = Lanes::select(is_free, kicked.lost, Lanes::all(0.0));
        self.scalars
            .accumulated
            .friction
            .add(lost, before, kicked.velocity);
        let stays = self.nodes[i];
        let node = &mut self.nodes[i];
        node.go_on(kicked.velocity, step);
        node.velocity = Lanes::select(is_free, node.velocity, stays.velocity);
        node.position = Lanes::select(is_free, node.position, stays.position);
        self.moves[i] = node.moves();
        self.kick_joints(i, step);
    }

    /// Kicks the back of the target.
    #[inline(always)]
    fn kick_back(&mut self, node: usize, force: Lanes, step: &Step) {
        let (mass, time) = (self.bodies[1].end_mass, step.times.kick);
        let sums = &mut self.scalars.accumulated;
        let velocity = &mut self.nodes[node].velocity;
        match self.mesh.back {
            Back::Fixed => {
                *velocity = Lanes::all(0.0);
                sums.support_impulse += force * time;
            }
            Back::Free => {
                let friction = self.bodies[1].last_friction;
                let kicked = kick(mass, *velocity, force, friction, time / mass);
                sums.friction.add(kicked.lost, *velocity, kicked.velocity);
                *velocity = kicked.velocity;
            }
            Back::Open => {
                let open = [self.scalars.impedance, Lanes::all(0.0)];
                (*velocity, _) = kick_open_end([mass, *velocity, force], open, time, sums);
            }
        }
    }

    #[inline(always)]
    pub(super) fn drift(&mut self, i: usize, step: &Step) {
        let node = &mut self.nodes[i];
        self.moves[i] = node.go_on(node.velocity, step);
    }
}

impl Node {
    /// Moves the node at a velocity for a step; says whether it moves in any lane.
    #[inline(always)]
    fn go_on(&mut self, velocity: Lanes, step: &Step) -> bool {
        self.velocity = velocity;
        self.position += velocity * step.length;
        self.moves()
    }

    #[inline(always)]
    fn moves(&self) -> bool {
        !self.velocity.equals(Lanes::all(0.0)).every()
    }
}
