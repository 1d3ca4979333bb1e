//! Particles of a body of revolution, in rings and layers that fit it.

use std::f64::consts::PI;

use super::mesh::{Axis, Mesh};
use crate::{
    Error,
    solid::Law,
    solver::{Control, Particle},
};

/// Rings or layers of particles between two positions: evenly spaced, and one to a cell where cells grow.
pub(super) struct Division {
    /// Indices of the first and the last side, and of the last evenly spaced one.
    start: f64,
    end: f64,
    even_to: f64,
    /// Evenly spaced rings or layers, and those beyond.
    even: usize,
    far: usize,
}

impl Division {
    pub(super) fn new(axis: &Axis, (from, to): (f64, f64), per_cell: u32) -> Self {
        let [start, end] = [from, to].map(|position| axis.index(position));
        // Rounding of a position on the last even node must not leave a sliver behind it.
        let even_to = if end < axis.even_to() + 0.5 {
            end
        } else {
            axis.even_to().max(start)
        };
        let even = ((even_to - start) * f64::from(per_cell)).round() as usize;
        Self {
            start,
            end,
            even_to,
            even: even.max(usize::from(even_to == end)),
            far: (end - even_to).ceil() as usize,
        }
    }

    /// Rings or layers in all.
    pub(super) fn count(&self) -> f64 {
        self.even as f64 + self.far as f64
    }

    /// Positions of the sides [m].
    fn sides(&self, axis: &Axis, from: f64) -> Vec<f64> {
        let at = |start: f64, end: f64, count: usize| {
            (1..=count).map(move |k| axis.position(start + (end - start) * k as f64 / count as f64))
        };
        let even = at(self.start, self.even_to, self.even);
        let far = at(self.even_to, self.end, self.far);
        [from].into_iter().chain(even).chain(far).collect()
    }
}

/// Sides of the rings or layers of particles between two positions.
fn sides(axis: &Axis, (from, to): (f64, f64), per_cell: u32) -> Vec<f64> {
    Division::new(axis, (from, to), per_cell).sides(axis, from)
}

/// A body of revolution that is filled with particles.
#[derive(Debug)]
pub(super) struct Filling<'a> {
    pub(super) law: &'a Law,
    /// [m].
    pub(super) radius: f64,
    /// Depths of its two ends [m].
    pub(super) span: (f64, f64),
    /// Nodes, and particles along the side of a cell.
    pub(super) mesh: (&'a Mesh, u32),
    /// [m/s].
    pub(super) velocity: f64,
    /// [K].
    pub(super) temperature: f64,
}

impl Filling<'_> {
    /// The particles, in rings and in layers that fit the body, of equal width and height where cells are; a ring that the surface cuts
    /// has the part of its mass that lies inside.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn fill(
        &self,
        inside: impl Fn(f64, f64) -> f64,
        control: &mut Control<'_>,
    ) -> Result<Vec<Particle>, Error> {
        let (mesh, per_cell) = self.mesh;
        let rings = sides(&mesh.radial, (0.0, self.radius), per_cell);
        let layers = sides(&mesh.axial, self.span, per_cell);
        let mut particles = Vec::with_capacity(rings.len() * layers.len());
        let pairs = layers
            .windows(2)
            .flat_map(|layer| rings.windows(2).map(move |ring| (layer, ring)));
        control.set_up(pairs, 1, |(layer, ring)| {
            let (depth, height) = (0.5 * (layer[0] + layer[1]), layer[1] - layer[0]);
            let (at, width) = (0.5 * (ring[0] + ring[1]), ring[1] - ring[0]);
            let part = inside_part(at, depth, width, height, &inside);
            if part <= 0.0 {
                return;
            }
            let volume = part * 2.0 * PI * at * width * height;
            let mut particle = Particle {
                position: [at, depth],
                velocity: [0.0, self.velocity],
                mass: self.law.density * volume,
                volume,
                temperature: self.temperature,
                sides: [width, height],
                ..Particle::default()
            };
            particle.yield_point = self.law.slow_yield_point(&particle);
            particles.push(particle);
        })?;
        Ok(particles)
    }
}

/// Part of a ring's volume inside a body whose surface has a radius at each depth.
fn inside_part(
    at: f64,
    depth: f64,
    width: f64,
    height: f64,
    surface: &impl Fn(f64, f64) -> f64,
) -> f64 {
    const SAMPLES: u32 = 16;
    let sum: f64 = (0..SAMPLES)
        .map(|sample| {
            let offset = (f64::from(sample) + 0.5) / f64::from(SAMPLES) - 0.5;
            let edge = surface(depth + offset * height, at);
            let part = ((edge - (at - 0.5 * width)) / width).clamp(0.0, 1.0);
            // The inner part of a ring is shorter around.
            part * (1.0 + (part - 1.0) * 0.5 * width / at)
        })
        .sum();
    sum / f64::from(SAMPLES)
}
