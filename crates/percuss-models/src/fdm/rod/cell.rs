//! Cells of a rod, one by one and in blocks of eight.

use serde::{Deserialize, Serialize};

use crate::{
    fdm::grid::Cells,
    lanes::{Blocks, Lanes, Real, larger},
    material::{FlowState, Trial, YieldPoint},
};

percuss_core::per_lane! {
    /// Elastic state of a cell.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Elastic<R = f64> {
        /// Length at the last load [m].
        pub(super) length: R,
        pub(super) strain: R,
        /// Stress now and at the load before [Pa].
        pub(super) stress: R,
        pub(super) stress_before: R,
    }
}

percuss_core::per_lane! {
    /// Plastic state of a cell.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Plastic<R = f64> {
        /// Signed axial plastic strain, compression positive, and its part in the last load.
        pub(super) axial: R,
        pub(super) step: R,
        /// Accumulated plastic strain.
        pub(super) strain: R,
        /// Largest plastic strain rate so far [1/s].
        pub(super) largest_rate: R,
        pub(super) temperature: R,
    }
}

percuss_core::per_lane! {
    /// A cell, or eight: the stress, and what led to it.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct RodCell<R: Real = f64> {
        pub(super) initial_position: R,
        pub(super) volume: R,
        pub(super) rest_length: R,
        pub(super) elastic: Elastic<R>,
        pub(super) plastic: Plastic<R>,
        pub(super) viscous_pressure: R,
        pub(super) yield_point: YieldPoint<R>,
        pub(super) plastic_work: R,
        pub(super) viscous_work: R,
    }
}

impl Elastic {
    /// Takes a new length as if nothing flowed.
    #[inline(always)]
    pub(super) fn stretch(&mut self, length: f64, modulus: f64) {
        let step = 2.0 * (self.length - length) / (self.length + length);
        self.length = length;
        self.strain += step;
        self.stress_before = self.stress;
        self.stress += modulus * step;
    }

    /// Plastic work that belongs to the load before this one [J]; `steps` is the plastic strain of both.
    #[inline(always)]
    pub(super) fn plastic_work(&self, volume: f64, steps: f64) -> f64 {
        0.5 * volume * self.stress_before * steps
    }

    /// A trial stress beyond the yield surface.
    #[inline(always)]
    pub(super) fn trial(&self, modulus: f64, elapsed: Option<f64>) -> Trial {
        Trial {
            stress: self.stress.abs(),
            modulus,
            pressure_fall: modulus.copysign(self.stress) / 3.0,
            elapsed,
        }
    }
}

impl Plastic {
    #[inline(always)]
    pub(super) fn state(&self, stress: f64) -> FlowState {
        FlowState {
            plastic_strain: self.strain,
            strain_rate: 0.0,
            temperature: self.temperature,
            pressure: stress / 3.0,
        }
    }

    /// Takes an increment of plastic strain that returns a trial stress to the yield surface.
    #[inline(always)]
    pub(super) fn take(&mut self, elastic: &mut Elastic, increment: f64, law: &FlowConstants) {
        self.step = increment.copysign(elastic.stress);
        elastic.stress -= law.modulus * self.step;
        self.axial += self.step;
        self.strain += increment;
        let mean = 0.5 * (elastic.stress_before + elastic.stress).abs();
        self.temperature += law.heating * mean * increment;
        self.largest_rate = larger(increment / law.elapsed, self.largest_rate);
    }
}

/// What flow needs of a law in one step.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlowConstants {
    pub(super) modulus: f64,
    pub(super) heating: f64,
    /// Time since the last load [s].
    pub(super) elapsed: f64,
}

impl RodCell {
    /// Length without load [m].
    pub(super) fn unloaded_length(&self) -> f64 {
        self.rest_length * (-self.plastic.axial).exp()
    }

    pub(super) fn rest_length(&self) -> f64 {
        self.rest_length
    }

    pub(super) fn strain(&self) -> f64 {
        self.elastic.strain
    }
}

/// All cells, in blocks of eight.
pub(super) type RodCells = Blocks<RodCell<Lanes>>;

impl Cells<RodCell> for RodCells {
    fn count(&self) -> usize {
        self.len()
    }

    fn look<T>(&self, i: usize, of: impl FnOnce(&RodCell) -> T) -> T {
        of(&self.get(i))
    }

    fn change<T>(&mut self, i: usize, change: impl FnOnce(&mut RodCell) -> T) -> T {
        Self::change(self, i, change)
    }

    fn add(&mut self, cell: RodCell) {
        self.push(cell);
    }
}
