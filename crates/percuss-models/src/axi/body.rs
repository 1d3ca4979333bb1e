//! A body: its law, its particles in chunks, and its nodes.

use super::{
    block::{Block, Members},
    deform::Work,
    field::{Field, Strip},
    kernel::first_node,
    law::Law,
    transfer::Deposit,
};
use crate::{lanes::LANES, solver::Particle};

/// Particles that one task takes. It does not depend on the number of threads, so sums come out the same on any.
pub(super) const CHUNK: usize = 2048;

/// A body with a velocity field of its own.
#[derive(Debug)]
pub(super) struct Body {
    pub(super) law: Law,
    pub(super) particles: Vec<Particle>,
    pub(super) strips: Vec<Strip>,
    pub(super) field: Field,
    /// Rows of all strips together when the particles were last put in order.
    pub(super) rows_in_order: usize,
}

/// What all particles of a step have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pass {
    pub(super) time_step: f64,
    pub(super) cell: f64,
    /// Radius and range of depth beyond which particles are given up [m].
    pub(super) limits: Limits,
}

/// Where particles are followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    pub(super) radius: f64,
    pub(super) back: f64,
    pub(super) front: f64,
}

/// What the steps of a chunk did, summed up [J].
#[derive(Debug, Clone, Copy, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct WorkSums {
    pub(super) total: f64,
    pub(super) plastic: f64,
    pub(super) viscous: f64,
    pub(super) failure: f64,
    /// Power of the stress at the start and at the end of the step, both on the strain rate of the step [W].
    pub(super) power_at_start: f64,
    pub(super) power_at_end: f64,
}

/// Sums over a chunk after a step.
#[derive(Debug, Clone, Copy, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Sums {
    /// Mass [kg], axial momentum [N s] and kinetic energy [J].
    pub(super) mass: f64,
    pub(super) momentum: f64,
    pub(super) kinetic: f64,
    /// Work of the step [J].
    pub(super) work: WorkSums,
    /// What left the body in the step: particles, their axial momentum and kinetic energy.
    pub(super) lost: (usize, f64, f64),
    /// Largest square of a wave speed and of a particle's speed [m2/s2].
    pub(super) wave_squared: f64,
    pub(super) speed_squared: f64,
    /// Whether a number ceased to be one.
    pub(super) broken: bool,
}

impl Sums {
    pub(super) fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        self.momentum += other.momentum;
        self.kinetic += other.kinetic;
        self.work.power_at_start += other.work.power_at_start;
        self.work.power_at_end += other.work.power_at_end;
        self.work.total += other.work.total;
        self.work.plastic += other.work.plastic;
        self.work.viscous += other.work.viscous;
        self.work.failure += other.work.failure;
        self.lost.0 += other.lost.0;
        self.lost.1 += other.lost.1;
        self.lost.2 += other.lost.2;
        self.wave_squared = self.wave_squared.max(other.wave_squared);
        self.speed_squared = self.speed_squared.max(other.speed_squared);
        self.broken |= other.broken;
    }
}

impl Body {
    pub(super) fn new(law: Law, particles: Vec<Particle>) -> Self {
        let chunks = particles.len().div_ceil(CHUNK);
        Self {
            law,
            particles,
            strips: (0..chunks).map(|_| Strip::default()).collect(),
            field: Field::default(),
            rows_in_order: 0,
        }
    }

    /// Puts particles in the order of their cells, row by row, and drops those that have left.
    pub(super) fn put_in_order(&mut self, cell: f64) {
        let per_cell = 1.0 / cell;
        self.particles.retain(|particle| particle.mass > 0.0);
        self.particles.sort_by_cached_key(|particle| {
            let [radius, depth] = particle.position.map(|x| (x * per_cell).floor() as i64);
            (depth, radius)
        });
        let chunks = self.particles.len().div_ceil(CHUNK);
        self.strips.resize_with(chunks, Strip::default);
        self.rows_in_order = 0;
    }

    /// Whether the chunks have spread so far that putting them in order pays.
    pub(super) fn is_spread(&mut self) -> bool {
        let rows: usize = self.strips.iter().map(|strip| strip.rows).sum();
        if self.rows_in_order == 0 {
            self.rows_in_order = rows;
        }
        rows > self.rows_in_order + self.rows_in_order / 3 + self.strips.len()
    }
}

/// Moves and deforms the particles of a chunk; `time_step` 0 leaves them as they are. Then adds them to the chunk's nodes.
///
/// Compiled for each width of vectors and chosen when it runs. Nothing is fused or summed in another order, so every processor
/// comes to the same bits.
pub(super) fn advance(
    particles: &mut [Particle],
    law: &Law,
    field: &Field,
    strip: &mut Strip,
    pass: &Pass,
) -> Sums {
    pulp::Arch::new().dispatch(Advance {
        particles,
        law,
        field,
        strip,
        pass,
    })
}

struct Advance<'a> {
    particles: &'a mut [Particle],
    law: &'a Law,
    field: &'a Field,
    strip: &'a mut Strip,
    pass: &'a Pass,
}

impl pulp::NullaryFnOnce for Advance<'_> {
    type Output = Sums;

    #[inline(always)]
    fn call(self) -> Sums {
        advance_here(self.particles, self.law, self.field, self.strip, self.pass)
    }
}

#[inline(always)]
fn advance_here(
    particles: &mut [Particle],
    law: &Law,
    field: &Field,
    strip: &mut Strip,
    pass: &Pass,
) -> Sums {
    let per_cell = 1.0 / pass.cell;
    let mut sums = Sums::default();
    let (mut least, mut most, mut widest) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
    let mut from = 0;
    while let Some(members) = Members::next(particles, &mut from) {
        let mut block = Block::of(particles, &members);
        // Not in a closure: what is in one is compiled without the wide instructions.
        let mut work = Work::NONE;
        if pass.time_step > 0.0 {
            block.gather(per_cell, field);
            let hoop_rate = block.hoop_rate(law);
            block.travel(pass.time_step);
            work = law.deform(
                particles,
                &members,
                &mut block,
                hoop_rate,
                pass.time_step,
                pass.cell,
            );
        } else {
            block.keep_motion(particles, &members);
        }
        let kinetic = block.kinetic_energy(pass.cell);
        let wave_squared = law.wave_speed_squared(&block);
        for (l, place) in members.iter() {
            sums.work.total += work.total[l];
            sums.work.plastic += work.plastic[l];
            sums.work.viscous += work.viscous[l];
            sums.work.failure += work.failure[l];
            sums.work.power_at_start += work.power_at_start[l];
            let particle = &mut particles[place];
            let [radius, depth] = particle.position;
            // A comparison with what is no number fails, so this finds those too.
            if !(kinetic[l] + particle.pressure + depth + radius).is_finite() {
                sums.broken = true;
                particle.mass = 0.0;
                continue;
            }
            let limits = &pass.limits;
            let is_beyond = radius > limits.radius || depth < limits.back || depth > limits.front;
            if is_beyond || law.erodes(particle) {
                sums.lost.0 += 1;
                sums.lost.1 += particle.mass * particle.velocity[1];
                sums.lost.2 += kinetic[l];
                sums.work.failure += law.elastic_energy(particle);
                particle.mass = 0.0;
                continue;
            }
            sums.work.power_at_end += work.power_at_end[l];
            least = least.min(depth);
            most = most.max(depth);
            widest = widest.max(radius);
            let [v_r, v_z] = particle.velocity;
            sums.mass += particle.mass;
            sums.momentum += particle.mass * v_z;
            sums.kinetic += kinetic[l];
            sums.speed_squared = sums.speed_squared.max(v_r * v_r + v_z * v_z);
            sums.wave_squared = sums.wave_squared.max(wave_squared[l]);
        }
    }
    if least > most {
        strip.open(0, 0, 0);
        return sums;
    }
    let row = |depth: f64| first_node(depth * per_cell);
    let columns = first_node(widest * per_cell) + 4;
    strip.open(
        row(least),
        (row(most) + 3 - row(least)) as usize,
        columns as usize,
    );
    // All of a block by way of memory: so a node's numbers stay side by side.
    let mut deposits = [Deposit::default(); LANES];
    let mut from = 0;
    while let Some(members) = Members::next(particles, &mut from) {
        for (l, place) in members.iter() {
            deposits[l] = Deposit::of(&particles[place], per_cell, law.axisymmetric);
        }
        for deposit in &deposits[..members.count()] {
            deposit.add_to(strip);
        }
    }
    sums
}
