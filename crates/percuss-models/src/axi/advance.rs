//! Step of the particles of a chunk: nodes to particles, constitutive update, particles to nodes.
//!
//! The rate of volume and the pressure are means over the particles of a group, which have been in one cell: with a rate of volume of its
//! own in each of four particles of a cell, plastic flow, which keeps the volume, would have too few ways to go \[hughes1980\]. Both means
//! are weighted with volumes, so the power of the nodal forces stays that of the stresses. Nodes do not see what the pressures of a group
//! differ by, so that would drift as groups change: it decays as the material deforms.

use super::{
    block::{Block, Members},
    body::{Pass, Sums, Task},
    deform::{Rates, Work},
    field::Field,
    kernel::nearest,
    law::Law,
    mesh::{Mesh, Places, cell_lengths},
    transfer::Deposit,
};
use crate::{
    lanes::{LANES, Lanes},
    solver::Particle,
};

/// Particles after which a run of groups is worth a pass of its own, still close to the processor.
const RUN: usize = 32;

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
            particles,
            chunk,
            law,
            field,
        } = task;
        let mut sums = Sums::default();
        let mut scratch = Scratch::default();
        let (mut start, mut first) = (0, 0);
        for (group, &end) in chunk.group_ends.iter().enumerate() {
            if end - start >= RUN || group + 1 == chunk.group_ends.len() {
                let run = &mut particles[start..end];
                let ends = &chunk.group_ends[first..=group];
                advance_run(
                    run,
                    (start, ends),
                    law,
                    field,
                    pass,
                    &mut scratch,
                    &mut sums,
                );
                (start, first) = (end, group + 1);
            }
        }
        sums
    }
}

/// What passes from one part of the work on a run to the next, by particle.
#[derive(Debug, Default)]
struct Scratch {
    moving: Vec<Moving>,
    /// Whether a particle is alone in its group: 1 if it is.
    lone: Vec<f64>,
    /// Weights of the means: volumes, or 0 where a particle has failed.
    volumes: Vec<f64>,
    /// Own rates of volume, pressures and rates of shear; then their means.
    expansions: Vec<f64>,
    pressures: Vec<f64>,
    shears: Vec<f64>,
}

impl Scratch {
    /// Makes room for a run and finds who is alone.
    fn start(&mut self, particles: usize, (start, group_ends): (usize, &[usize])) {
        self.moving.clear();
        for values in [
            &mut self.lone,
            &mut self.volumes,
            &mut self.expansions,
            &mut self.pressures,
            &mut self.shears,
        ] {
            values.clear();
            values.resize(particles, 0.0);
        }
        let mut from = 0;
        for end in group_ends {
            let to = end - start;
            if to - from == 1 {
                self.lone[from] = 1.0;
            }
            from = to;
        }
    }
}

/// Particles that have moved and are yet to be deformed.
#[derive(Debug, Clone, Copy)]
struct Moving {
    members: Members,
    block: Block,
    rates: Rates,
    places: Places,
}

#[inline(always)]
fn advance_run(
    particles: &mut [Particle],
    (start, group_ends): (usize, &[usize]),
    law: &Law,
    field: &Field,
    pass: &Pass,
    scratch: &mut Scratch,
    sums: &mut Sums,
) {
    scratch.start(particles.len(), (start, group_ends));
    let Scratch {
        moving,
        lone,
        volumes,
        expansions,
        pressures,
        shears,
    } = scratch;
    let cell = pass.mesh.cell;
    let mut from = 0;
    while let Some(members) = Members::next(particles, &mut from) {
        let mut block = Block::of(particles, &members);
        let mut places = pass.mesh.places(&block.position);
        let mut rates = Rates::NONE;
        if pass.time_step > 0.0 {
            block.gather(&places, cell, field);
            let hoop_rate = block.hoop_rate(law);
            block.travel(pass.time_step, &members.lanes(lone));
            rates = Rates::of(&block, hoop_rate, pass.time_step);
            for (l, place) in members.iter() {
                // A failed particle bears no tension: it is no part of the mean of sound ones.
                let sound = if block.damage[l] < 1.0 { 1.0 } else { 0.0 };
                volumes[place] = sound * block.volume[l];
                expansions[place] = rates.expansion[l];
                pressures[place] = block.pressure[l];
                shears[place] = rates.shear(l);
            }
            places = pass.mesh.places(&block.position);
        }
        moving.push(Moving {
            members,
            block,
            rates,
            places,
        });
    }
    for values in [&mut *expansions, pressures, shears] {
        share_means(volumes, values, (start, group_ends));
    }
    for one in moving {
        let mut work = Work::NONE;
        if pass.time_step > 0.0 {
            let (mean, shear) = (one.members.lanes(pressures), one.members.lanes(shears));
            one.rates.expansion = one.members.lanes(expansions);
            one.rates
                .relax(&one.block, &mean, &shear, law, pass.time_step);
            let lengths = cell_lengths(cell, &one.places);
            let Moving {
                members,
                block,
                rates,
                ..
            } = one;
            work = law.deform(particles, members, block, rates, pass.time_step, &lengths);
        }
        add_up(particles, one, &work, law, pass, sums);
    }
}

/// Gives the mean over each group, weighted, to those of its members that have a weight.
#[inline(always)]
fn share_means(weights: &[f64], values: &mut [f64], (start, group_ends): (usize, &[usize])) {
    let mut from = 0;
    for end in group_ends {
        let to = end - start;
        if to - from > 1 {
            let (mut weight, mut sum) = (0.0, 0.0);
            for place in from..to {
                weight += weights[place];
                sum += weights[place] * values[place];
            }
            if weight > 0.0 {
                let mean = sum / weight;
                for place in from..to {
                    if weights[place] > 0.0 {
                        values[place] = mean;
                    }
                }
            }
        }
        from = to;
    }
}

/// Takes out the particles of a block that have left the body, and adds the others up.
#[inline(always)]
fn add_up(
    particles: &mut [Particle],
    moving: &Moving,
    work: &Work,
    law: &Law,
    pass: &Pass,
    sums: &mut Sums,
) {
    let Moving {
        members,
        block,
        places,
        ..
    } = moving;
    let kinetic = block.kinetic_energy(places, pass.mesh.cell);
    let wave_squared = law.wave_speed_squared(block);
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
        let [v_r, v_z] = particle.velocity;
        sums.mass += particle.mass;
        sums.momentum += particle.mass * v_z;
        sums.kinetic += kinetic[l];
        sums.speed_squared = sums.speed_squared.max(v_r * v_r + v_z * v_z);
        sums.wave_squared = sums.wave_squared.max(wave_squared[l]);
    }
}

/// Adds the particles of a chunk to its nodes.
pub(super) fn deposit(task: &mut Task<'_>, mesh: &Mesh) {
    pulp::Arch::new().dispatch(ToNodes { task, mesh });
}

struct ToNodes<'a, 'b> {
    task: &'a mut Task<'b>,
    mesh: &'a Mesh,
}

impl pulp::NullaryFnOnce for ToNodes<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { task, mesh } = self;
        let Task {
            particles,
            chunk,
            law,
            ..
        } = task;
        let mut weights = vec![0.0; particles.len()];
        let mut pressures = vec![0.0; particles.len()];
        let (mut least, mut most, mut widest) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        for (place, particle) in particles.iter().enumerate() {
            pressures[place] = particle.pressure + particle.viscous_pressure;
            if particle.mass > 0.0 {
                let [radius, depth] = particle.position;
                (least, most) = (least.min(depth), most.max(depth));
                widest = widest.max(radius);
                let sound = if particle.has_failed() { 0.0 } else { 1.0 };
                weights[place] = sound * particle.volume;
            }
        }
        let strip = &mut chunk.strip;
        if least > most {
            strip.open(0, 0, 0);
            return;
        }
        share_means(&weights, &mut pressures, (0, &chunk.group_ends));
        let [columns, first] = mesh.indices([widest, least]).map(|index| nearest(index).1);
        let [_, last] = mesh.indices([widest, most]).map(|index| nearest(index).1);
        strip.open(first - 1, (last - first) as usize + 3, columns as usize + 3);
        // All of a block by way of memory: so a node's numbers stay side by side.
        let mut deposits = [Deposit::default(); LANES];
        let mut from = 0;
        while let Some(members) = Members::next(particles, &mut from) {
            let mut position = [Lanes::all(0.0); 2];
            for (l, place) in members.iter() {
                position[0][l] = particles[place].position[0];
                position[1][l] = particles[place].position[1];
            }
            let Places { index, stretch } = mesh.places(&position);
            for (l, place) in members.iter() {
                let index = [index[0][l], index[1][l]];
                let stretch = [stretch[0][l], stretch[1][l]];
                deposits[l] = Deposit::of(
                    &particles[place],
                    pressures[place],
                    (index, stretch),
                    mesh.cell,
                    law.axisymmetric,
                );
            }
            for deposit in &deposits[..members.count()] {
                deposit.add_to(strip);
            }
        }
    }
}
