//! One step of every lane: `State::advance` and `Watch::follow` of a column, in the same order.

use super::{
    bundle::{Back, Bundle, Node},
    lanes::{LANES, Lanes, larger, smaller},
    spring::{Pass, SET_LANES, flow},
};
use crate::chain::{
    friction::rub,
    solver::{LARGEST_STRAIN_STEP, choose_time_step},
};

/// What a step has for every lane besides the state.
#[derive(Clone, Copy)]
struct Step {
    /// Length of the step before, of this one, and of the kick between them.
    before: Lanes,
    length: Lanes,
    kick: Lanes,
    /// Inverse of its length.
    rate: Lanes,
}

/// What a step finds out about the elements of every lane.
struct Found {
    stable_step: Lanes,
    fastest: Lanes,
    /// Length that the shortest element, and the longest one, have left until they erode.
    spare: Lanes,
}

impl Found {
    const START: Self = Self {
        stable_step: Lanes::all(f64::INFINITY),
        fastest: Lanes::all(0.0),
        spare: Lanes::all(f64::INFINITY),
    };
}

impl Bundle {
    /// Takes steps until a lane calls for the single run or none are left; says which ones do.
    #[inline(always)]
    pub(super) fn advance(&mut self, left: &mut u64) -> [bool; LANES] {
        while *left > 0 {
            *left -= 1;
            let calls = self.step(*left == 0);
            if calls.iter().any(|&calls| calls) {
                return calls;
            }
        }
        [false; LANES]
    }

    #[inline(always)]
    fn step(&mut self, is_last: bool) -> [bool; LANES] {
        let step = self.begin();
        let force_behind = self.kick_projectile(&step);
        self.kick_contact(force_behind, &step);
        self.drift(self.mesh.elements[0], &step);
        self.kick_target(&step);
        let found = self.update(&step);
        self.now = 1 - self.now;
        self.end(&step, &found, is_last)
    }

    /// Chooses the time steps.
    #[inline(always)]
    fn begin(&self) -> Step {
        let (before, stable, courant) = (
            self.whole.time_step.0,
            self.whole.stable_step.0,
            self.whole.courant.0,
        );
        let mut length = [0.0; LANES];
        let mut kick = [0.0; LANES];
        let mut rate = [0.0; LANES];
        for l in 0..LANES {
            length[l] = choose_time_step(before[l], courant[l] * stable[l]);
            kick[l] = 0.5 * (before[l] + length[l]);
            rate[l] = 1.0 / length[l];
        }
        Step {
            before: Lanes(before),
            length: Lanes(length),
            kick: Lanes(kick),
            rate: Lanes(rate),
        }
    }

    /// Kicks and moves all of the projectile but its tip; returns the force on the tip.
    #[inline(always)]
    fn kick_projectile(&mut self, step: &Step) -> Lanes {
        let body = self.bodies[0];
        let (mut ratio, mut end_ratio) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            ratio[l] = step.kick.0[l] / body.mass.0[l];
            end_ratio[l] = step.kick.0[l] / body.end_mass.0[l];
        }
        let mut force_behind = Lanes::all(0.0);
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

    /// Kicks tip and face, together where they touch and stay so, and lets them meet where they would overlap.
    #[inline(always)]
    fn kick_contact(&mut self, force_behind: Lanes, step: &Step) {
        let [projectile, _] = self.mesh.elements;
        let (a, b) = (projectile, projectile + 1);
        let force_a = force_behind.0;
        let ahead = self.springs[projectile].force.0;
        let (mass_a, mass_b) = (self.bodies[0].end_mass.0, self.bodies[1].end_mass.0);
        let friction = self.bodies[1].first_friction.0;
        let (before_a, before_b) = (self.nodes[a].velocity.0, self.nodes[b].velocity.0);
        let closed = self.whole.closed.0;
        let loss = self.whole.contact_loss.0;
        let work = self.whole.friction_work.0;
        let impulse = self.whole.friction_impulse.0;
        let (kick, drift) = (step.kick.0, step.before.0);
        let mut velocity_a = [0.0; LANES];
        let mut velocity_b = [0.0; LANES];
        let mut next_closed = [0.0; LANES];
        let mut next_loss = [0.0; LANES];
        let mut next_work = [0.0; LANES];
        let mut next_impulse = [0.0; LANES];
        let mut contact_force = [0.0; LANES];
        for l in 0..LANES {
            let force_b = 0.0 - ahead[l];
            let touches = closed[l] > 0.0;
            // As one, from their common velocity.
            let mass = mass_a[l] + mass_b[l];
            let common = (mass_a[l] * before_a[l] + mass_b[l] * before_b[l]) / mass;
            let jumps = jump_loss(mass_a[l], before_a[l], common, -drift[l], force_a[l]);
            let lost = loss[l] - jumps;
            let lost = lost - jump_loss(mass_b[l], before_b[l], common, -drift[l], force_b);
            let change = (force_a[l] + force_b) * kick[l] / mass;
            let together = rub(common, change, friction[l] * kick[l] / mass);
            let push = force_a[l] - mass_a[l] * (together - common) / kick[l];
            let stays = touches & (push >= 0.0);
            // Each by itself.
            let start_a = if touches { common } else { before_a[l] };
            let start_b = if touches { common } else { before_b[l] };
            let alone_a = start_a + force_a[l] * (kick[l] / mass_a[l]);
            let ratio = kick[l] / mass_b[l];
            let change_b = force_b * ratio;
            let alone_b = rub(start_b, change_b, friction[l] * ratio);
            let rubbed = if stays {
                mass * (common + change - together)
            } else {
                mass_b[l] * (start_b + change_b - alone_b)
            };
            let mean = if stays {
                0.5 * (common + together)
            } else {
                0.5 * (start_b + alone_b)
            };
            velocity_a[l] = if stays { together } else { alone_a };
            velocity_b[l] = if stays { together } else { alone_b };
            next_closed[l] = if stays { 1.0 } else { 0.0 };
            next_loss[l] = if touches { lost } else { loss[l] };
            next_impulse[l] = impulse[l] + rubbed;
            next_work[l] = work[l] + rubbed * mean;
            contact_force[l] = if stays { push } else { 0.0 };
        }
        // What would overlap at the end of the step meets.
        let (position_a, position_b) = (self.nodes[a].position.0, self.nodes[b].position.0);
        let mut meets = [0.0; LANES];
        let mut any_meets = false;
        for l in 0..LANES {
            let gap = position_b[l] - position_a[l];
            let approach = velocity_a[l] - velocity_b[l];
            let overlaps = gap - approach * step.length.0[l] <= 0.0;
            let meets_here = overlaps & (next_closed[l] == 0.0);
            meets[l] = if meets_here { 1.0 } else { 0.0 };
            any_meets |= meets_here;
        }
        if any_meets {
            for l in 0..LANES {
                if meets[l] == 0.0 {
                    continue;
                }
                let time_step = step.length.0[l];
                let gap = position_b[l] - position_a[l];
                let approach = velocity_a[l] - velocity_b[l];
                let change = approach - larger(gap, 0.0) / time_step;
                let mass = mass_a[l] + mass_b[l];
                let jump_a = -(mass_b[l] / mass) * change;
                let jump_b = mass_a[l] / mass * change;
                for (mass, velocity, jump, force) in [
                    (mass_a[l], &mut velocity_a[l], jump_a, force_a[l]),
                    (mass_b[l], &mut velocity_b[l], jump_b, 0.0 - ahead[l]),
                ] {
                    let after = *velocity + jump;
                    next_loss[l] -= booked(mass, *velocity, after, time_step, force, jump);
                    *velocity = after;
                }
                next_closed[l] = 1.0;
                self.whole.meetings.0[l] += 1.0;
            }
        }
        self.nodes[a].velocity = Lanes(velocity_a);
        self.nodes[b].velocity = Lanes(velocity_b);
        self.whole.closed = Lanes(next_closed);
        self.whole.contact_loss = Lanes(next_loss);
        self.whole.friction_work = Lanes(next_work);
        self.whole.friction_impulse = Lanes(next_impulse);
        self.whole.contact_force = Lanes(contact_force);
    }

    /// Kicks and moves the target behind its face, which has been kicked.
    #[inline(always)]
    fn kick_target(&mut self, step: &Step) {
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
        for j in 1..count {
            let spring = first + j;
            let force_ahead = self.springs[spring].force;
            let node = &mut self.nodes[face + j];
            let mut change = [0.0; LANES];
            let mut is_held = true;
            for l in 0..LANES {
                change[l] = (force_behind.0[l] - force_ahead.0[l]) * ratio.0[l];
                is_held &= change[l].abs() <= limit.0[l];
            }
            force_behind = force_ahead;
            if is_held & !self.moves[face + j] {
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
            self.moves[face + j] = moves;
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
    fn drift(&mut self, i: usize, step: &Step) {
        let node = &mut self.nodes[i];
        let (position, velocity) = (node.position.0, node.velocity.0);
        let mut next = [0.0; LANES];
        for l in 0..LANES {
            next[l] = position[l] + velocity[l] * step.length.0[l];
        }
        node.position = Lanes(next);
        self.moves[i] = !is_still(node);
    }

    /// Updates the elements: first all of them as if elastic, then those that flow. Nothing has to be guessed that way.
    #[inline(always)]
    fn update(&mut self, step: &Step) -> Found {
        let mut found = Found::START;
        let [projectile, target] = self.mesh.elements;
        let now = self.now;
        for (b, elements) in [0..projectile, projectile..projectile + target]
            .into_iter()
            .enumerate()
        {
            let body = self.bodies[b];
            let mut pass = Pass::START;
            let (mut active, mut working, mut flowing) = (0, 0, 0);
            for e in elements {
                // Where no wave has come, or border shear holds, nothing changes.
                let changes = self.moves[e + b] | self.moves[e + b + 1] | !self.settled[e];
                self.active[active] = e;
                active += usize::from(changes);
                if !changes {
                    let ends = [&self.nodes[e + b], &self.nodes[e + b + 1]];
                    self.springs[e].rest(ends, &body, now, &mut pass);
                }
            }
            for &e in &self.active[..active] {
                let ends = [&self.nodes[e + b], &self.nodes[e + b + 1]];
                let response = self.springs[e].respond(ends, &body, now, &mut pass);
                let flows = response.flows != 0;
                let works = flows | self.flowed[e];
                self.settled[e] = !(response.changes | works);
                self.flowed[e] = flows;
                self.working[working] = e;
                working += usize::from(works);
                let lanes = SET_LANES[usize::from(response.flows)];
                let places = lanes.map(|lane| (e as u32, lane));
                self.flowing[flowing..flowing + LANES].copy_from_slice(&places);
                flowing += response.flows.count_ones() as usize;
            }
            for &e in &self.working[..working] {
                self.flows[e].step_before = self.flows[e].plastic_step;
                self.flows[e].plastic_step = Lanes::all(0.0);
            }
            let chain = (&mut self.springs[..], &mut self.flows[..], &self.nodes[b..]);
            flow(&mut self.flowing, flowing, chain, &body, &step.rate, now);
            let mut work = Lanes::all(0.0);
            for &e in &self.working[..working] {
                let ends = [&self.nodes[e + b], &self.nodes[e + b + 1]];
                let flow = &self.flows[e];
                self.springs[e].settle(flow, ends, &body, now, &mut work, &mut pass);
            }
            for l in 0..LANES {
                self.whole.plastic_work[b].0[l] += work.0[l];
                let spare = smaller(
                    pass.shortest.0[l] - body.shortest.0[l],
                    body.longest.0[l] - pass.longest.0[l],
                );
                found.spare.0[l] = smaller(spare, found.spare.0[l]);
                found.stable_step.0[l] = smaller(pass.stable_step.0[l], found.stable_step.0[l]);
                found.fastest.0[l] = larger(pass.fastest.0[l], found.fastest.0[l]);
            }
        }
        found
    }

    /// Ends the step and finds the lanes that the single run has to look at.
    #[inline(always)]
    fn end(&mut self, step: &Step, found: &Found, is_last: bool) -> [bool; LANES] {
        let [projectile, target] = self.mesh.elements;
        let face = self.nodes[projectile + 1].position.0;
        let back = self.nodes[projectile + 1 + target].position.0;
        let tail = self.nodes[0].velocity.0;
        let is_open = self.mesh.back == Back::Open;
        let whole = &mut self.whole;
        let mut depth = [0.0; LANES];
        let mut calls = [false; LANES];
        let mut may_rest = false;
        for l in 0..LANES {
            whole.time_step.0[l] = step.length.0[l];
            whole.time.0[l] += step.length.0[l];
            whole.step.0[l] += 1.0;
            let of_approach = LARGEST_STRAIN_STEP / found.fastest.0[l];
            whole.stable_step.0[l] = smaller(of_approach, found.stable_step.0[l]);
            let drift = back[l] - whole.back_position.0[l];
            depth[l] = if is_open { face[l] - drift } else { face[l] };
            calls[l] = is_last
                | (found.spare.0[l] <= 0.0)
                | (depth[l] >= whole.perforated.0[l])
                | (whole.time.0[l] >= whole.next_look.0[l])
                | (whole.step.0[l] >= whole.most_steps.0[l]);
            may_rest |= tail[l] < whole.slow_tail.0[l];
        }
        if may_rest {
            let momentum = self.projectile_momentum();
            for l in 0..LANES {
                calls[l] |= (tail[l] < self.whole.slow_tail.0[l]) & (momentum.0[l] <= 0.0);
            }
        }
        let whole = &mut self.whole;
        for l in 0..LANES {
            if calls[l] {
                continue;
            }
            whole.largest_depth.0[l] = larger(depth[l], whole.largest_depth.0[l]);
            whole.peak_force.0[l] = larger(whole.contact_force.0[l], whole.peak_force.0[l]);
            whole.smallest_time_step.0[l] =
                smaller(whole.time_step.0[l], whole.smallest_time_step.0[l]);
            if whole.closed.0[l] > 0.0 {
                whole.contact_time.0[l] += whole.time_step.0[l];
                whole.touched.0[l] = 1.0;
            }
        }
        calls
    }

    /// Momentum of the projectile.
    #[inline(always)]
    fn projectile_momentum(&self) -> Lanes {
        let count = self.mesh.elements[0];
        let body = &self.bodies[0];
        let mut sum = Lanes::all(0.0);
        for (i, node) in self.nodes[..=count].iter().enumerate() {
            let mass = if i == 0 || i == count {
                body.end_mass
            } else {
                body.mass
            };
            let velocity = node.velocity;
            for l in 0..LANES {
                sum.0[l] += mass.0[l] * velocity.0[l];
            }
        }
        sum
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

/// What a sudden change of velocity before the kick takes: `State::book_jump`.
#[inline(always)]
fn jump_loss(mass: f64, before: f64, after: f64, drift: f64, force: f64) -> f64 {
    let jump = after - before;
    booked(mass, before, before + jump, drift, force, jump)
}

#[inline(always)]
fn booked(mass: f64, before: f64, after: f64, drift: f64, force: f64, jump: f64) -> f64 {
    0.5 * mass * (after * after - before * before) - 0.5 * drift * force * jump
}
