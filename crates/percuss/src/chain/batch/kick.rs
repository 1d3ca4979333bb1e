//! New velocities of projectile and target, and the way that their nodes go in a step.

use super::{
    bundle::{Back, Bundle, Node},
    lanes::{LANES, Lanes},
    step::Step,
};
use crate::chain::friction::rub;

impl Bundle {
    /// Kicks and moves all of the projectile but its tip; returns the force on the tip.
    #[inline(always)]
    pub(super) fn kick_projectile(&mut self, step: &Step) -> Lanes {
        let body = self.bodies[0];
        let (mut ratio, mut end_ratio) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            ratio[l] = step.kick.0[l] / body.mass.0[l];
            end_ratio[l] = step.kick.0[l] / body.end_mass.0[l];
        }
        let mut force_behind = Lanes::all(0.0);
        // Told that no index is out of range, the compiler would take several nodes at once, lane by lane.
        for i in 0..self.mesh.elements[0] {
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
        force_behind
    }

    /// Kicks and moves the target behind its face, which has been kicked.
    #[inline(always)]
    pub(super) fn kick_target(&mut self, step: &Step) {
        let body = self.bodies[1];
        let count = self.mesh.elements[1];
        let first = self.mesh.elements[0];
        let face = first + 1;
        self.drift(face, step);
        let mut work = self.whole.friction_work;
        let mut impulse = self.whole.friction_impulse;
        let mut ratio = Lanes::all(0.0);
        let mut limit = Lanes::all(0.0);
        for l in 0..LANES {
            ratio.0[l] = step.kick.0[l] / body.mass.0[l];
            limit.0[l] = body.friction.0[l] * ratio.0[l];
        }
        let mut force_behind = self.springs[first].force;
        let inner = face + 1..face + count;
        let nodes = self.nodes[inner.clone()].iter_mut();
        let nodes = nodes.zip(&mut self.moves[inner]);
        for ((node, is_moving), spring) in nodes.zip(&self.springs[first + 1..]) {
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
                    after[l] = rub(velocity[l], change[l], limit.0[l]);
                }
            }
            let mut next_position = [0.0; LANES];
            let mut moves = false;
            for l in 0..LANES {
                let rubbed = body.mass.0[l] * (velocity[l] + change[l] - after[l]);
                impulse.0[l] += rubbed;
                work.0[l] += rubbed * 0.5 * (velocity[l] + after[l]);
                next_position[l] = position[l] + after[l] * step.length.0[l];
                moves |= after[l] != 0.0;
            }
            node.velocity = Lanes(after);
            node.position = Lanes(next_position);
            *is_moving = moves;
        }
        self.whole.friction_work = work;
        self.whole.friction_impulse = impulse;
        self.kick_back(face + count, force_behind, step);
        self.drift(face + count, step);
    }

    /// Kicks the back of the target.
    #[inline(always)]
    fn kick_back(&mut self, node: usize, force: Lanes, step: &Step) {
        let body = self.bodies[1];
        let whole = &mut self.whole;
        let before = self.nodes[node].velocity.0;
        let mut velocity = [0.0; LANES];
        match self.mesh.back {
            Back::Fixed => {
                for l in 0..LANES {
                    whole.support_impulse.0[l] += force.0[l] * step.kick.0[l];
                }
            }
            Back::Free => {
                for l in 0..LANES {
                    let ratio = step.kick.0[l] / body.end_mass.0[l];
                    let change = force.0[l] * ratio;
                    velocity[l] = rub(before[l], change, body.last_friction.0[l] * ratio);
                    let rubbed = body.end_mass.0[l] * (before[l] + change - velocity[l]);
                    whole.friction_impulse.0[l] += rubbed;
                    whole.friction_work.0[l] += rubbed * 0.5 * (before[l] + velocity[l]);
                }
            }
            Back::Open => {
                for l in 0..LANES {
                    let kick = step.kick.0[l];
                    let half = 0.5 * whole.impedance.0[l];
                    let inertia = body.end_mass.0[l] / kick;
                    velocity[l] = ((inertia - half) * before[l] + force.0[l]) / (inertia + half);
                    let mean = 0.5 * (before[l] + velocity[l]);
                    let back_force = whole.impedance.0[l] * mean;
                    whole.support_impulse.0[l] += back_force * kick;
                    whole.boundary_work.0[l] += back_force * mean * kick;
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
