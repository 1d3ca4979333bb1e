//! A body: its law, its particles in chunks, and its nodes.

use super::{
    advance::Scratch,
    block::Block,
    field::{Field, Strip},
    localization::localize,
    mesh::Mesh,
};
use crate::{
    Error,
    lanes::LANES,
    solid::Law,
    solver::{Control, Particle},
};

/// Least number of particles that one task takes. It does not depend on the number of threads, so sums come out the same on any.
const CHUNK: usize = 512;
/// Particles of a chunk before they are put in order: whole blocks.
const SET_UP_CHUNK: usize = CHUNK.next_multiple_of(LANES);

/// A body with a velocity field of its own.
#[derive(Debug)]
pub(super) struct Body {
    pub(super) law: Law,
    /// Particles in groups, each of which was in one cell when they were last put in order. A chunk begins with a block of its own.
    pub(super) blocks: Vec<Block>,
    pub(super) chunks: Vec<Chunk>,
    pub(super) field: Field,
    /// Cells and places of the particles, while they are put in order.
    keys: Vec<(u64, usize)>,
    spare: Vec<Block>,
}

/// Particles that one task takes, in whole groups.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Chunk {
    /// Ends of the groups, counted from the first particle of the chunk.
    pub(super) group_ends: Vec<usize>,
    pub(super) strip: Strip,
    #[serde(skip)]
    pub(super) scratch: Scratch,
}

impl Chunk {
    /// Particles in it.
    pub(super) fn len(&self) -> usize {
        self.group_ends.last().copied().unwrap_or(0)
    }

    /// Blocks that they fill.
    fn blocks(&self) -> usize {
        self.len().div_ceil(LANES)
    }
}

/// What all particles of a step have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pass {
    pub(super) time_step: f64,
    pub(super) mesh: Mesh,
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
    /// Mass of it that left at the front [kg].
    pub(super) passed: f64,
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
        self.passed += other.passed;
        self.wave_squared = self.wave_squared.max(other.wave_squared);
        self.speed_squared = self.speed_squared.max(other.speed_squared);
        self.broken |= other.broken;
    }
}

impl Body {
    /// A body whose particles are yet to be put in order.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn set_up(
        law: Law,
        particles: Vec<Particle>,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        // Each chunk is one group until they are put in order.
        let chunks = particles.chunks(SET_UP_CHUNK).map(|part| Chunk {
            group_ends: vec![part.len()],
            ..Chunk::default()
        });
        let mut body = Self {
            law,
            blocks: Vec::new(),
            chunks: chunks.collect(),
            field: Field::default(),
            keys: Vec::new(),
            spare: Vec::new(),
        };
        body.fill(particles.into_iter(), control)?;
        Ok(body)
    }

    /// Particles in it, with those that have left since they were put in order.
    pub(super) fn len(&self) -> usize {
        self.chunks.iter().map(Chunk::len).sum()
    }

    /// The particles in their order, with those that have left since it was made.
    pub(super) fn particles(&self) -> impl Iterator<Item = Particle> {
        let mut rest = &*self.blocks;
        self.chunks.iter().flat_map(move |chunk| {
            let (blocks, others) = rest.split_at(chunk.blocks());
            rest = others;
            (0..chunk.len()).map(|place| blocks[place / LANES].particle(place % LANES))
        })
    }

    /// Replaces the particles by as many others in the same order.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn set_particles(
        &mut self,
        particles: &[Particle],
        control: &mut Control<'_>,
    ) -> Result<(), Error> {
        self.fill(particles.iter().copied(), control)
    }

    fn fill(
        &mut self,
        mut particles: impl Iterator<Item = Particle>,
        control: &mut Control<'_>,
    ) -> Result<(), Error> {
        self.blocks.clear();
        self.blocks
            .reserve_exact(self.chunks.iter().map(Chunk::blocks).sum());
        let (chunks, blocks) = (&self.chunks, &mut self.blocks);
        control.set_up(chunks, CHUNK, |chunk| {
            let first = blocks.len();
            blocks.resize(first + chunk.blocks(), Block::default());
            let mut from = 0;
            for &end in &chunk.group_ends {
                for (place, particle) in (from..end).zip(&mut particles) {
                    let block = &mut blocks[first + place / LANES];
                    block.set_particle(place % LANES, &particle);
                    block.lone[place % LANES] = if end - from == 1 { 1.0 } else { 0.0 };
                }
                from = end;
            }
        })
    }

    /// Puts particles in the order of their cells, row by row, drops those that have left, and groups those of each cell.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn put_in_order(
        &mut self,
        mesh: &Mesh,
        control: &mut Control<'_>,
    ) -> Result<(), Error> {
        let mut keys = std::mem::take(&mut self.keys);
        keys.clear();
        control.set_up(self.blocks.iter().enumerate(), LANES, |(number, block)| {
            let [columns, rows] = mesh.places(&block.position).index;
            let present = (0..LANES).filter(|&l| block.mass[l] > 0.0);
            keys.extend(present.map(|l| (cell_key(rows[l], columns[l]), number * LANES + l)));
        })?;
        keys.sort_unstable();
        control.ask()?;
        // What the old chunks have in memory is used again.
        let mut old = std::mem::take(&mut self.chunks);
        let mut begin = || {
            let mut chunk = old.pop().unwrap_or_default();
            chunk.group_ends.clear();
            chunk
        };
        let mut chunks = vec![begin()];
        for group in keys.chunk_by(|a, b| a.0 == b.0) {
            if let Some(chunk) = chunks.last_mut() {
                chunk.group_ends.push(chunk.len() + group.len());
                if chunk.len() >= CHUNK {
                    chunks.push(begin());
                }
            }
        }
        chunks.retain(|chunk| chunk.len() > 0);
        self.chunks = chunks;
        std::mem::swap(&mut self.blocks, &mut self.spare);
        let mut before = std::mem::take(&mut self.spare);
        if self.law.damage.is_some() {
            localize(&mut before, &keys);
        }
        let places = keys.iter();
        self.fill(
            places.map(|&(_, place)| before[place / LANES].particle(place % LANES)),
            control,
        )?;
        self.spare = before;
        self.keys = keys;
        Ok(())
    }

    /// Chunks with their particles.
    pub(super) fn tasks(&mut self) -> impl Iterator<Item = Task<'_>> {
        let (law, field) = (&self.law, &self.field);
        let mut rest = &mut *self.blocks;
        self.chunks.iter_mut().map(move |chunk| {
            let (blocks, others) = std::mem::take(&mut rest).split_at_mut(chunk.blocks());
            rest = others;
            Task {
                blocks,
                chunk,
                law,
                field,
            }
        })
    }
}

/// A number for each cell, larger for cells of later rows, and of later columns in a row.
fn cell_key(row: f64, column: f64) -> u64 {
    let [row, column] = [row, column].map(|index| {
        let whole = index as i32;
        let floor = whole - i32::from(f64::from(whole) > index);
        u64::from(floor.cast_unsigned() ^ (1 << 31))
    });
    (row << 32) | column
}

/// A chunk, its particles, and what they need of their body.
#[derive(Debug)]
pub(super) struct Task<'a> {
    pub(super) blocks: &'a mut [Block],
    pub(super) chunk: &'a mut Chunk,
    pub(super) law: &'a Law,
    pub(super) field: &'a Field,
}
