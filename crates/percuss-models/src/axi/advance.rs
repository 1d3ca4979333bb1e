//! Step of the particles of a chunk: nodes to particles and constitutive update.
//!
//! The rate of volume and the pressure are means over the particles of a group, which have been in one cell: with a rate of volume of its
//! own in each of four particles of a cell, plastic flow, which keeps the volume, would have too few ways to go \[hughes1980\]. Both means
//! are weighted with volumes, so the power of the nodal forces stays that of the stresses. Nodes do not see what the pressures of a group
//! differ by, so that would drift as groups change: it decays as the material deforms.

use super::{
    block::Block,
    body::{Chunk, Pass, Sums, Task},
    field::Field,
    mesh::{Places, cell_lengths},
};
use crate::{
    lanes::{LANES, Lanes, lanes, larger, settled},
    solid::{Law, MaterialPoints, Rates, Work},
};

/// Moves and deforms the particles of a chunk; a time step of 0 leaves them as they are.
///
/// Compiled for each width of vectors and chosen when it runs. What is fused and in which order sums are made is fixed, so every processor
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
        let mut lane_sums = LaneSums::default();
        for (number, (block, moving)) in blocks.iter_mut().zip(moving).enumerate() {
            let Moving { rates, places } = moving;
            let mut work = Work::NONE;
            if pass.time_step > 0.0 {
                let [expansion, pressure, shear] = means(
                    &shares[number],
                    block,
                    [rates.expansion, block.pressure, NONE],
                );
                rates.expansion = expansion;
                rates.relax(block, &pressure, &shear, law, pass.time_step);
                let lengths = cell_lengths(pass.mesh.cell, places);
                work = law.deform(block, rates, pass.time_step, &lengths);
            }
            lane_sums.add(block, places, &work, law, pass, &mut sums);
        }
        lane_sums.fold(&mut sums);
        sums
    }
}

/// What passes from one part of the work on a chunk to the next.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    moving: Vec<Moving>,
    /// What means of groups are made of, then the means, by block: volumes, or 0 where a particle has failed or left, and times these the
    /// rates of volume, pressures and rates of shear.
    shares: Vec<[Lanes; 4]>,
    /// The same for the pressures that nodes get.
    pub(super) pressures: Vec<[Lanes; 2]>,
}

const NONE: Lanes = Lanes::all(0.0);

impl Scratch {
    /// Makes room for a number of blocks.
    #[inline(always)]
    fn start(&mut self, blocks: usize) {
        self.moving.clear();
        self.moving.reserve(blocks);
        self.shares.resize(blocks, [NONE; 4]);
    }

    /// Notes what means are to be made of.
    #[inline(always)]
    fn note(&mut self, number: usize, block: &Block, rates: &Rates) {
        let shear = settled(rates.shear());
        note(
            &mut self.shares[number],
            block,
            [&rates.expansion, &block.pressure, &shear],
        );
    }
}

/// Notes weights and weighted values of a block.
#[inline(always)]
pub(super) fn note<const N: usize, const M: usize>(
    shares: &mut [Lanes; N],
    block: &Block,
    values: [&Lanes; M],
) {
    let weight = settled(block.weights());
    let mass = block.mass;
    shares[0] = weight;
    let mut weighted = [NONE; M];
    for (weighted, values) in weighted.iter_mut().zip(values) {
        let values = *values;
        // What has left may be no number any more.
        *weighted = lanes(|l| weight[l] * if mass[l] > 0.0 { values[l] } else { 0.0 });
    }
    shares[1..].copy_from_slice(&settled(weighted));
}

/// Means of the groups for the particles of a block that share them, and the own values of the others.
#[inline(always)]
pub(super) fn means<const N: usize, const M: usize>(
    shares: &[Lanes; N],
    block: &Block,
    own: [Lanes; M],
) -> [Lanes; M] {
    let (weight, lone) = (block.weights(), block.lone);
    let total = shares[0];
    let mut means = own;
    for (mean, means) in shares[1..].iter().zip(&mut means) {
        let (mean, own) = (*mean, *means);
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
pub(super) fn share_means<const N: usize>(shares: &mut [[Lanes; N]], group_ends: &[usize]) {
    let mut from = 0;
    for &to in group_ends {
        if to - from > 1 {
            let mut sums = [0.0; N];
            for place in from..to {
                let share = &shares[place / LANES];
                for (sum, entry) in sums.iter_mut().zip(share) {
                    *sum += entry[place % LANES];
                }
            }
            let per_weight = 1.0 / sums[0];
            for sum in &mut sums[1..] {
                *sum *= per_weight;
            }
            for place in from..to {
                let share = &mut shares[place / LANES];
                for (sum, entry) in sums.iter().zip(share) {
                    entry[place % LANES] = *sum;
                }
            }
        }
        from = to;
    }
}

/// [`Sums`] of a chunk, lane by lane.
#[derive(Default)]
struct LaneSums {
    /// Work of the step: total, plastic, viscous, of failure, power at its start and its end; mass, axial momentum and kinetic energy.
    sums: [Lanes; 9],
    /// Squares of speeds: of particles and of waves.
    most: [Lanes; 2],
}

impl LaneSums {
    /// Takes out the particles of a block that have left the body, and adds the others up.
    #[inline(always)]
    fn add(
        &mut self,
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
        let MaterialPoints {
            mass,
            pressure,
            damage,
            plastic_strain,
            ..
        } = block.points;
        let [v_r, v_z] = block.velocity;
        let (limits, [most_damage, most_strain]) = (pass.limits, law.erosion());
        let stays = settled(lanes(|l| {
            // A comparison with what is no number fails, so this finds those too.
            let is_finite = (kinetic[l] + pressure[l] + depth[l] + radius[l]).abs() < f64::INFINITY;
            let is_inside = (radius[l] <= limits.radius)
                & (depth[l] >= limits.back)
                & (depth[l] <= limits.front);
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
        let more = settled([
            was(work.total),
            was(work.plastic),
            was(work.viscous),
            was(work.failure),
            was(work.power_at_start),
            stayed(work.power_at_end),
            stayed(mass),
            stayed(lanes(|l| mass[l] * v_z[l])),
            stayed(kinetic),
        ]);
        for (sum, more) in self.sums.iter_mut().zip(&more) {
            let before = *sum;
            *sum = lanes(|l| before[l] + more[l]);
        }
        let speed = stayed(lanes(|l| v_r[l] * v_r[l] + v_z[l] * v_z[l]));
        let squares = settled([speed, stayed(wave_squared)]);
        for (most, squared) in self.most.iter_mut().zip(squares) {
            let before = *most;
            *most = lanes(|l| larger(squared[l], before[l]));
        }
        let mut leaving = 0;
        for l in 0..LANES {
            leaving |= u8::from((mass[l] > 0.0) & (stays[l] == 0.0)) << l;
        }
        for l in (0..LANES).filter(|l| leaving >> l & 1 == 1) {
            take_out(block, l, kinetic[l], (law, limits.front), sums);
        }
    }

    /// Adds the lanes up, one after the other.
    #[inline(always)]
    fn fold(&self, sums: &mut Sums) {
        let [
            total,
            plastic,
            viscous,
            failure,
            at_start,
            at_end,
            mass,
            momentum,
            kinetic,
        ] = self.sums.map(|sum| sum.iter().sum::<f64>());
        sums.work.total += total;
        sums.work.plastic += plastic;
        sums.work.viscous += viscous;
        sums.work.failure += failure;
        sums.work.power_at_start += at_start;
        sums.work.power_at_end += at_end;
        sums.mass += mass;
        sums.momentum += momentum;
        sums.kinetic += kinetic;
        let [speed, wave] = self
            .most
            .map(|most| most.iter().copied().fold(0.0, f64::max));
        (sums.speed_squared, sums.wave_squared) = (speed, wave);
    }
}

/// Takes a particle out of its body: it has eroded, or left where particles are followed, or ceased to be one.
#[cold]
fn take_out(
    block: &mut Block,
    lane: usize,
    kinetic: f64,
    (law, front): (&Law, f64),
    sums: &mut Sums,
) {
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
    if depth > front {
        sums.passed += particle.mass;
    }
    sums.work.failure += law.elastic_energy(&particle);
}
