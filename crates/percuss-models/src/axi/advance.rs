//! Step of the particles of a chunk: nodes to particles and constitutive update.
//!
//! The rate of volume and the pressure are means over the particles of a group, which have been in one cell: with a rate of volume of its
//! own in each of four particles of a cell, plastic flow, which keeps the volume, would have too few ways to go \[hughes1980\]. Both means
//! are weighted with volumes, so the power of the nodal forces stays that of the stresses. Nodes do not see what the pressures of a group
//! differ by, so that would drift as groups change: it decays as the material deforms.

use super::{
    block::Block,
    body::{Chunk, Pass, Sums, Task},
    deform::Work,
    field::Field,
    law::Law,
    mesh::{Places, cell_lengths},
    rates::Rates,
};
use crate::lanes::{LANES, Lanes, lanes, settled};

/// Moves and deforms the particles of a chunk; a time step of 0 leaves them as they are.
///
/// Compiled for each width of vectors and chosen when it runs. Nothing is fused or summed in another order, so every processor
/// comes to the same bits.
pub(super) fn advance(task: &mut Task<'_>, pass: &Pass) -> Sums {
    pulp::Arch::new().dispatch(Advance { task, pass })
}

struct Advance<'a, 'b> {
    task: &'a mut Task<'b>,
    pass: &'a Pass,
}

impl pulp::NullaryFnOnce for Advance<'_, '_> {
    type Output = Sums;

    #[inline(always)]
    fn call(self) -> Sums {
        let Self { task, pass } = self;
        let Task {
            blocks,
            chunk,
            law,
            field,
        } = task;
        let Chunk {
            group_ends,
            scratch,
            ..
        } = &mut **chunk;
        scratch.start(blocks.len());
        for (number, block) in blocks.iter_mut().enumerate() {
            let moving = moved(block, law, field, pass);
            scratch.note(number, block, &moving.rates);
            scratch.moving.push(moving);
        }
        let Scratch { moving, shares, .. } = scratch;
        share_means(shares, group_ends);
        let mut sums = Sums::default();
        for (number, (block, moving)) in blocks.iter_mut().zip(moving).enumerate() {
            let Moving { rates, places } = moving;
            let mut work = Work::NONE;
            if pass.time_step > 0.0 {
                let [expansion, pressure, shear] = means(
                    shares,
                    number,
                    block,
                    [rates.expansion, block.pressure, NONE],
                );
                rates.expansion = expansion;
                rates.relax(block, &pressure, &shear, law, pass.time_step);
                let lengths = cell_lengths(pass.mesh.cell, places);
                work = law.deform(block, rates, pass.time_step, &lengths);
            }
            add_up(block, places, &work, law, pass, &mut sums);
        }
        sums
    }
}

/// What passes from one part of the work on a chunk to the next.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    moving: Vec<Moving>,
    /// What means of groups are made of, then the means: volumes, or 0 where a particle has failed or left, and times these the rates
    /// of volume, pressures and rates of shear.
    shares: Vec<[f64; 4]>,
    /// The same for the pressures that nodes get.
    pub(super) pressures: Vec<[f64; 2]>,
}

const NONE: Lanes = Lanes::all(0.0);

impl Scratch {
    /// Makes room for a number of blocks.
    #[inline(always)]
    fn start(&mut self, blocks: usize) {
        self.moving.clear();
        self.moving.reserve(blocks);
        self.shares.resize(blocks * LANES, [0.0; 4]);
    }

    /// Notes what means are to be made of.
    #[inline(always)]
    fn note(&mut self, number: usize, block: &Block, rates: &Rates) {
        let shear = rates.shear();
        note(
            &mut self.shares,
            number,
            block,
            [&rates.expansion, &block.pressure, &shear],
        );
    }
}

/// Notes weights and weighted values of a block.
#[inline(always)]
pub(super) fn note<const N: usize, const M: usize>(
    shares: &mut [[f64; N]],
    number: usize,
    block: &Block,
    values: [&Lanes; M],
) {
    let weight = settled(block.weights());
    let mass = block.mass;
    let mut weighted = [NONE; M];
    for (weighted, values) in weighted.iter_mut().zip(values) {
        let values = *values;
        // What has left may be no number any more.
        *weighted = lanes(|l| weight[l] * if mass[l] > 0.0 { values[l] } else { 0.0 });
    }
    let weighted = settled(weighted);
    let shares = &mut shares[number * LANES..][..LANES];
    for (l, share) in shares.iter_mut().enumerate() {
        share[0] = weight[l];
        for (entry, values) in share[1..].iter_mut().zip(&weighted) {
            *entry = values[l];
        }
    }
}

/// Means of the groups for the particles of a block that share them, and the own values of the others.
#[inline(always)]
pub(super) fn means<const N: usize, const M: usize>(
    shares: &[[f64; N]],
    number: usize,
    block: &Block,
    own: [Lanes; M],
) -> [Lanes; M] {
    let shares = &shares[number * LANES..][..LANES];
    let (weight, lone) = (block.weights(), block.lone);
    let total = settled(lanes(|l| shares[l][0]));
    let mut means = own;
    for (k, means) in means.iter_mut().enumerate() {
        let (mean, own) = (settled(lanes(|l| shares[l][k + 1])), *means);
        *means = lanes(|l| {
            let is_shared = (weight[l] > 0.0) & (lone[l] == 0.0) & (total[l] > 0.0);
            if is_shared { mean[l] } else { own[l] }
        });
    }
    means
}

/// How particles move that are yet to be deformed.
#[derive(Debug, Clone, Copy)]
struct Moving {
    rates: Rates,
    places: Places,
}

/// Moves a block with the nodes.
#[inline(always)]
fn moved(block: &mut Block, law: &Law, field: &Field, pass: &Pass) -> Moving {
    let mut places = pass.mesh.places(&block.position);
    let mut rates = Rates::NONE;
    if pass.time_step > 0.0 {
        let drawn = block.gather(&places, pass.mesh.cell, field);
        let hoop_rate = block.hoop_rate(&drawn, law);
        block.travel(&drawn, pass.time_step);
        rates = Rates::of(&drawn.rate, hoop_rate, pass.time_step);
        places = pass.mesh.places(&block.position);
    }
    Moving { rates, places }
}

/// Replaces what means are made of by the means, in groups of more than one particle.
#[inline(always)]
pub(super) fn share_means<const N: usize>(shares: &mut [[f64; N]], group_ends: &[usize]) {
    let mut from = 0;
    for &to in group_ends {
        if to - from > 1 {
            let own = &mut shares[from..to];
            let mut sums = [0.0; N];
            for share in &*own {
                for (sum, entry) in sums.iter_mut().zip(share) {
                    *sum += entry;
                }
            }
            let weight = sums[0];
            for sum in &mut sums[1..] {
                *sum /= weight;
            }
            own.fill(sums);
        }
        from = to;
    }
}

/// Takes out the particles of a block that have left the body, and adds the others up.
#[inline(always)]
fn add_up(
    block: &mut Block,
    places: &Places,
    work: &Work,
    law: &Law,
    pass: &Pass,
    sums: &mut Sums,
) {
    let kinetic = block.kinetic_energy(places, pass.mesh.cell);
    let wave_squared = law.wave_speed_squared(block);
    let [radius, depth] = block.position;
    let Block {
        mass,
        pressure,
        damage,
        plastic_strain,
        velocity: [v_r, v_z],
        ..
    } = *block;
    let (limits, [most_damage, most_strain]) = (pass.limits, law.erosion());
    let stays = settled(lanes(|l| {
        // A comparison with what is no number fails, so this finds those too.
        let is_finite = (kinetic[l] + pressure[l] + depth[l] + radius[l]).abs() < f64::INFINITY;
        let is_inside =
            (radius[l] <= limits.radius) & (depth[l] >= limits.back) & (depth[l] <= limits.front);
        let erodes = (damage[l] >= most_damage) | (plastic_strain[l] >= most_strain);
        let stays = is_finite & is_inside & !erodes;
        if stays { 1.0 } else { 0.0 }
    }));
    let was = |values: Lanes| lanes(|l| if mass[l] > 0.0 { values[l] } else { 0.0 });
    let stayed = |values: Lanes| {
        lanes(|l| {
            let stayed = (mass[l] > 0.0) & (stays[l] > 0.0);
            if stayed { values[l] } else { 0.0 }
        })
    };
    let done = [
        was(work.total),
        was(work.plastic),
        was(work.viscous),
        was(work.failure),
        was(work.power_at_start),
    ];
    let kept = [
        stayed(work.power_at_end),
        stayed(mass),
        stayed(lanes(|l| mass[l] * v_z[l])),
        stayed(kinetic),
        stayed(lanes(|l| v_r[l] * v_r[l] + v_z[l] * v_z[l])),
        stayed(wave_squared),
    ];
    let [total, plastic, viscous, failure, at_start] = settled(done);
    let [at_end, present, momentum, moving, speed, wave] = settled(kept);
    for l in 0..LANES {
        sums.work.total += total[l];
        sums.work.plastic += plastic[l];
        sums.work.viscous += viscous[l];
        sums.work.failure += failure[l];
        sums.work.power_at_start += at_start[l];
        if (mass[l] > 0.0) & (stays[l] == 0.0) {
            take_out(block, l, kinetic[l], law, sums);
        }
        sums.work.power_at_end += at_end[l];
        sums.mass += present[l];
        sums.momentum += momentum[l];
        sums.kinetic += moving[l];
        sums.speed_squared = sums.speed_squared.max(speed[l]);
        sums.wave_squared = sums.wave_squared.max(wave[l]);
    }
}

/// Takes a particle out of its body: it has eroded, or left where particles are followed, or ceased to be one.
#[cold]
fn take_out(block: &mut Block, lane: usize, kinetic: f64, law: &Law, sums: &mut Sums) {
    let particle = block.particle(lane);
    block.take_out(lane);
    let [radius, depth] = particle.position;
    if !(kinetic + particle.pressure + depth + radius).is_finite() {
        sums.broken = true;
        return;
    }
    sums.lost.0 += 1;
    sums.lost.1 += particle.mass * particle.velocity[1];
    sums.lost.2 += kinetic;
    sums.work.failure += law.elastic_energy(&particle);
}
