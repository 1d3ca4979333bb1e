//! Interface of a material law to the grid.

use std::fmt;

use serde::{Serialize, de::DeserializeOwned};

/// How a cell moves in the middle of a step.
#[derive(Debug, Clone, Copy)]
pub(in crate::fdm) struct Motion {
    /// Length in the middle of the step [m].
    pub(in crate::fdm) length: f64,
    /// Speed at which the faces approach at the start of the step [m/s].
    pub(in crate::fdm) approach: f64,
    /// Time since the middle of the step before [s].
    pub(in crate::fdm) since_load: f64,
    /// Time step [s].
    pub(in crate::fdm) time_step: f64,
}

/// Energy of a cell [J].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::fdm) struct Stored {
    pub(in crate::fdm) elastic: f64,
    pub(in crate::fdm) plastic: f64,
    pub(in crate::fdm) viscous: f64,
}

/// What histories and results show of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fdm) struct View {
    pub(in crate::fdm) initial_position: f64,
    pub(in crate::fdm) stress: f64,
    pub(in crate::fdm) strain: f64,
    pub(in crate::fdm) plastic_strain: f64,
    /// Largest plastic strain rate so far [1/s].
    pub(in crate::fdm) strain_rate: f64,
    pub(in crate::fdm) temperature: f64,
    /// Current diameter [m].
    pub(in crate::fdm) diameter: f64,
}

/// Law of one body: how its cells answer to their change of length.
pub(in crate::fdm) trait Law: fmt::Debug {
    /// State of a cell.
    type Cell: Copy + fmt::Debug + Serialize + DeserializeOwned;

    /// Whether the stored energy is made up from the loads before and after a time, rather than kept by the work done.
    const STORED_ACROSS_STEPS: bool;

    /// A cell at rest between two faces.
    fn cell(&self, back: f64, front: f64) -> Self::Cell;

    /// Brings the stress to the middle of the step.
    fn load(&self, cell: &mut Self::Cell, motion: Motion);

    /// Does it with the cells of these numbers.
    fn load_all(&self, cells: &mut [Self::Cell], moving: &[(usize, Motion)]) {
        for (i, motion) in moving {
            self.load(&mut cells[*i], *motion);
        }
    }

    /// Axial force of a loaded cell, viscosity included [N].
    fn force(&self, cell: &Self::Cell) -> f64;

    /// Completes the step at its new length, shorter by `shortening` [m]; false when the law does not reach so far.
    fn finish(&self, cell: &mut Self::Cell, length: f64, shortening: f64) -> bool;

    /// Largest stable time step [s].
    fn stable_step(&self, cell: &Self::Cell, length: f64, approach: f64) -> f64;

    /// Whether the stable time step is certain to be longer than a step [s], by less work than it takes to find it.
    fn allows(&self, _cell: &Self::Cell, _length: f64, _step: f64) -> bool {
        false
    }

    /// Energy at the start of the step in whose middle the cell was loaded.
    fn stored(&self, cell: &Self::Cell) -> Stored;

    /// What histories show.
    fn view(&self, cell: &Self::Cell) -> View;

    /// Whether loading the cell at an unchanged length would change nothing.
    fn is_settled(&self, cell: &Self::Cell) -> bool;

    /// Tensile stress at which the material spalls [Pa].
    fn spall_strength(&self) -> Option<f64> {
        None
    }

    /// Axial stress of a loaded cell without viscosity [Pa].
    fn axial_stress(&self, cell: &Self::Cell) -> f64;
}
