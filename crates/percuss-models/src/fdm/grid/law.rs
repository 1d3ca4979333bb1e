//! Interface of a material law to the grid.

use std::{fmt, ops::Range};

use serde::{Serialize, de::DeserializeOwned};

use super::limited;

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

/// How all cells move in the middle of a step; lists go on to a multiple of eight.
#[derive(Debug, Clone, Copy)]
pub(in crate::fdm) struct Motions<'a> {
    pub(in crate::fdm) lengths: &'a [f64],
    pub(in crate::fdm) approaches: &'a [f64],
    pub(in crate::fdm) since_load: f64,
    pub(in crate::fdm) time_step: f64,
}

impl Motions<'_> {
    /// How one cell moves.
    pub(in crate::fdm) fn of(&self, cell: usize) -> Motion {
        Motion {
            length: self.lengths[cell],
            approach: self.approaches[cell],
            since_load: self.since_load,
            time_step: self.time_step,
        }
    }
}

/// Cells of all bodies.
pub(in crate::fdm) trait Cells<C>: fmt::Debug + Default {
    fn count(&self) -> usize;

    /// Something of a cell.
    fn look<T>(&self, i: usize, of: impl FnOnce(&C) -> T) -> T;

    /// Changes a cell.
    fn change<T>(&mut self, i: usize, change: impl FnOnce(&mut C) -> T) -> T;

    fn add(&mut self, cell: C);
}

impl<C: Copy + fmt::Debug> Cells<C> for Vec<C> {
    fn count(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn look<T>(&self, i: usize, of: impl FnOnce(&C) -> T) -> T {
        of(&self[i])
    }

    #[inline(always)]
    fn change<T>(&mut self, i: usize, change: impl FnOnce(&mut C) -> T) -> T {
        change(&mut self[i])
    }

    fn add(&mut self, cell: C) {
        self.push(cell);
    }
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
pub(in crate::fdm) trait Law: fmt::Debug + Sized {
    /// State of a cell.
    type Cell: Copy + fmt::Debug;

    /// State of all cells.
    type Cells: Cells<Self::Cell> + Serialize + DeserializeOwned;

    /// Whether the stored energy is made up from the loads before and after a time, rather than kept by the work done.
    const STORED_ACROSS_STEPS: bool;

    /// A cell at rest between two faces.
    fn cell(&self, back: f64, front: f64) -> Self::Cell;

    /// Brings the stress to the middle of the step.
    fn load(&self, cell: &mut Self::Cell, motion: Motion);

    /// Does it with the cells of a range, and gives their forces. The cells beside them in a block of eight may be given theirs, too.
    fn load_all(
        &self,
        cells: &mut Self::Cells,
        range: Range<usize>,
        motions: &Motions<'_>,
        forces: &mut [f64],
    ) {
        load_one_by_one(self, cells, range, motions, forces);
    }

    /// Axial force of a loaded cell, viscosity included [N].
    fn force(&self, cell: &Self::Cell) -> f64;

    /// Completes the step at its new length, shorter by `shortening` [m]; false when the law does not reach so far.
    fn finish(&self, cell: &mut Self::Cell, length: f64, shortening: f64) -> bool;

    /// Whether there is something to complete.
    fn finishes(&self) -> bool {
        true
    }

    /// Largest stable time step [s].
    fn stable_step(&self, cell: &Self::Cell, length: f64, approach: f64) -> f64;

    /// The smallest one of a range of cells that also shorten slowly enough in it [s]; `ends` are the lengths of all cells and the speeds
    /// at which their faces approach.
    fn stable_step_of_all(
        &self,
        cells: &Self::Cells,
        range: Range<usize>,
        ends: [&[f64]; 2],
    ) -> f64 {
        stable_step_one_by_one(self, cells, range, ends)
    }

    /// Energy at the start of the step in whose middle the cell was loaded.
    fn stored(&self, cell: &Self::Cell) -> Stored;

    /// What histories show.
    fn view(&self, cell: &Self::Cell) -> View;

    /// Tensile stress at which the material spalls [Pa].
    fn spall_strength(&self) -> Option<f64> {
        None
    }

    /// Axial stress of a loaded cell without viscosity [Pa].
    fn axial_stress(&self, cell: &Self::Cell) -> f64;
}

/// Loads cells one by one.
pub(in crate::fdm) fn load_one_by_one<L: Law>(
    law: &L,
    cells: &mut L::Cells,
    range: Range<usize>,
    motions: &Motions<'_>,
    forces: &mut [f64],
) {
    for c in range {
        forces[c] = cells.change(c, |cell| {
            law.load(cell, motions.of(c));
            law.force(cell)
        });
    }
}

/// Finds the smallest stable step of cells one by one [s].
pub(in crate::fdm) fn stable_step_one_by_one<L: Law>(
    law: &L,
    cells: &L::Cells,
    range: Range<usize>,
    [lengths, approaches]: [&[f64]; 2],
) -> f64 {
    let steps = range.map(|c| {
        let (length, approach) = (lengths[c], approaches[c]);
        let stable = cells.look(c, |cell| law.stable_step(cell, length, approach));
        limited(stable, length, approach)
    });
    steps.fold(f64::INFINITY, f64::min)
}
