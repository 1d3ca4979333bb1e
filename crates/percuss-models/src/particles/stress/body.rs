//! A body whose particles have a stress.

use std::sync::Arc;

use super::{
    ring,
    state::{StressRow, volume_and_stretch},
};
use crate::{
    Error,
    particles::{body::Body, lattice::ROW},
    solid::Law,
    solver::{Control, Particle},
};

/// Stiffness of the stabilisation over that of a lattice whose springs have the shear modulus alone: at 0.1 it took 2.4 % of the energy of a
/// bar on a wall of 41 rows, and at 0.03 the length changed by 0.4 %.
const STABILISATION: f64 = 0.05;

/// A body.
#[derive(Debug, Clone)]
pub(crate) struct StressBody {
    /// Particles, triangles, displacements and velocities. Its springs have no part in the motion.
    pub(super) frame: Body,
    pub(super) law: Arc<Law>,
    /// Triangles that the particles of each row have.
    pub(super) triangles: Vec<Vec<u8>>,
    pub(super) rows: Vec<StressRow>,
    /// Least and largest depth of the particles of each row [m].
    pub(super) depths: Vec<[f64; 2]>,
    /// Stiffness of the stabilisation before any flow [N/m per m].
    pub(super) stiffness: f64,
    /// Square of the speed of longitudinal waves before any deformation [m2/s2].
    pub(super) wave_squared: f64,
}

impl StressBody {
    /// A body of the particles and triangles of another one.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(crate) fn new(
        mut frame: Body,
        law: Law,
        temperature: f64,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        // Particles of this body do not turn.
        for ((make, state), motion) in frame
            .rows
            .iter_mut()
            .zip(&mut frame.state)
            .zip(&mut frame.motion)
        {
            make.inverse_inertia = Vec::new();
            make.rests = Default::default();
            (state.cosine, state.sine) = (Vec::new(), Vec::new());
            motion.spin = Vec::new();
        }
        let shear = law.shear_modulus;
        let stiffness = STABILISATION * shear / ROW;
        let mut point = Particle {
            temperature,
            ..Particle::default()
        };
        point.yield_point = law.slow_yield_point(&point);
        let (mut rows, mut triangles) = (Vec::new(), Vec::new());
        let places = frame.stride;
        control.set_up(0..frame.rows.len(), places, |row| {
            rows.push(StressRow::at_rest(places, stiffness, &point));
            triangles.push(ring::triangles(&frame, row));
        })?;
        let mut body = Self {
            depths: vec![[0.0; 2]; rows.len()],
            wave_squared: (law.bulk_modulus + 4.0 / 3.0 * shear) / law.density,
            law: Arc::new(law),
            frame,
            triangles,
            rows,
            stiffness,
        };
        body.find_depths();
        Ok(body)
    }

    /// Stiffness of the contact of a particle with a rigid body: that of a row of triangles [N/m per m].
    pub(super) fn stiffness_of_contact(&self) -> f64 {
        self.law.density * self.wave_squared / ROW
    }

    /// Finds the depths of all rows.
    pub(super) fn find_depths(&mut self) {
        for row in 0..self.rows.len() {
            self.depths[row] = depths(&self.frame, row, &self.frame.state[row].z);
        }
    }

    /// Deformation gradient less 1 of the triangle of a particle and two of its neighbours.
    fn of_triangle(&self, row: usize, place: usize, k: usize) -> [f64; 4] {
        let frame = &self.frame;
        let places = ring::places(place, row % 2);
        let vector = |k: usize| {
            let (other, at) = (row + ring::ROWS[k] - 1, places[k]);
            let (from, to) = (frame.rest_place(row, place), frame.rest_place(other, at));
            let (a, b) = (&frame.state[row], &frame.state[other]);
            (
                [to[0] - from[0], to[1] - from[1]],
                [b.x[at] - a.x[place], b.z[at] - a.z[place]],
            )
        };
        let (([a_x, a_z], u), ([b_x, b_z], w)) = (vector(k), vector((k + 1) % ring::RING));
        let per_area = 1.0 / (a_x * b_z - a_z * b_x);
        let of = |axis: usize| {
            [
                per_area * (u[axis] * b_z - w[axis] * a_z),
                per_area * (w[axis] * a_x - u[axis] * b_x),
            ]
        };
        let ([xx, xz], [zx, zz]) = (of(0), of(1));
        [xx, xz, zx, zz]
    }

    /// Smallest stretch or ratio of area of the triangles that begin in a row; 1 and more where none is compressed.
    pub(super) fn least_stretch(&self, row: usize) -> f64 {
        let mut least = f64::INFINITY;
        for place in 1..self.frame.stride - 1 {
            // Both triangles towards the next row: each triangle of the body is one of these once.
            for k in 0..2 {
                if self.triangles[row][place] >> k & 1 == 1 {
                    let (area, stretch) = volume_and_stretch(self.of_triangle(row, place, k));
                    least = least.min(area.min(stretch));
                }
            }
        }
        least
    }
}

/// Least and largest depth of the particles of a row that are displaced so far [m].
pub(super) fn depths(frame: &Body, row: usize, displacements: &[f64]) -> [f64; 2] {
    let make = &frame.rows[row];
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    let mut add = |place: usize, moved: f64| {
        if make.mass[place] > 0.0 {
            let depth = moved + displacements[place];
            range = [range[0].min(depth), range[1].max(depth)];
        }
    };
    for place in 1..frame.stride - 1 {
        add(
            place,
            if make.is_moved() {
                make.shift[1][place]
            } else {
                0.0
            },
        );
    }
    let start = frame.origin[1] + row as f64 * ROW * frame.lattice.spacing;
    range.map(|depth| start + depth)
}
