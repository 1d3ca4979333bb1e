//! Contact of two ends: `State::kick_contact` and `State::close_contacts`, of tip and face in every lane at once.

use super::{bundle::Bundle, step::Step};
use crate::{
    chain::friction::dry_friction,
    lanes::{LANES, Lanes, larger},
};

/// Two ends at the start of a kick.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub(super) mass: [f64; 2],
    pub(super) velocity: [f64; 2],
    pub(super) force: [f64; 2],
    /// Largest friction on them.
    pub(super) friction: [f64; 2],
    pub(super) closed: bool,
}

/// What contact changes in the accumulated.
#[derive(Clone, Copy)]
pub(super) struct Account {
    pub(super) loss: f64,
    pub(super) work: f64,
    pub(super) impulse: f64,
}

/// Two ends after a kick.
pub(super) struct Kicked {
    pub(super) velocity: [f64; 2],
    pub(super) closed: bool,
    /// Force with which they push each other.
    pub(super) push: f64,
    pub(super) account: Account,
}

impl Pair {
    /// Kicks two ends, together where they touch and stay so; `drift` is the length of the step before. Whether friction acts on
    /// the first of them, too, is known beforehand.
    #[inline(always)]
    pub(super) fn kick<const BOTH_RUB: bool>(
        &self,
        kick: f64,
        drift: f64,
        account: Account,
    ) -> Kicked {
        let ([mass_a, mass_b], [before_a, before_b]) = (self.mass, self.velocity);
        let ([force_a, force_b], [friction_a, friction_b]) = (self.force, self.friction);
        // As one, from their common velocity.
        let mass = mass_a + mass_b;
        let common = (mass_a * before_a + mass_b * before_b) / mass;
        let lost = account.loss - jump_loss(mass_a, before_a, common, -drift, force_a);
        let lost = lost - jump_loss(mass_b, before_b, common, -drift, force_b);
        let change = (force_a + force_b) * kick / mass;
        let friction = if BOTH_RUB {
            friction_a + friction_b
        } else {
            friction_b
        };
        let together = dry_friction(common, change, friction * kick / mass);
        let mut on_a = force_a;
        if BOTH_RUB && friction != 0.0 {
            on_a += mass * (together - common - change) / kick * friction_a / friction;
        }
        let push = on_a - mass_a * (together - common) / kick;
        let stays = self.closed & (push >= 0.0);
        // Each by itself.
        let start_a = if self.closed { common } else { before_a };
        let start_b = if self.closed { common } else { before_b };
        let (mut alone_a, mut rubbed_a) = (start_a + force_a * (kick / mass_a), 0.0);
        if BOTH_RUB {
            let (ratio, free) = (kick / mass_a, alone_a);
            alone_a = dry_friction(start_a, force_a * ratio, friction_a * ratio);
            rubbed_a = mass_a * (free - alone_a);
        }
        let ratio = kick / mass_b;
        let change_b = force_b * ratio;
        let alone_b = dry_friction(start_b, change_b, friction_b * ratio);
        let (mut work, mut impulse) = (account.work, account.impulse);
        if BOTH_RUB && !stays {
            impulse += rubbed_a;
            work += rubbed_a * 0.5 * (start_a + alone_a);
        }
        let lost_impulse = if stays {
            mass * (common + change - together)
        } else {
            mass_b * (start_b + change_b - alone_b)
        };
        let mean = if stays {
            0.5 * (common + together)
        } else {
            0.5 * (start_b + alone_b)
        };
        Kicked {
            velocity: [
                if stays { together } else { alone_a },
                if stays { together } else { alone_b },
            ],
            closed: stays,
            push: if stays { push } else { 0.0 },
            account: Account {
                loss: if self.closed { lost } else { account.loss },
                work: work + lost_impulse * mean,
                impulse: impulse + lost_impulse,
            },
        }
    }

    /// Lets two ends across a gap meet in a step of some length: their velocities, and what is lost so far.
    pub(super) fn meet(&self, gap: f64, time_step: f64, loss: f64) -> ([f64; 2], f64) {
        let [mass_a, mass_b] = self.mass;
        let approach = self.velocity[0] - self.velocity[1];
        let change = approach - larger(gap, 0.0) / time_step;
        let mass = mass_a + mass_b;
        let jumps = [-(mass_b / mass) * change, mass_a / mass * change];
        let (mut velocity, mut lost) = (self.velocity, loss);
        for i in 0..2 {
            let after = velocity[i] + jumps[i];
            let of = (self.mass[i], velocity[i], after);
            lost -= jump_energy(of.0, of.1, of.2, time_step, self.force[i], jumps[i]);
            velocity[i] = after;
        }
        (velocity, lost)
    }
}

/// Whether two ends would overlap at the end of a step.
#[inline(always)]
pub(super) fn overlap(gap: f64, approach: f64, time_step: f64) -> bool {
    gap - approach * time_step <= 0.0
}

impl Bundle {
    /// Kicks tip and face, together where they touch and stay so.
    #[inline(always)]
    pub(super) fn kick_contact(&mut self, force_behind: Lanes, step: &Step) {
        let [projectile, _] = self.mesh.elements;
        let (a, b) = (projectile, projectile + 1);
        let force_a = force_behind.0;
        let ahead = self.springs[projectile].force.0;
        let (mass_a, mass_b) = (self.bodies[0].end_mass.0, self.bodies[1].end_mass.0);
        let friction = self.bodies[1].first_friction.0;
        let (before_a, before_b) = (self.nodes[a].velocity.0, self.nodes[b].velocity.0);
        let scalars = &mut self.scalars;
        let closed = scalars.closed.0;
        let loss = scalars.contact_loss.0;
        let work = scalars.friction_work.0;
        let impulse = scalars.friction_impulse.0;
        let (kick, drift) = (step.kick.0, step.before.0);
        let mut velocity_a = [0.0; LANES];
        let mut velocity_b = [0.0; LANES];
        let mut next_closed = [0.0; LANES];
        let mut next_loss = [0.0; LANES];
        let mut next_work = [0.0; LANES];
        let mut next_impulse = [0.0; LANES];
        let mut contact_force = [0.0; LANES];
        for l in 0..LANES {
            let pair = Pair {
                mass: [mass_a[l], mass_b[l]],
                velocity: [before_a[l], before_b[l]],
                force: [force_a[l], 0.0 - ahead[l]],
                friction: [0.0, friction[l]],
                closed: closed[l] > 0.0,
            };
            let account = Account {
                loss: loss[l],
                work: work[l],
                impulse: impulse[l],
            };
            let kicked = pair.kick::<false>(kick[l], drift[l], account);
            velocity_a[l] = kicked.velocity[0];
            velocity_b[l] = kicked.velocity[1];
            next_closed[l] = if kicked.closed { 1.0 } else { 0.0 };
            next_loss[l] = kicked.account.loss;
            next_work[l] = kicked.account.work;
            next_impulse[l] = kicked.account.impulse;
            contact_force[l] = kicked.push;
        }
        // Where other nodes than these meet, they do so by themselves.
        for l in (0..LANES).filter(|l| self.displaced >> l & 1 == 1) {
            velocity_a[l] = before_a[l];
            velocity_b[l] = before_b[l];
            next_closed[l] = closed[l];
            next_loss[l] = loss[l];
            next_work[l] = work[l];
            next_impulse[l] = impulse[l];
            contact_force[l] = 0.0;
        }
        scalars.closed = Lanes(next_closed);
        scalars.contact_loss = Lanes(next_loss);
        scalars.friction_work = Lanes(next_work);
        scalars.friction_impulse = Lanes(next_impulse);
        scalars.contact_force = Lanes(contact_force);
        self.nodes[a].velocity = Lanes(velocity_a);
        self.nodes[b].velocity = Lanes(velocity_b);
    }

    /// Lets tip and face meet where they would overlap at the end of the step.
    #[inline(always)]
    pub(super) fn close_contact(&mut self, step: &Step) {
        let projectile = self.mesh.elements[0];
        let [a, b] = [projectile, projectile + 1].map(|node| self.nodes[node]);
        let closed = self.scalars.closed.0;
        let mut meets = 0;
        for l in 0..LANES {
            let gap = b.position.0[l] - a.position.0[l];
            let approach = a.velocity.0[l] - b.velocity.0[l];
            let overlaps = overlap(gap, approach, step.length.0[l]);
            meets |= u8::from(overlaps & (closed[l] == 0.0)) << l;
        }
        meets &= !self.displaced;
        if meets != 0 {
            self.meet(meets, step);
        }
    }

    /// Lets tip and face of some lanes meet.
    #[cold]
    #[inline(never)]
    fn meet(&mut self, lanes: u8, step: &Step) {
        let projectile = self.mesh.elements[0];
        for l in (0..LANES).filter(|l| lanes >> l & 1 == 1) {
            let nodes = [projectile, projectile + 1];
            let [a, b] = nodes.map(|node| self.nodes[node].position.0[l]);
            let pair = self.pair(nodes, l, false);
            let lost = self.scalars.contact_loss.0[l];
            let (velocity, lost) = pair.meet(b - a, step.length.0[l], lost);
            for (node, velocity) in nodes.into_iter().zip(velocity) {
                self.nodes[node].velocity.0[l] = velocity;
            }
            self.scalars.contact_loss.0[l] = lost;
            self.scalars.closed.0[l] = 1.0;
            self.scalars.meetings.0[l] += 1.0;
        }
    }

    /// Two ends of a lane.
    #[inline(always)]
    pub(super) fn pair(&self, [a, b]: [usize; 2], lane: usize, closed: bool) -> Pair {
        let behind = &self.springs[a - 1 - self.body_of(a)];
        let ahead = &self.springs[b - self.body_of(b)];
        let of = |numbers: &[Lanes]| [numbers[a].0[lane], numbers[b].0[lane]];
        Pair {
            mass: of(&self.masses),
            velocity: [a, b].map(|node| self.nodes[node].velocity.0[lane]),
            force: [behind.force.0[lane], 0.0 - ahead.force.0[lane]],
            friction: of(&self.frictions),
            closed,
        }
    }

    /// Body of a node: the projectile (0) or the target (1).
    #[inline(always)]
    fn body_of(&self, node: usize) -> usize {
        usize::from(node > self.mesh.elements[0])
    }
}

/// What a sudden change of velocity before the kick takes: `State::account_for_jump`.
#[inline(always)]
fn jump_loss(mass: f64, before: f64, after: f64, drift: f64, force: f64) -> f64 {
    let jump = after - before;
    jump_energy(mass, before, before + jump, drift, force, jump)
}

#[inline(always)]
fn jump_energy(mass: f64, before: f64, after: f64, drift: f64, force: f64, jump: f64) -> f64 {
    0.5 * mass * (after * after - before * before) - 0.5 * drift * force * jump
}
