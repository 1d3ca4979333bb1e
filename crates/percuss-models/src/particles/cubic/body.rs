//! A body of particles on layers of a body-centred cubic lattice.

use super::{
    super::{fracture::Softening, packing::Moved},
    grid::{Grid, halves},
    lattice::{Cubic, KINDS, relative},
};
use crate::{Error, solver::Control};

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
    pub(super) volume_pull: Vec<Vec<f64>>,
    /// The same after the step that is computed.
    pub(super) next_volume_pull: Vec<Vec<f64>>,
    pub(in super::super) damage: Vec<Damage>,
    /// Layer, place and axis of what cannot move, in order.
    pub(in super::super) held: Vec<(usize, usize, usize)>,
    /// Volume of all tetrahedra [m3].
    pub(in super::super) volume: f64,
    /// How bonds fail, if they do: to nearest neighbours, and to second ones.
    pub(in super::super) softening: Option<[Softening; 2]>,
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
    /// Stiffness of the volume of each particle: its pull over the sum of the weighted elongations of its bonds [N/m3].
    pub(super) volume_stiffness: Vec<f64>,
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
    /// First what each adds to the dilatation of its ends [m2], then its force over its length [N/m].
    pub(super) pull: [Vec<f64>; KINDS],
}

/// Damage of the bonds that start in a layer; without places where nothing breaks.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(in super::super) struct Damage {
    /// Their largest elongations, in those at which they start to soften.
    pub(in super::super) worst: [Vec<f64>; KINDS],
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
    /// Sum of the pulls of the volumes of its ends before [N/m].
    pub(super) volume_pull: f64,
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
            volume_pull: Vec::new(),
            next_volume_pull: Vec::new(),
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
                volume_stiffness: zeros(),
                ..Layer::default()
            });
            for vectors in [&mut body.state, &mut body.motion, &mut body.next] {
                vectors.push(vector());
            }
            body.bonds.push(Bonds {
                elongation: kinds(),
                pull: kinds(),
            });
            body.volume_pull.push(zeros());
            body.next_volume_pull.push(zeros());
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
    pub(super) fn place_of(&self, half: [i64; 3]) -> [f64; 3] {
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
            made.volume_stiffness[place] = self.lattice.bulk * volume * (3.0 / size).powi(2);
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
