//! New velocities of projectile and target, and the way that their nodes go in a step.

use std::ops::Range;

use super::{
    bundle::{Back, Bundle, Node},
    step::Step,
};
use crate::{
    chain::friction::dry_friction,
    lanes::{LANES, Lanes},
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
        self.springs[tip - 1].force
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
            first => self.springs[first - 1].force,
        };
        // Told that no index is out of range, the compiler would take several nodes at once, lane by lane.
        for i in nodes {
            let ratio = if i == 0 { end_ratio } else { ratio };
            let force_ahead = self.springs[i].force;
            let node = &mut self.nodes[i];
            let (velocity, position) = (node.velocity.0, node.position.0);
            let mut next_velocity = [0.0; LANES];
            let mut next_position = [0.0; LANES];
            for l in 0..LANES {
                let change = (force_behind.0[l] - force_ahead.0[l]) * ratio[l];
                next_velocity[l] = velocity[l] + change;
                next_position[l] = position[l] + next_velocity[l] * step.length.0[l];
            }
            node.velocity = Lanes(next_velocity);
            node.position = Lanes(next_position);
            self.moves[i] = !is_still(node);
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
        self.kick_back(back, self.springs[back - 2].force, step);
    }

    /// Kicks and moves nodes of the target that are like each other.
    #[inline(always)]
    fn kick_column(&mut self, inner: Range<usize>, step: &Step) {
        if inner.is_empty() {
            return;
        }
        let body = self.bodies[1];
        let mut work = self.scalars.friction_work;
        let mut impulse = self.scalars.friction_impulse;
        let mut ratio = Lanes::all(0.0);
        let mut limit = Lanes::all(0.0);
        for l in 0..LANES {
            ratio.0[l] = step.kick.0[l] / body.mass.0[l];
            limit.0[l] = body.friction.0[l] * ratio.0[l];
        }
        let mut force_behind = self.springs[inner.start - 2].force;
        let springs = &self.springs[inner.start - 1..];
        let nodes = self.nodes[inner.clone()].iter_mut();
        let nodes = nodes.zip(&mut self.moves[inner]);
        for ((node, is_moving), spring) in nodes.zip(springs) {
            let force_ahead = spring.force;
            let mut change = [0.0; LANES];
            let mut is_held = true;
            for l in 0..LANES {
                change[l] = (force_behind.0[l] - force_ahead.0[l]) * ratio.0[l];
                is_held &= change[l].abs() <= limit.0[l];
            }
            force_behind = force_ahead;
            if is_held & !*is_moving {
                for l in 0..LANES {
                    impulse.0[l] += body.mass.0[l] * change[l];
                }
                continue;
            }
            let (velocity, position) = (node.velocity.0, node.position.0);
            let mut after = [0.0; LANES];
            let mut is_sliding = true;
            for l in 0..LANES {
                let sign = 1.0_f64.copysign(velocity[l]);
                after[l] = velocity[l] + change[l] - sign * limit.0[l];
                let loss = limit.0[l] - sign * change[l];
                let slides = (loss <= 0.0) | (velocity[l].abs() >= loss);
                is_sliding &= (slides & (velocity[l] != 0.0)) | (limit.0[l] == 0.0);
            }
            if !is_sliding {
                for l in 0..LANES {
                    after[l] = dry_friction(velocity[l], change[l], limit.0[l]);
                }
            }
            let mut next_position = [0.0; LANES];
            let mut moves = false;
            for l in 0..LANES {
                let lost_impulse = body.mass.0[l] * (velocity[l] + change[l] - after[l]);
                impulse.0[l] += lost_impulse;
                work.0[l] += lost_impulse * 0.5 * (velocity[l] + after[l]);
                next_position[l] = position[l] + after[l] * step.length.0[l];
                moves |= after[l] != 0.0;
            }
            node.velocity = Lanes(after);
            node.position = Lanes(next_position);
            *is_moving = moves;
        }
        self.scalars.friction_work = work;
        self.scalars.friction_impulse = impulse;
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
            _ => self.springs[i - 1 - body].force,
        };
        let ahead = self.springs[i - body].force;
        let in_contact = self.in_contact[i];
        let scalars = &mut self.scalars;
        let node = &mut self.nodes[i];
        let (velocity, position) = (node.velocity.0, node.position.0);
        let mut after = velocity;
        let mut next_position = position;
        for l in 0..LANES {
            let ratio = step.kick.0[l] / mass[l];
            let change = (behind.0[l] - ahead.0[l]) * ratio;
            let next = dry_friction(velocity[l], change, friction[l] * ratio);
            let lost_impulse = mass[l] * (velocity[l] + change - next);
            let is_free = in_contact >> l & 1 == 0;
            let lost_impulse = if is_free { lost_impulse } else { 0.0 };
            scalars.friction_impulse.0[l] += lost_impulse;
            scalars.friction_work.0[l] += lost_impulse * 0.5 * (velocity[l] + next);
            let moved = position[l] + next * step.length.0[l];
            after[l] = if is_free { next } else { velocity[l] };
            next_position[l] = if is_free { moved } else { position[l] };
        }
        node.velocity = Lanes(after);
        node.position = Lanes(next_position);
        self.moves[i] = !is_still(node);
        self.kick_joints(i, step);
    }

    /// Kicks the back of the target.
    #[inline(always)]
    fn kick_back(&mut self, node: usize, force: Lanes, step: &Step) {
        let body = self.bodies[1];
        let scalars = &mut self.scalars;
        let before = self.nodes[node].velocity.0;
        let mut velocity = [0.0; LANES];
        match self.mesh.back {
            Back::Fixed => {
                for l in 0..LANES {
                    scalars.support_impulse.0[l] += force.0[l] * step.kick.0[l];
                }
            }
            Back::Free => {
                for l in 0..LANES {
                    let ratio = step.kick.0[l] / body.end_mass.0[l];
                    let change = force.0[l] * ratio;
                    velocity[l] = dry_friction(before[l], change, body.last_friction.0[l] * ratio);
                    let lost_impulse = body.end_mass.0[l] * (before[l] + change - velocity[l]);
                    scalars.friction_impulse.0[l] += lost_impulse;
                    scalars.friction_work.0[l] += lost_impulse * 0.5 * (before[l] + velocity[l]);
                }
            }
            Back::Open => {
                for l in 0..LANES {
                    let kick = step.kick.0[l];
                    let half = 0.5 * scalars.impedance.0[l];
                    let inertia = body.end_mass.0[l] / kick;
                    velocity[l] = ((inertia - half) * before[l] + force.0[l]) / (inertia + half);
                    let mean = 0.5 * (before[l] + velocity[l]);
                    let back_force = scalars.impedance.0[l] * mean;
                    scalars.support_impulse.0[l] += back_force * kick;
                    scalars.boundary_work.0[l] += back_force * mean * kick;
                }
            }
        }
        self.nodes[node].velocity = Lanes(velocity);
    }

    #[inline(always)]
    pub(super) fn drift(&mut self, i: usize, step: &Step) {
        let node = &mut self.nodes[i];
        let (position, velocity) = (node.position.0, node.velocity.0);
        let mut next = [0.0; LANES];
        for l in 0..LANES {
            next[l] = position[l] + velocity[l] * step.length.0[l];
        }
        node.position = Lanes(next);
        self.moves[i] = !is_still(node);
    }
}

#[inline(always)]
fn is_still(node: &Node) -> bool {
    let velocity = node.velocity.0;
    let mut moves = false;
    for l in 0..LANES {
        moves |= velocity[l] != 0.0;
    }
    !moves
}
