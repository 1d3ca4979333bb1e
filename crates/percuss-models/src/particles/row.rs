//! A row of particles: state, motion, masses and bonds at rest.

use serde::{Deserialize, Serialize};

/// Displacements [m] and rotations of a row. A place before the first particle and places behind the last one stay at rest.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct RowState {
    pub(super) x: Vec<f64>,
    pub(super) z: Vec<f64>,
    /// Cosine of the rotation.
    pub(super) cosine: Vec<f64>,
    /// Its sine.
    pub(super) sine: Vec<f64>,
    /// Damage of the bonds that start in the row; empty where nothing breaks.
    #[serde(default)]
    pub(super) damage: Damage,
    /// Sums of the products of forces and bonds of each particle a step ago, `xx`, `zz` and `xz` [N m per m]; empty where no
    /// bond fails by its stress.
    #[serde(default)]
    pub(super) virial: [Vec<f64>; 3],
    /// Energy that their softening has taken [J per m].
    #[serde(default)]
    pub(super) lost: f64,
}

impl RowState {
    /// Displacements, and cosines and sines of the rotations.
    pub(super) fn place(&self) -> [Vec<f64>; 4] {
        [&self.x, &self.z, &self.cosine, &self.sine].map(Vec::clone)
    }

    /// A row with the displacements alone.
    pub(super) fn displacements(&self) -> Self {
        Self {
            x: self.x.clone(),
            z: self.z.clone(),
            ..Self::default()
        }
    }

    /// Takes over what forces on other rows follow from.
    pub(super) fn copy_for_forces(&mut self, other: &Self) {
        self.x.clone_from(&other.x);
        self.z.clone_from(&other.z);
        self.cosine.clone_from(&other.cosine);
        self.sine.clone_from(&other.sine);
        for kind in 0..3 {
            self.damage.worst[kind].clone_from(&other.damage.worst[kind]);
            self.damage.start[kind].clone_from(&other.damage.start[kind]);
            self.virial[kind].clone_from(&other.virial[kind]);
        }
    }
}

/// Rows before and behind those that a task changes, as they are before the step.
#[derive(Debug, Clone, Default)]
pub(super) struct Halo {
    pub(super) before: Vec<RowState>,
    pub(super) behind: Vec<RowState>,
}

/// States of rows before a step: those of a task that it has not changed yet, and copies around them.
#[derive(Debug, Clone, Copy)]
pub(super) struct States<'a> {
    /// Number of the first own row.
    first: usize,
    own: &'a [RowState],
    before: &'a [RowState],
    behind: &'a [RowState],
}

impl<'a> States<'a> {
    /// Those of a whole body.
    pub(super) fn whole(own: &'a [RowState]) -> Self {
        Self {
            first: 0,
            own,
            before: &[],
            behind: &[],
        }
    }

    /// Those of a task that starts at a row.
    pub(super) fn around(first: usize, own: &'a [RowState], halo: &'a Halo) -> Self {
        Self {
            first,
            own,
            before: &halo.before,
            behind: &halo.behind,
        }
    }

    /// A row, if there is one.
    #[inline(always)]
    pub(super) fn get(&self, row: usize) -> Option<&'a RowState> {
        match row.checked_sub(self.first) {
            None => self
                .before
                .get((self.before.len() + row).checked_sub(self.first)?),
            Some(index) => match index.checked_sub(self.own.len()) {
                None => self.own.get(index),
                Some(index) => self.behind.get(index),
            },
        }
    }
}

/// Damage of the three kinds of bonds that start in a row.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Damage {
    /// Their largest elongations, in those at which they start to soften.
    pub(super) worst: [Vec<f64>; 3],
    /// Their deformation a step ago, in the same unit.
    pub(super) measure: [Vec<f64>; 3],
    /// Their deformation when they started to soften by their stress, in the same unit, and 0 before; empty where they do not.
    pub(super) start: [Vec<f64>; 3],
}

impl Damage {
    /// Whole bonds of a row of a number of places.
    pub(super) fn new(places: usize, by_stress: bool) -> Self {
        let zeros = || [0, 1, 2].map(|_| vec![0.0; places]);
        let none = <[Vec<f64>; 3]>::default;
        Self {
            worst: zeros(),
            measure: zeros(),
            start: if by_stress { zeros() } else { none() },
        }
    }

    /// Deformation at which a bond starts to soften; by its stress 0 before it did.
    pub(super) fn start_of(&self, kind: usize, place: usize) -> f64 {
        self.start[kind].get(place).copied().unwrap_or(1.0)
    }
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
    /// One over the mass of a particle and its neighbours [m/kg]; empty where no bond fails by its stress.
    pub(super) inverse_mass_around: Vec<f64>,
    /// Weights of the bonds that start in the row: half the number of triangles that share a bond, or what their dual facets are.
    pub(super) weights: [Vec<f64>; 3],
    /// The bonds at rest, where particles are moved; otherwise empty.
    pub(super) rests: [Rests; 3],
    /// How far particles are moved from their places on the lattice [m]; otherwise empty.
    pub(super) shift: [Vec<f64>; 2],
}

/// Bonds of a row at rest.
#[derive(Debug, Clone, Default)]
pub(super) struct Rests {
    /// Directions to their second particles.
    pub(super) x: Vec<f64>,
    pub(super) z: Vec<f64>,
    /// Lengths [m].
    pub(super) length: Vec<f64>,
}

impl RowMake {
    /// Whether its particles stand beside the places of the lattice.
    #[inline(always)]
    pub(super) fn is_moved(&self) -> bool {
        !self.shift[0].is_empty()
    }
}
