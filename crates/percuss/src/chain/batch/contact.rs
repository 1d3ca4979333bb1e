//! Contact of tip and face: `State::kick_contact` and `State::close_gaps` in every lane.

use super::{
    bundle::Bundle,
    lanes::{LANES, Lanes, larger},
    step::Step,
};
use crate::chain::friction::rub;

impl Bundle {
    /// Kicks tip and face, together where they touch and stay so, and lets them meet where they would overlap.
    #[inline(always)]
    pub(super) fn kick_contact(&mut self, force_behind: Lanes, step: &Step) {
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
