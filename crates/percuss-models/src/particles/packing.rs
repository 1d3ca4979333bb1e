//! Where the particles of a body stand: on the places of the lattice, or moved from them at random.

use super::{
    body::Rows,
    lattice::{Lattice, ROW},
    periodic::Periodic,
};
use crate::random::unit;

/// Rows and columns of the periodic cell that the stiffness of a packing is computed on, and its seed.
const CELL: usize = 48;
const CELL_SEED: u64 = 0x5eed;
/// Rounds in which the springs are tuned.
const ROUNDS: usize = 3;
/// Numbers drawn for one particle at most, and particles of a row at most that have numbers of their own.
const DRAWS: u64 = 64;
const COLUMNS: u64 = 1 << 24;

/// Packing of the particles of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Packing {
    /// On the places of the lattice.
    Regular,
    /// Moved from them.
    Irregular(Moved),
}

/// Random distances from the places of the lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moved {
    /// Largest distance, in spacings; below a half the triangles of the lattice keep their sense.
    pub(super) amplitude: f64,
    pub(super) seed: u64,
}

impl Moved {
    /// A point of a disc of the amplitude, in spacings: even over its area, drawn for a row and a column.
    pub(super) fn draw(&self, row: u64, column: u64) -> [f64; 2] {
        let first = (row * COLUMNS + column) * 2 * DRAWS;
        for draw in 0..DRAWS {
            let index = first + 2 * draw;
            let [x, z] = [index, index + 1].map(|index| 2.0 * unit(self.seed, index) - 1.0);
            if x * x + z * z <= 1.0 {
                return [self.amplitude * x, self.amplitude * z];
            }
        }
        [0.0; 2]
    }

    /// A point of a ball of the amplitude, in spacings: even over its volume, drawn for the number of a particle.
    pub(super) fn draw_in_space(&self, number: u64) -> [f64; 3] {
        let first = number * 3 * DRAWS;
        for draw in 0..DRAWS {
            let point = [0, 1, 2].map(|axis| 2.0 * unit(self.seed, first + 3 * draw + axis) - 1.0);
            if point.iter().map(|part| part * part).sum::<f64>() <= 1.0 {
                return point.map(|part| self.amplitude * part);
            }
        }
        [0.0; 3]
    }

    /// How far a particle is moved [m]: on the faces along them, at the sides of rows not at all.
    pub(super) fn shift(
        &self,
        spacing: f64,
        rows: Rows,
        (row, column): (usize, usize),
    ) -> [f64; 2] {
        let [x, z] = self.draw(row as u64, column as u64);
        let last = rows.particles - 1 - row % 2;
        if column == 0 || column >= last {
            return [0.0; 2];
        }
        let is_face = row == 0 || row + 1 == rows.count;
        [spacing * x, if is_face { 0.0 } else { spacing * z }]
    }

    /// The lattice with stiffnesses of its springs for which the packing has the elastic constants of the solid in the mean: those of
    /// a periodic cell of the same amplitude. Moved particles make a lattice softer, in shear not as much as in compression.
    pub(super) fn tuned(&self, lattice: &Lattice) -> Lattice {
        let cell = Self {
            amplitude: self.amplitude,
            seed: CELL_SEED,
        };
        let mut tuned = *lattice;
        for _ in 0..ROUNDS {
            let [along, up, first, second] = Periodic::new(&tuned, CELL, cell).constants();
            let (mean, lateral) = (0.5 * (along + up), 0.5 * (along + up) - first);
            // On the lattice C11 + C12 = √3 k_n, and C66 = (C11 − C12)/2 = √3/4 (k_n + k_s): of these two the mean.
            let normal = 0.5 * (mean + first) / ROW;
            let shear = (second + 0.5 * lateral) / ROW - normal;
            tuned.normal += lattice.normal - normal;
            tuned.shear = (tuned.shear + lattice.shear - shear).max(0.0);
        }
        tuned
    }
}

/// What a triangle of an area [m2] adds to the weight of one of its sides of a length [m]: `√3 L_f/l`, where the part `L_f` of the
/// dual facet is the distance of the side from the centroid.
pub(super) fn facet_weight(area: f64, length: f64) -> f64 {
    2.0 * ROW * (2.0 * area / length / 3.0) / length
}
