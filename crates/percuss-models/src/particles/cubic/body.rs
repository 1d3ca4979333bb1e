//! A body of particles on layers of a body-centred cubic lattice.

use super::{
    super::{fracture::Softening, packing::Moved},
    lattice::{Cubic, KINDS, VECTORS, relative, sharing},
};
use crate::{Error, solver::Control};

/// Weight of a bond in a face over that of the half that is inside: it also stands for the springs across the face, of which the outer ends are missing.
const IN_FACE: f64 = 5.0 / 3.0;

/// A body.
#[derive(Debug, Clone)]
pub(in super::super) struct CubicBody {
    pub(in super::super) lattice: Cubic,
    /// Position of the first particle of an even layer [m].
    pub(super) origin: [f64; 3],
    pub(super) grid: Grid,
    /// Column and row of every place.
    columns_and_rows: Vec<[f64; 2]>,
    pub(in super::super) layers: Vec<Layer>,
    pub(in super::super) state: Vec<Vector>,
    pub(in super::super) motion: Vec<Vector>,
    /// Displacements after the step that is computed.
    pub(super) next: Vec<Vector>,
    /// Bonds now.
    pub(in super::super) bonds: Vec<Bonds>,
    /// What the volume of each particle adds to the pull of its bonds [N/m], in layers.
    pub(super) swelling: Vec<Vec<f64>>,
    /// The same after the step that is computed.
    pub(super) next_swelling: Vec<Vec<f64>>,
    pub(in super::super) damage: Vec<Damage>,
    /// Layer, place and axis of what cannot move, in order.
    pub(in super::super) held: Vec<(usize, usize, usize)>,
    /// Volume of all tetrahedra [m3].
    pub(in super::super) volume: f64,
    /// How bonds fail, if they do: to nearest neighbours, and to second ones.
    pub(in super::super) softening: Option<[Softening; 2]>,
}

/// Shape of the layers of a body. Every one has a place without a particle on all its sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) struct Grid {
    pub(in super::super) layers: usize,
    /// Particles along a row of an even layer; an odd one has one less.
    pub(in super::super) columns: usize,
    /// Rows of an even layer; an odd one has one less.
    pub(in super::super) rows: usize,
}

/// A vector at every place of a layer.
pub(in super::super) type Vector = [Vec<f64>; 3];

/// What a layer is made of.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct Layer {
    /// Masses [kg]; 0 where there is no particle.
    pub(super) mass: Vec<f64>,
    pub(super) inverse_mass: Vec<f64>,
    /// Weights of the bonds that start in the layer: the part of their tetrahedra that is there, by volume.
    pub(in super::super) weights: [Vec<f64>; KINDS],
    /// Pull of a bond per sum of weighted elongations [N/m2 per m2]: stiffness of the volume of each particle.
    pub(super) swell: Vec<f64>,
    /// Lengths of the bonds at rest [m], where particles are moved; otherwise empty.
    pub(super) rests: [Vec<f64>; KINDS],
    /// How far particles are moved from their places on the lattice [m]; otherwise empty.
    pub(super) shift: Vector,
}

/// Bonds that start in a layer.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct Bonds {
    /// Elongations [m].
    pub(super) elongation: [Vec<f64>; KINDS],
    /// First what each adds to the change of volume of its ends [m2], then its force over its length [N/m].
    pub(super) pull: [Vec<f64>; KINDS],
}

/// Damage of the bonds that start in a layer; without places where nothing breaks.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(in super::super) struct Damage {
    /// Their largest elongations, in those at which they start to soften.
    pub(super) worst: [Vec<f64>; KINDS],
    /// Energy that their softening has taken [J].
    pub(super) lost: f64,
    /// Bonds that soften in this step.
    #[serde(skip)]
    pub(super) changes: Vec<Change>,
}

/// A bond that softens in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in super::super) struct Change {
    pub(super) kind: usize,
    pub(super) place: usize,
    /// Its damage after the step less that before.
    pub(in super::super) damage: f64,
    /// Elongations before and after [m].
    pub(super) elongations: [f64; 2],
    /// Sum of the swelling of its ends before [N/m].
    pub(super) swelling: f64,
}

impl Grid {
    /// Places from one row of a layer to the next.
    pub(super) fn stride(&self) -> usize {
        self.columns + 2
    }

    /// Places of a layer.
    pub(super) fn places(&self) -> usize {
        (self.rows + 2) * self.stride()
    }

    /// Place of the second particle of a bond less that of the first, and layers between them.
    #[inline(always)]
    pub(super) fn offset(&self, kind: usize, layer: usize) -> (isize, usize) {
        let (stride, odd) = (self.stride() as isize, (layer % 2) as isize);
        let on_next = odd * (stride + 1);
        match kind {
            0 => (1, 0),
            1 => (stride, 0),
            2 => (0, 2),
            3 => (on_next - stride - 1, 1),
            4 => (on_next - stride, 1),
            5 => (on_next - 1, 1),
            _ => (on_next, 1),
        }
    }

    /// Layer and place at half sides from the first particle, if the grid has one there.
    fn at(&self, [x, y, z]: [i64; 3]) -> Option<(usize, usize)> {
        let layer = usize::try_from(z).ok().filter(|z| *z < self.layers)?;
        let odd = (layer % 2) as i64;
        let less = layer % 2;
        let along = |half: i64, most: usize| {
            let number = usize::try_from((half - odd).div_euclid(2)).ok()?;
            (number < most - less).then_some(number)
        };
        let (column, row) = (along(x, self.columns)?, along(y, self.rows)?);
        Some((layer, (row + 1) * self.stride() + column + 1))
    }

    /// Column and row of a place.
    pub(super) fn column_and_row(&self, place: usize) -> [f64; 2] {
        let stride = self.stride();
        [place % stride, place / stride].map(|number| number as f64 - 1.0)
    }
}

/// The bond between two neighbours, half sides from the first particle: which of them it starts at, and its kind.
fn bond_between(a: [i64; 3], b: [i64; 3]) -> ([i64; 3], usize) {
    let way = [0, 1, 2].map(|axis| b[axis] - a[axis]);
    let found = |way: [i64; 3]| {
        let is = |vector: &[f64; 3]| vector.map(|part| (2.0 * part) as i64) == way;
        VECTORS.iter().position(is)
    };
    match found(way) {
        Some(kind) => (a, kind),
        None => (b, found(way.map(|part| -part)).unwrap_or(0)),
    }
}

impl CubicBody {
    /// A body of the tetrahedra of the lattice that are inside. Of one with a corner outside the half before the missing corner counts: a plane face along
    /// a layer of particles is where it should be.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub(in super::super) fn of_particles(
        lattice: Cubic,
        grid: Grid,
        depth: f64,
        moved: Option<Moved>,
        is_there: impl Fn([f64; 3]) -> bool,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        let places = grid.places();
        let zeros = || vec![0.0; places];
        let vector = || [zeros(), zeros(), zeros()];
        let kinds = || [(); KINDS].map(|()| zeros());
        let half = |count: usize| -0.5 * (count as f64 - 1.0) * lattice.side;
        let mut body = Self {
            lattice,
            origin: [half(grid.columns), half(grid.rows), depth],
            grid,
            columns_and_rows: (0..places)
                .map(|place| grid.column_and_row(place))
                .collect(),
            layers: Vec::new(),
            state: Vec::new(),
            motion: Vec::new(),
            next: Vec::new(),
            bonds: Vec::new(),
            swelling: Vec::new(),
            next_swelling: Vec::new(),
            damage: Vec::new(),
            held: Vec::new(),
            volume: 0.0,
            softening: None,
        };
        control.set_up(0..grid.layers, 20 * places, |_| {
            body.layers.push(Layer {
                mass: zeros(),
                inverse_mass: zeros(),
                weights: kinds(),
                swell: zeros(),
                ..Layer::default()
            });
            for vectors in [&mut body.state, &mut body.motion, &mut body.next] {
                vectors.push(vector());
            }
            body.bonds.push(Bonds {
                elongation: kinds(),
                pull: kinds(),
            });
            body.swelling.push(zeros());
            body.next_swelling.push(zeros());
            body.damage.push(Damage::default());
        })?;
        if let Some(moved) = moved {
            control.set_up(0..grid.layers, places, |layer| body.shift(layer, moved))?;
        }
        let corner = |half: [i64; 3]| {
            let at = grid.at(half)?;
            is_there(body.place_of(half)).then_some(at)
        };
        let there: Vec<Vec<bool>> = (0..grid.layers)
            .map(|layer| {
                let mut there = vec![false; places];
                for (half, place) in halves(grid, layer) {
                    there[place] = corner(half).is_some();
                }
                there
            })
            .collect();
        let is_corner = |half: [i64; 3]| grid.at(half).filter(|&(layer, at)| there[layer][at]);
        control.set_up(0..grid.layers, places, |layer| {
            // Edges also start before the first particle of an odd layer.
            for row in 0..=grid.rows {
                for column in 0..=grid.columns {
                    let [x, y] = [column, row].map(|i| (2 * i + layer % 2) as i64 - 2);
                    body.add_tetrahedra([x, y, layer as i64], &is_corner);
                }
            }
        })?;
        control.set_up(0..grid.layers, places, |layer| body.finish(layer))?;
        body.refresh();
        Ok(body)
    }

    /// Lattice place at half sides from the first particle [m].
    fn place_of(&self, half: [i64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.origin[axis] + 0.5 * self.lattice.side * half[axis] as f64)
    }

    /// Moves the particles of a layer at random: on the faces along them, at the sides not at all.
    fn shift(&mut self, layer: usize, moved: Moved) {
        let mut shift = [(); 3].map(|()| vec![0.0; self.grid.places()]);
        let is_face = layer == 0 || layer + 1 == self.grid.layers;
        for (half, place) in halves(self.grid, layer) {
            let far = [self.grid.columns, self.grid.rows].map(|count| 2 * count as i64 - 2);
            if half[0] <= 0 || half[1] <= 0 || half[0] >= far[0] || half[1] >= far[1] {
                continue;
            }
            let draw = moved.draw_in_space((layer * self.grid.places() + place) as u64);
            for axis in 0..if is_face { 2 } else { 3 } {
                shift[axis][place] = self.lattice.spacing() * draw[axis];
            }
        }
        self.layers[layer].shift = shift;
    }

    /// The six tetrahedra of a particle: two long edges across each other, of which one along an earlier axis starts at it.
    fn add_tetrahedra(
        &mut self,
        start: [i64; 3],
        at: &impl Fn([i64; 3]) -> Option<(usize, usize)>,
    ) {
        for (along, across) in [(0, 1), (0, 2), (1, 2)] {
            let third = 3 - along - across;
            for side in [-1, 1] {
                let (mut end, mut low) = (start, start);
                end[along] += 2;
                low[along] += 1;
                low[across] -= 1;
                low[third] += side;
                let mut high = low;
                high[across] += 2;
                self.add_tetrahedron([start, end, low, high], at);
            }
        }
    }

    /// A tetrahedron of two opposite edges.
    fn add_tetrahedron(
        &mut self,
        corners: [[i64; 3]; 4],
        at: &impl Fn([i64; 3]) -> Option<(usize, usize)>,
    ) {
        let found = corners.map(at);
        let missing: Vec<usize> = (0..4).filter(|&i| found[i].is_none()).collect();
        let mut points = [[0.0; 3]; 4];
        for i in 0..4 {
            points[i] = match found[i] {
                Some((layer, place)) => self.rest_place(layer, place),
                None => self.place_of(corners[i]),
            };
        }
        // The particle that takes the mass of each corner.
        let mut owner = [0, 1, 2, 3];
        match missing[..] {
            [] => {}
            [gone] => {
                let other = gone ^ 1;
                let lattice = [gone, other].map(|i| self.place_of(corners[i]));
                points[gone] = [0, 1, 2].map(|axis| 0.5 * (lattice[0][axis] + lattice[1][axis]));
                owner[gone] = other;
            }
            _ => return,
        }
        let volume = volume_of(points);
        self.volume += volume;
        for i in owner {
            if let Some((layer, place)) = found[i] {
                self.layers[layer].mass[place] += 0.25 * self.lattice.density * volume;
            }
        }
        let whole = self.lattice.side.powi(3) / 12.0;
        for a in 0..4 {
            for b in a + 1..4 {
                let (Some(_), Some(_)) = (found[a], found[b]) else {
                    continue;
                };
                let (start, kind) = bond_between(corners[a], corners[b]);
                let rest: f64 = (0..3).map(|i| (points[b][i] - points[a][i]).powi(2)).sum();
                let on_lattice: f64 = self.lattice.vector(kind).iter().map(|v| v * v).sum();
                // The face halves the edge that is in it, not those that end at it.
                let part = match (missing.is_empty(), kind < 3) {
                    (true, _) => volume,
                    (false, true) => IN_FACE * volume,
                    (false, false) => 2.0 * volume,
                };
                if let Some((layer, place)) = self.grid.at(start) {
                    self.layers[layer].weights[kind][place] +=
                        part / whole / sharing(kind) * on_lattice / rest;
                }
            }
        }
    }

    /// Masses, lengths of bonds and stiffnesses of the volumes of a layer, of weights that are known.
    fn finish(&mut self, layer: usize) {
        let is_moved = self.is_moved();
        let places = self.grid.places();
        if is_moved {
            let rests = [0, 1, 2, 3, 4, 5, 6].map(|kind| {
                let of = |place| self.measured(layer, place, kind);
                (0..places).map(of).collect()
            });
            self.layers[layer].rests = rests;
        }
        for place in 0..places {
            let mass = self.layers[layer].mass[place];
            if mass == 0.0 {
                continue;
            }
            let of = |(layer, place, kind): (usize, usize, usize)| {
                let rest = self.measured(layer, place, kind);
                self.layers[layer].weights[kind][place] * relative(kind) * rest * rest
            };
            let size: f64 = self.around(layer, place).map(of).sum();
            let volume = mass / self.lattice.density;
            let made = &mut self.layers[layer];
            made.inverse_mass[place] = 1.0 / mass;
            made.swell[place] = self.lattice.bulk * volume * (3.0 / size).powi(2);
        }
    }

    /// Length of a bond at rest [m].
    pub(super) fn measured(&self, layer: usize, place: usize, kind: usize) -> f64 {
        let vector = self.lattice.vector(kind);
        let (other_layer, other) = self.end_of(layer, place, kind);
        let square = |vector: [f64; 3]| vector.iter().map(|part| part * part).sum::<f64>();
        if !self.is_moved() || other_layer >= self.layers.len() || other >= self.grid.places() {
            return square(vector).sqrt();
        }
        let [from, to] = [(layer, place), (other_layer, other)]
            .map(|(layer, place)| self.layers[layer].shift.each_ref().map(|s| s[place]));
        square([0, 1, 2].map(|axis| vector[axis] + (to[axis] - from[axis]))).sqrt()
    }

    pub(super) fn is_moved(&self) -> bool {
        !self.layers[0].shift[0].is_empty()
    }

    /// Second particle of a bond.
    pub(super) fn end_of(&self, layer: usize, place: usize, kind: usize) -> (usize, usize) {
        let (offset, on) = self.grid.offset(kind, layer);
        (layer + on, place.saturating_add_signed(offset))
    }

    /// The bonds of a particle, those that end at it included.
    pub(super) fn around(
        &self,
        layer: usize,
        place: usize,
    ) -> impl Iterator<Item = (usize, usize, usize)> {
        let own = (0..KINDS).map(move |kind| (layer, place, kind));
        let before = (0..KINDS).filter_map(move |kind| {
            let (_, on) = self.grid.offset(kind, layer);
            let first = layer.checked_sub(on)?;
            let (offset, _) = self.grid.offset(kind, first);
            Some((first, place.saturating_add_signed(-offset), kind))
        });
        own.chain(before)
    }

    /// Position of a particle before the impact [m].
    pub(super) fn rest_place(&self, layer: usize, place: usize) -> [f64; 3] {
        let [column, row] = self.columns_and_rows[place];
        let odd = 0.5 * (layer % 2) as f64;
        let side = self.lattice.side;
        let on_lattice = [
            self.origin[0] + (column + odd) * side,
            self.origin[1] + (row + odd) * side,
            self.origin[2] + 0.5 * layer as f64 * side,
        ];
        match self.is_moved() {
            true => {
                let shift = &self.layers[layer].shift;
                [0, 1, 2].map(|axis| on_lattice[axis] + shift[axis][place])
            }
            false => on_lattice,
        }
    }

    /// Width across the direction of impact [m].
    pub(in super::super) fn width(&self) -> f64 {
        (self.grid.columns as f64 - 1.0) * self.lattice.side
    }

    /// Lets bonds fail.
    pub(in super::super) fn soften(&mut self, softening: [Softening; 2]) {
        self.softening = Some(softening);
        for damage in &mut self.damage {
            damage.worst = [(); KINDS].map(|()| vec![0.0; self.grid.places()]);
        }
        self.refresh();
    }

    /// Holds the particles of the last layer along the normal of the struck face.
    pub(in super::super) fn hold_rear(&mut self) {
        let last = self.layers.len() - 1;
        let masses = self.layers[last].mass.iter().enumerate();
        let held = masses.filter(|(_, mass)| **mass > 0.0);
        self.held = held.map(|(place, _)| (last, place, 2)).collect();
    }

    /// Gives all particles a velocity along the normal of the struck face [m/s].
    pub(in super::super) fn launch(&mut self, velocity: f64) {
        for (layer, motion) in self.layers.iter().zip(&mut self.motion) {
            for (speed, mass) in motion[2].iter_mut().zip(&layer.mass) {
                *speed = if *mass > 0.0 { velocity } else { 0.0 };
            }
        }
    }
}

/// Places of a layer that can have particles, each with its half sides from the first particle.
fn halves(grid: Grid, layer: usize) -> impl Iterator<Item = ([i64; 3], usize)> {
    let odd = layer % 2;
    (0..grid.rows - odd).flat_map(move |row| {
        (0..grid.columns - odd).map(move |column| {
            let half = [2 * column + odd, 2 * row + odd, layer].map(|number| number as i64);
            (half, (row + 1) * grid.stride() + column + 1)
        })
    })
}

/// Volume of a tetrahedron [m3].
fn volume_of([a, b, c, d]: [[f64; 3]; 4]) -> f64 {
    let from = |p: [f64; 3]| [0, 1, 2].map(|axis| p[axis] - a[axis]);
    let [b, c, d] = [from(b), from(c), from(d)];
    let cross = [
        c[1] * d[2] - c[2] * d[1],
        c[2] * d[0] - c[0] * d[2],
        c[0] * d[1] - c[1] * d[0],
    ];
    (b[0] * cross[0] + b[1] * cross[1] + b[2] * cross[2]).abs() / 6.0
}
