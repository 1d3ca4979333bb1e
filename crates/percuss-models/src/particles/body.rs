//! A body of particles on rows of a hexagonal lattice.

use std::ops::Range;

use super::{
    bonded::Bonded,
    fracture::Softening,
    lattice::{DIRECTIONS, Lattice, ROW},
    packing::{Packing, facet_weight},
    row::{Damage, Halo, Rests, RowMake, RowMotion, RowState},
    slot::Slot,
};
use crate::{Error, solver::Control};

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
    /// Copies of rows around those of each task, for the step that is computed.
    pub(super) halos: Vec<Halo>,
    /// Row and places of the particles that cannot move along the normal of the struck face, if any.
    pub(super) held: Option<(usize, Range<usize>)>,
    /// Area of all triangles [m2].
    pub(super) area: f64,
    /// How bonds fail, if they do.
    pub(super) softening: Option<Softening>,
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
    #[cfg(test)]
    /// A strip of rows along the struck face, symmetric about `x = 0` but for its packing, with its first row at a depth [m].
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn strip(
        lattice: Lattice,
        rows: Rows,
        depth: f64,
        packing: Packing,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        Self::slotted_strip(lattice, rows, depth, packing, &[], control)
    }

    /// A strip of rows along the struck face, symmetric about `x = 0` but for its packing and slots, with its first row at a depth [m].
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn slotted_strip(
        lattice: Lattice,
        rows: Rows,
        depth: f64,
        packing: Packing,
        slots: &[Slot],
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        let middle = 0.5 * (rows.particles as f64 - 1.0);
        let is_there = |row: usize, column: usize| {
            let across = (column as f64 + 0.5 * (row % 2) as f64 - middle) * lattice.spacing;
            let along = depth + row as f64 * ROW * lattice.spacing;
            let in_slot = slots.iter().any(|slot| slot.holds([across, along]));
            column < rows.particles - row % 2 && !in_slot
        };
        Self::of_particles(lattice, rows, depth, packing, is_there, control)
    }

    /// A disc of the diameter of all rows, which touches the struck face.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn disc(
        lattice: Lattice,
        rows: Rows,
        packing: Packing,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        let radius = 0.5 * (rows.count as f64 - 1.0) * ROW * lattice.spacing;
        let middle = 0.5 * (rows.particles as f64 - 1.0);
        let is_there = |row: usize, column: usize| {
            let across = (column as f64 + 0.5 * (row % 2) as f64 - middle) * lattice.spacing;
            let along = row as f64 * ROW * lattice.spacing - radius;
            let is_inside = across * across + along * along <= radius * radius * (1.0 + 1e-9);
            is_inside && column < rows.particles - row % 2
        };
        let mut disc = Self::of_particles(lattice, rows, 0.0, packing, is_there, control)?;
        // A particle alone at the rim belongs to no triangle: the first row that is there touches.
        let top = disc
            .particles()
            .map(|(row, place)| disc.rest_place(row, place)[1]);
        disc.origin[1] = -top.fold(f64::INFINITY, f64::min).min(radius);
        Ok(disc)
    }

    /// A body of the triangles of which all three particles are there.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn of_particles(
        lattice: Lattice,
        rows: Rows,
        depth: f64,
        packing: Packing,
        is_there: impl Fn(usize, usize) -> bool,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        let stride = stride(rows.particles);
        let zeros = || vec![0.0; stride];
        let (mut made, mut state, mut motion) = (Vec::new(), Vec::new(), Vec::new());
        control.set_up(0..rows.count, stride, |_| {
            made.push(RowMake {
                mass: zeros(),
                inverse_mass: zeros(),
                inverse_inertia: zeros(),
                weights: [zeros(), zeros(), zeros()],
                ..RowMake::default()
            });
            state.push(RowState {
                x: zeros(),
                z: zeros(),
                cosine: vec![1.0; stride],
                sine: zeros(),
                damage: Damage::default(),
                virial: <[Vec<f64>; 3]>::default(),
                lost: 0.0,
            });
            motion.push(RowMotion {
                x: zeros(),
                z: zeros(),
                spin: zeros(),
            });
        })?;
        let mut body = Self {
            lattice,
            origin: [
                -0.5 * (rows.particles as f64 - 1.0) * lattice.spacing,
                depth,
            ],
            stride,
            rows: made,
            state,
            motion,
            halos: Vec::new(),
            held: None,
            area: 0.0,
            softening: None,
        };
        let at = |row: usize, place: usize| {
            (1..=rows.particles).contains(&place) && is_there(row, place - 1)
        };
        if let Packing::Irregular(moved) = packing {
            let spacing = lattice.spacing;
            control.set_up(0..rows.count, stride, |row| {
                let of = |place: usize| match at(row, place) {
                    true => moved.shift(spacing, rows, (row, place - 1)),
                    false => [0.0; 2],
                };
                let shifts: Vec<[f64; 2]> = (0..stride).map(of).collect();
                body.rows[row].shift = [0, 1].map(|axis| shifts.iter().map(|s| s[axis]).collect());
            })?;
            control.set_up(0..rows.count, stride, |row| body.measure_bonds(row))?;
        }
        control.set_up(0..rows.count.saturating_sub(1), stride, |row| {
            for place in 1..stride - 1 {
                body.add_triangles(row, place, &at);
            }
        })?;
        body.finish();
        Ok(body)
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
        let spacing = self.lattice.spacing;
        let of_lattice = 0.5 * ROW * spacing * spacing;
        let is_moved = self.rows[0].is_moved();
        let area = match is_moved {
            true => self.triangle_area(corners),
            false => of_lattice,
        };
        // A particle inside has six triangles, and its mass is that of two.
        let share = self.lattice.mass / 6.0 * (area / of_lattice);
        for (row, place) in corners {
            self.rows[row].mass[place] += share;
        }
        for (row, place, kind) in bonds {
            let make = &mut self.rows[row];
            make.weights[kind][place] += match is_moved {
                true => facet_weight(area, make.rests[kind].length[place]),
                false => 0.5,
            };
        }
        self.area += area;
    }

    fn triangle_area(&self, corners: [(usize, usize); 3]) -> f64 {
        let [a, b, c] = corners.map(|(row, place)| self.rest_place(row, place));
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
    }

    /// Directions and lengths of the bonds of a row between moved particles.
    fn measure_bonds(&mut self, row: usize) {
        let rests = [0, 1, 2].map(|kind| {
            let mut rests = Rests::default();
            for place in 0..self.stride {
                let (direction, length) = self.measured(row, place, kind);
                rests.x.push(direction[0]);
                rests.z.push(direction[1]);
                rests.length.push(length);
            }
            rests
        });
        self.rows[row].rests = rests;
    }

    fn measured(&self, row: usize, place: usize, kind: usize) -> ([f64; 2], f64) {
        let (other_row, other) = self.end_of(row, place, kind);
        let spacing = self.lattice.spacing;
        if other_row >= self.rows.len() || other >= self.stride {
            return (DIRECTIONS[kind], spacing);
        }
        let shift = |row: usize, place: usize| self.rows[row].shift.each_ref().map(|s| s[place]);
        let (from, to) = (shift(row, place), shift(other_row, other));
        let [x, z] = [0, 1].map(|axis| spacing * DIRECTIONS[kind][axis] + (to[axis] - from[axis]));
        let length = (x * x + z * z).sqrt();
        ([x / length, z / length], length)
    }

    /// Lets bonds fail.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(super) fn soften(
        &mut self,
        softening: Softening,
        control: &mut Control<'_>,
    ) -> Result<(), Error> {
        self.softening = Some(softening);
        let by_stress = softening.by_stress;
        for row in (0..self.rows.len()).filter(|_| by_stress) {
            let mut around = vec![0.0; self.stride];
            let masses = |row: usize| self.rows[row].mass.as_slice();
            self.add_neighbours(row, masses, &mut around);
            let inverse = |mass: f64| if mass > 0.0 { 1.0 / mass } else { 0.0 };
            self.rows[row].inverse_mass_around = around.into_iter().map(inverse).collect();
        }
        let stride = self.stride;
        control.set_up(&mut self.state, stride, |state| {
            state.damage = Damage::new(stride, by_stress);
            if by_stress {
                state.virial = [0, 1, 2].map(|_| vec![0.0; stride]);
            }
        })
    }

    /// Holds the last row that has particles, as far as a distance from the axis [m].
    pub(super) fn hold_rear(&mut self, half_width: f64) {
        let has_particles = |row: &usize| self.rows[*row].mass.iter().any(|mass| *mass > 0.0);
        let Some(row) = (0..self.rows.len()).rev().find(has_particles) else {
            return;
        };
        let inside = |place: &usize| self.rest_place(row, *place)[0].abs() <= half_width;
        let mut places = (1..self.stride - 1).filter(inside);
        if let Some(first) = places.next() {
            let last = places.next_back().unwrap_or(first);
            self.held = Some((row, first..last + 1));
        }
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
    pub(super) fn rest_place(&self, row: usize, place: usize) -> [f64; 2] {
        let column = place as f64 - 1.0 + 0.5 * (row % 2) as f64;
        let spacing = self.lattice.spacing;
        let make = &self.rows[row];
        let [across, along] = match make.is_moved() {
            true => [make.shift[0][place], make.shift[1][place]],
            false => [0.0; 2],
        };
        [
            self.origin[0] + column * spacing + across,
            self.origin[1] + row as f64 * ROW * spacing + along,
        ]
    }

    /// Gives all particles a velocity along the normal of the struck face [m/s].
    pub(super) fn launch(&mut self, velocity: f64) {
        for (row, motion) in self.rows.iter().zip(&mut self.motion) {
            for (speed, mass) in motion.z.iter_mut().zip(&row.mass) {
                if *mass > 0.0 {
                    *speed = velocity;
                }
            }
        }
    }
}
