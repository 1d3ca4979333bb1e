//! A body of particles on rows of a hexagonal lattice: state, masses and weights of bonds.

use serde::{Deserialize, Serialize};

use super::lattice::{Lattice, ROW};

/// Displacements [m] and rotations of a row. A place before the first particle and places behind the last one stay at rest.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct RowState {
    pub(super) x: Vec<f64>,
    pub(super) z: Vec<f64>,
    /// Cosine of the rotation.
    pub(super) cosine: Vec<f64>,
    /// Its sine.
    pub(super) sine: Vec<f64>,
}

/// Velocities of a row, half a step behind its displacements.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct RowMotion {
    pub(super) x: Vec<f64>,
    pub(super) z: Vec<f64>,
    /// Angular velocity [rad/s].
    pub(super) spin: Vec<f64>,
}

/// What a row is made of.
#[derive(Debug, Clone, Default)]
pub(super) struct RowMake {
    /// Masses [kg per m]; 0 where there is no particle.
    pub(super) mass: Vec<f64>,
    /// One over the mass; 0 where there is no particle.
    pub(super) inverse_mass: Vec<f64>,
    /// One over the moment of inertia; 0 where there is no particle.
    pub(super) inverse_inertia: Vec<f64>,
    /// Weights of the bonds that start in the row: half the number of triangles that share a bond.
    pub(super) weights: [Vec<f64>; 3],
}

/// A body.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) lattice: Lattice,
    /// Lateral position of the first particle of an even row, and depth of the first row [m].
    pub(super) origin: [f64; 2],
    /// Places of a row: a multiple of the lanes, and one more on either side.
    pub(super) stride: usize,
    pub(super) rows: Vec<RowMake>,
    pub(super) state: Vec<RowState>,
    pub(super) motion: Vec<RowMotion>,
    /// Displacements after the step that is computed.
    pub(super) next: Vec<RowState>,
    /// Whether the last row cannot move along the direction of impact.
    pub(super) held: bool,
    /// Area of all triangles [m2].
    pub(super) area: f64,
}

/// Shape of the rows of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rows {
    /// Number of rows.
    pub(super) count: usize,
    /// Particles of an even row; an odd one has one less, so that the body is symmetric.
    pub(super) particles: usize,
}

/// Places for so many particles in a row.
fn stride(particles: usize) -> usize {
    2 + particles.next_multiple_of(crate::lanes::LANES)
}

impl Body {
    /// A strip of rows along the struck face, symmetric about `x = 0`, with its first row at a depth [m].
    pub(super) fn strip(lattice: Lattice, rows: Rows, depth: f64) -> Self {
        let columns = |row: usize| rows.particles - row % 2;
        Self::of_particles(lattice, rows, depth, |row, column| column < columns(row))
    }

    /// A body of the triangles of which all three particles are there.
    pub(super) fn of_particles(
        lattice: Lattice,
        rows: Rows,
        depth: f64,
        is_there: impl Fn(usize, usize) -> bool,
    ) -> Self {
        let stride = stride(rows.particles);
        let zeros = || vec![0.0; stride];
        let mut body = Self {
            lattice,
            origin: [
                -0.5 * (rows.particles as f64 - 1.0) * lattice.spacing,
                depth,
            ],
            stride,
            rows: (0..rows.count)
                .map(|_| RowMake {
                    mass: zeros(),
                    inverse_mass: zeros(),
                    inverse_inertia: zeros(),
                    weights: [zeros(), zeros(), zeros()],
                })
                .collect(),
            state: vec![
                RowState {
                    x: zeros(),
                    z: zeros(),
                    cosine: vec![1.0; stride],
                    sine: zeros(),
                };
                rows.count
            ],
            motion: vec![
                RowMotion {
                    x: zeros(),
                    z: zeros(),
                    spin: zeros(),
                };
                rows.count
            ],
            next: Vec::new(),
            held: false,
            area: 0.0,
        };
        body.next.clone_from(&body.state);
        let at = |row: usize, place: usize| {
            (1..=rows.particles).contains(&place) && is_there(row, place - 1)
        };
        for row in 0..rows.count.saturating_sub(1) {
            for place in 1..stride - 1 {
                body.add_triangles(row, place, &at);
            }
        }
        body.finish();
        body
    }

    /// The two triangles on the side of the next row of the bond that starts at a place: both share a particle and its bond to the right.
    fn add_triangles(&mut self, row: usize, place: usize, at: &impl Fn(usize, usize) -> bool) {
        let odd = row % 2;
        // The particles below the bond of the row: to the right and, for the second triangle, to the left.
        let right = place + odd;
        if at(row, place) && at(row, place + 1) && at(row + 1, right) {
            // Bonds along the row, to the right, and from the next particle to the left.
            self.add_triangle(
                [(row, place), (row, place + 1), (row + 1, right)],
                [(row, place, 0), (row, place, 1), (row, place + 1, 2)],
            );
        }
        if at(row, place) && right >= 1 && at(row + 1, right) && at(row + 1, right - 1) {
            self.add_triangle(
                [(row, place), (row + 1, right), (row + 1, right - 1)],
                [(row, place, 1), (row, place, 2), (row + 1, right - 1, 0)],
            );
        }
    }

    fn add_triangle(&mut self, corners: [(usize, usize); 3], bonds: [(usize, usize, usize); 3]) {
        // A particle inside has six triangles, and its mass is that of two.
        let share = self.lattice.mass / 6.0;
        for (row, place) in corners {
            self.rows[row].mass[place] += share;
        }
        for (row, place, kind) in bonds {
            self.rows[row].weights[kind][place] += 0.5;
        }
        self.area += 0.5 * ROW * self.lattice.spacing * self.lattice.spacing;
    }

    fn finish(&mut self) {
        let Lattice { mass, inertia, .. } = self.lattice;
        for row in &mut self.rows {
            for (place, &own) in row.mass.iter().enumerate() {
                if own > 0.0 {
                    row.inverse_mass[place] = 1.0 / own;
                    row.inverse_inertia[place] = mass / (own * inertia);
                }
            }
        }
    }

    /// Position of a particle before the impact [m].
    pub(super) fn reference(&self, row: usize, place: usize) -> [f64; 2] {
        let column = place as f64 - 1.0 + 0.5 * (row % 2) as f64;
        let spacing = self.lattice.spacing;
        [
            self.origin[0] + column * spacing,
            self.origin[1] + row as f64 * ROW * spacing,
        ]
    }

    /// Position of a particle now [m].
    pub(super) fn position(&self, row: usize, place: usize) -> [f64; 2] {
        let [x, z] = self.reference(row, place);
        let state = &self.state[row];
        [x + state.x[place], z + state.z[place]]
    }

    /// Rows and places of all particles, in order.
    pub(super) fn particles(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.rows.iter().enumerate().flat_map(|(row, make)| {
            let there = make
                .mass
                .iter()
                .enumerate()
                .filter(|(_, mass)| **mass > 0.0);
            there.map(move |(place, _)| (row, place))
        })
    }

    /// Gives all particles a velocity along the direction of impact [m/s].
    pub(super) fn launch(&mut self, velocity: f64) {
        for (row, motion) in self.rows.iter().zip(&mut self.motion) {
            for (speed, mass) in motion.z.iter_mut().zip(&row.mass) {
                if *mass > 0.0 {
                    *speed = velocity;
                }
            }
        }
    }

    /// Mass of all particles [kg per m].
    pub(super) fn mass(&self) -> f64 {
        self.rows.iter().flat_map(|row| &row.mass).sum()
    }
}
