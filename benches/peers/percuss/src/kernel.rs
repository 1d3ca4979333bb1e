//! The work of the other programs, by percuss's power function and in lanes like those of its batch engine.

use percuss::power::{Logarithm, Split};
use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;

use crate::{
    Outcome,
    problem::{Problem, Spring},
};

/// Chains side by side.
const LANES: usize = 8;

/// Springs whose powers are computed together, a stage for all of them before the next one.
const TILE: usize = 12;

/// Springs that a loop over the lanes takes at once. One would be too little for a compiler to see that the lanes are the vector.
const GROUP: usize = 2;

/// A number of every lane, where one load brings all of them.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
struct Lanes([f64; LANES]);

type Group = [Lanes; GROUP];

/// The way to advance the chains of a problem: the result is where their masses end [m], chain by chain.
pub(crate) fn choose(together: &str, law: &str) -> Outcome<fn(&Problem) -> Vec<f64>> {
    match (together, law) {
        ("one", "power") => Ok(one_after_the_other::<false>),
        ("one", "linear") => Ok(one_after_the_other::<true>),
        ("batch", "power") => Ok(side_by_side),
        _ => Err("one power, one linear or batch power".into()),
    }
}

fn one_after_the_other<const LINEAR: bool>(problem: &Problem) -> Vec<f64> {
    let chains = problem
        .speeds
        .par_iter()
        .flat_map_iter(|&speed| Arch::new().dispatch(One::<LINEAR> { problem, speed }));
    chains.collect()
}

fn side_by_side(problem: &Problem) -> Vec<f64> {
    let chains = problem.speeds.par_chunks(LANES).flat_map_iter(|speeds| {
        let mut lanes = Lanes::default();
        lanes.0[..speeds.len()].copy_from_slice(speeds);
        let ends = Arch::new().dispatch(Bundle { problem, lanes });
        let lanes = 0..speeds.len();
        lanes.flat_map(move |l| ends.iter().map(move |u| u.0[l]).collect::<Vec<_>>())
    });
    chains.collect()
}

/// Force of a spring: the power law, capped by the elastic line.
#[inline(always)]
fn force(spring: &Spring, strain: f64, logarithm: Logarithm) -> f64 {
    let elastic = spring.stiffness * strain.abs();
    let flow = spring.coefficient * logarithm.raise();
    let smaller = if flow < elastic { flow } else { elastic };
    smaller.copysign(strain)
}

/// One chain, its springs side by side.
struct One<'a, const LINEAR: bool> {
    problem: &'a Problem,
    speed: f64,
}

impl<const LINEAR: bool> NullaryFnOnce for One<'_, LINEAR> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn call(self) -> Vec<f64> {
        let springs = &self.problem.springs;
        let count = springs.len();
        let time_step = self.problem.time_step;
        // A column for every constant, so that those of neighbours load together.
        let column = |of: fn(&Spring) -> f64| Column::of(springs.iter().map(of));
        let (kick, per_length) = (column(|s| s.kick), column(|s| s.per_length));
        let (stiffness, coefficient) = (column(|s| s.stiffness), column(|s| s.coefficient));
        let exponents = column(|s| s.exponent);
        // The last place is the wall, and nothing pulls at the front of the chain.
        let (mut positions, mut velocities) = (Column::new(count + 1), Column::new(count));
        let (mut strains, mut forces) = (Column::new(count), Column::new(LANES + count));
        let (mut first, mut second) = (Column::new(count), Column::new(count));
        // Slices of one length, so that no loop has bounds to check.
        let (kick, per_length) = (&kick.all()[..count], &per_length.all()[..count]);
        let (stiffness, coefficient) = (&stiffness.all()[..count], &coefficient.all()[..count]);
        let (exponents, strains) = (&exponents.all()[..count], &mut strains.all_mut()[..count]);
        let first = &mut first.all_mut()[..count];
        let second = &mut second.all_mut()[..count];
        let (positions, velocities) = (positions.all_mut(), velocities.all_mut());
        // The forces ahead of the masses begin a cache line: they are stored, too.
        let forces = &mut forces.all_mut()[LANES - 1..];
        velocities[..self.problem.rod].fill(self.speed);
        for _ in 0..self.problem.steps {
            let (here, next) = (&positions[..count], &positions[1..][..count]);
            let ahead = &mut forces[1..][..count];
            for i in 0..count {
                let strain = (here[i] - next[i]) * per_length[i];
                if LINEAR {
                    ahead[i] = stiffness[i] * strain;
                } else {
                    strains[i] = strain;
                    let Split { binary, ratio } = Split::of(strain.abs());
                    (first[i], second[i]) = (binary, ratio);
                }
            }
            if !LINEAR {
                for i in 0..count {
                    let (binary, ratio) = (first[i], second[i]);
                    first[i] = Split { binary, ratio }.logarithm(exponents[i]).0;
                }
                for i in 0..count {
                    let spring = Spring {
                        stiffness: stiffness[i],
                        coefficient: coefficient[i],
                        ..Spring::default()
                    };
                    ahead[i] = force(&spring, strains[i], Logarithm(first[i]));
                }
            }
            let (behind, ahead) = (&forces[..count], &forces[1..][..count]);
            let (positions, velocities) = (&mut positions[..count], &mut velocities[..count]);
            for i in 0..count {
                velocities[i] = (behind[i] - ahead[i]).mul_add(kick[i], velocities[i]);
                positions[i] = velocities[i].mul_add(time_step, positions[i]);
            }
        }
        positions[..count].to_vec()
    }
}

/// Numbers of which the first one begins a cache line: a load of eight would otherwise touch two.
struct Column {
    room: Vec<f64>,
    first: usize,
    count: usize,
}

impl Column {
    fn new(count: usize) -> Self {
        let room = vec![0.0; count + LANES];
        let first = room.as_ptr().align_offset(align_of::<Lanes>());
        Self {
            // An address that no number of places aligns is used as it is.
            first: first.min(LANES),
            room,
            count,
        }
    }

    fn of(numbers: impl ExactSizeIterator<Item = f64>) -> Self {
        let mut column = Self::new(numbers.len());
        for (place, number) in column.all_mut().iter_mut().zip(numbers) {
            *place = number;
        }
        column
    }

    #[inline(always)]
    fn all(&self) -> &[f64] {
        &self.room[self.first..][..self.count]
    }

    #[inline(always)]
    fn all_mut(&mut self) -> &mut [f64] {
        &mut self.room[self.first..][..self.count]
    }
}

/// Chains side by side, one in each lane.
struct Bundle<'a> {
    problem: &'a Problem,
    /// Impact speeds.
    lanes: Lanes,
}

impl NullaryFnOnce for Bundle<'_> {
    type Output = Vec<Lanes>;

    #[inline(always)]
    #[allow(clippy::needless_range_loop)] // Loops over the lanes run along many arrays at once.
    fn call(self) -> Vec<Lanes> {
        let count = self.problem.springs.len();
        let time_step = self.problem.time_step;
        // Filled up to whole tiles by springs without stiffness and masses that nothing moves: the first of them is the wall.
        let mut springs = self.problem.springs.clone();
        springs.resize(count.next_multiple_of(TILE), Spring::default());
        let springs = springs.as_chunks::<TILE>().0;
        let mut positions = vec![Lanes::default(); springs.len() * TILE + 1];
        let mut velocities = vec![Lanes::default(); springs.len() * TILE];
        velocities[..self.problem.rod].fill(self.lanes);
        let mut strains = [Group::default(); TILE / GROUP];
        let (mut firsts, mut seconds) = (strains, strains);
        for _ in 0..self.problem.steps {
            let mut behind = Lanes::default();
            for (tile, springs) in springs.iter().enumerate() {
                let springs = springs.as_chunks::<GROUP>().0;
                let start = tile * TILE;
                for (group, springs) in springs.iter().enumerate() {
                    let positions = &positions[start + group * GROUP..][..=GROUP];
                    let mut strain = Group::default();
                    let (mut first, mut second) = (strain, strain);
                    for l in 0..LANES {
                        for (i, spring) in springs.iter().enumerate() {
                            let change = positions[i].0[l] - positions[i + 1].0[l];
                            strain[i].0[l] = change * spring.per_length;
                            let split = Split::of(strain[i].0[l].abs());
                            (first[i].0[l], second[i].0[l]) = (split.binary, split.ratio);
                        }
                    }
                    (strains[group], firsts[group], seconds[group]) = (strain, first, second);
                }
                for (group, springs) in springs.iter().enumerate() {
                    let (mut first, second) = (firsts[group], seconds[group]);
                    for l in 0..LANES {
                        for (i, spring) in springs.iter().enumerate() {
                            let (binary, ratio) = (first[i].0[l], second[i].0[l]);
                            first[i].0[l] = Split { binary, ratio }.logarithm(spring.exponent).0;
                        }
                    }
                    firsts[group] = first;
                }
                for (group, springs) in springs.iter().enumerate() {
                    let positions = &mut positions[start + group * GROUP..][..GROUP];
                    let velocities = &mut velocities[start + group * GROUP..][..GROUP];
                    let (strain, first) = (strains[group], firsts[group]);
                    let (mut position, mut velocity) = (Group::default(), Group::default());
                    position.copy_from_slice(positions);
                    velocity.copy_from_slice(velocities);
                    for l in 0..LANES {
                        for (i, spring) in springs.iter().enumerate() {
                            let ahead = force(spring, strain[i].0[l], Logarithm(first[i].0[l]));
                            let push = behind.0[l] - ahead;
                            velocity[i].0[l] = push.mul_add(spring.kick, velocity[i].0[l]);
                            position[i].0[l] =
                                velocity[i].0[l].mul_add(time_step, position[i].0[l]);
                            behind.0[l] = ahead;
                        }
                    }
                    positions.copy_from_slice(&position);
                    velocities.copy_from_slice(&velocity);
                }
            }
        }
        positions.truncate(count);
        positions
    }
}
