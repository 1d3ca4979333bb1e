//! A body: its law, its particles in chunks, and its nodes.

use super::{
    field::{Field, Strip},
    law::Law,
    localization::localize,
    mesh::Mesh,
};
use crate::solver::Particle;

/// Least number of particles that one task takes. It does not depend on the number of threads, so sums come out the same on any.
const CHUNK: usize = 1024;

/// A body with a velocity field of its own.
#[derive(Debug)]
pub(super) struct Body {
    pub(super) law: Law,
    /// In groups, each of which was in one cell when the particles were last put in order.
    pub(super) particles: Vec<Particle>,
    pub(super) chunks: Vec<Chunk>,
    pub(super) field: Field,
}

/// Particles that one task takes, in whole groups.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Chunk {
    /// Ends of the groups, counted from the first particle of the chunk.
    pub(super) group_ends: Vec<usize>,
    pub(super) strip: Strip,
}

impl Chunk {
    /// Particles in it.
    pub(super) fn len(&self) -> usize {
        self.group_ends.last().copied().unwrap_or(0)
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
    /// A body whose particles are yet to be put in order.
    pub(super) fn new(law: Law, particles: Vec<Particle>) -> Self {
        Self {
            law,
            particles,
            chunks: Vec::new(),
            field: Field::default(),
        }
    }

    /// Puts particles in the order of their cells, row by row, drops those that have left, and groups those of each cell.
    pub(super) fn put_in_order(&mut self, mesh: &Mesh) {
        self.particles.retain(|particle| particle.mass > 0.0);
        let cell = |particle: &Particle| {
            let [radius, depth] = mesh.indices(particle.position).map(|x| x.floor() as i64);
            (depth, radius)
        };
        self.particles.sort_by_cached_key(cell);
        if self.law.damage.is_some() {
            localize(&mut self.particles, cell);
        }
        let mut chunks = vec![Chunk::default()];
        let groups = self.particles.chunk_by(|a, b| cell(a) == cell(b));
        for group in groups {
            if let Some(chunk) = chunks.last_mut() {
                chunk.group_ends.push(chunk.len() + group.len());
                if chunk.len() >= CHUNK {
                    chunks.push(Chunk::default());
                }
            }
        }
        chunks.retain(|chunk| chunk.len() > 0);
        self.chunks = chunks;
    }

    /// Chunks with their particles.
    pub(super) fn tasks(&mut self) -> impl Iterator<Item = Task<'_>> {
        let (law, field) = (&self.law, &self.field);
        let mut rest = &mut *self.particles;
        self.chunks.iter_mut().map(move |chunk| {
            let (particles, others) = std::mem::take(&mut rest).split_at_mut(chunk.len());
            rest = others;
            Task {
                particles,
                chunk,
                law,
                field,
            }
        })
    }
}

/// A chunk, its particles, and what they need of their body.
#[derive(Debug)]
pub(super) struct Task<'a> {
    pub(super) particles: &'a mut [Particle],
    pub(super) chunk: &'a mut Chunk,
    pub(super) law: &'a Law,
    pub(super) field: &'a Field,
}
