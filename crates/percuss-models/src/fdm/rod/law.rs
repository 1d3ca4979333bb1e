//! Law of a rod: uniaxial stress in rate form, constant volume.

use std::{f64::consts::PI, ops::Range};

use super::{
    blocks::{LoadBlocks, StableStep},
    cell::{FlowConstants, RodCell, RodCells},
};
use crate::{
    fdm::{
        grid::{Law, Motion, Motions, Stored, View, load_one_by_one, stable_step_one_by_one},
        viscosity,
    },
    lanes::larger,
    material::{PreparedStrength, YieldPoint},
    options::ArtificialViscosity,
};

/// A rod or a column of target.
#[derive(Debug)]
pub(super) struct RodLaw {
    pub(super) modulus: f64,
    pub(super) density: f64,
    pub(super) wave_speed: f64,
    pub(super) area: f64,
    pub(super) strength: Box<dyn PreparedStrength>,
    /// Temperature rise per plastic work per volume [K m3/J]; 0 without heating.
    pub(super) heating: f64,
    pub(super) start_temperature: f64,
    pub(super) rate_effects: bool,
    pub(super) viscosity: ArtificialViscosity,
}

impl RodLaw {
    fn diameter(&self, shortening: f64) -> f64 {
        2.0 * (self.area * shortening / PI).sqrt()
    }

    /// Diameter of a cell without load [m].
    pub(super) fn unloaded_diameter(&self, cell: &RodCell) -> f64 {
        self.diameter(cell.plastic.axial.exp())
    }

    pub(super) fn constants(&self, elapsed: f64) -> FlowConstants {
        FlowConstants {
            modulus: self.modulus,
            heating: self.heating,
            elapsed,
        }
    }

    pub(super) fn elapsed(&self, constants: &FlowConstants) -> Option<f64> {
        self.rate_effects.then_some(constants.elapsed)
    }

    pub(super) fn viscous_pressure(&self, approach: f64) -> f64 {
        viscosity::viscous_pressure(self.viscosity, self.density, self.wave_speed, approach)
    }

    /// Stable time step without viscosity [s].
    ///
    /// The force grows faster than the stress as the area grows: the tangent is E + σ.
    #[inline(always)]
    pub(super) fn wave_time(&self, stress: f64, length: f64) -> f64 {
        length / self.speed(stress)
    }

    #[inline(always)]
    fn speed(&self, stress: f64) -> f64 {
        let stiffness = 1.0 + larger(stress / self.modulus, 0.0);
        self.wave_speed * (1.0 + 0.5 * (stiffness - 1.0))
    }
}

impl Law for RodLaw {
    type Cell = RodCell;
    type Cells = RodCells;
    const STORED_ACROSS_STEPS: bool = true;

    fn cell(&self, back: f64, front: f64) -> RodCell {
        let length = front - back;
        let mut cell = RodCell {
            initial_position: 0.5 * (back + front),
            volume: self.area * length,
            rest_length: length,
            ..RodCell::default()
        };
        cell.elastic.length = length;
        cell.plastic.temperature = self.start_temperature;
        cell.yield_point = YieldPoint::slow(&*self.strength, &cell.plastic.state(0.0));
        cell
    }

    /// `Δσ = E (Δε − Δε_p)` with the shortening over the mean length as Δε.
    ///
    /// The plastic work that belongs to a stress is that stress times half the plastic strain before it and half the one
    /// after it: with that, elastic, plastic and kinetic energy add up exactly for a constant step.
    fn load(&self, cell: &mut RodCell, motion: Motion) {
        let constants = self.constants(motion.since_load);
        let (elastic, plastic) = (&mut cell.elastic, &mut cell.plastic);
        elastic.stretch(motion.length, self.modulus);
        let step_before = std::mem::take(&mut plastic.step);
        if !cell.yield_point.holds(elastic.stress.abs()) {
            let (start, elapsed) = (plastic.state(elastic.stress), self.elapsed(&constants));
            let trial = elastic.trial(self.modulus, elapsed);
            let point = &mut cell.yield_point;
            let increment = point.plastic_increment(&*self.strength, &start, &trial);
            if increment > 0.0 {
                plastic.take(elastic, increment, &constants);
            }
        }
        cell.plastic_work += elastic.plastic_work(cell.volume, step_before + plastic.step);
        cell.viscous_pressure = self.viscous_pressure(motion.approach);
    }

    fn load_all(
        &self,
        cells: &mut RodCells,
        range: Range<usize>,
        motions: &Motions<'_>,
        forces: &mut [f64],
    ) {
        match self.strength.in_lanes() {
            Some(law) => law.visit(LoadBlocks {
                rod: self,
                blocks: cells.blocks_mut(),
                range,
                motions,
                forces,
            }),
            None => load_one_by_one(self, cells, range, motions, forces),
        }
    }

    fn force(&self, cell: &RodCell) -> f64 {
        (cell.elastic.stress + cell.viscous_pressure) * cell.volume / cell.elastic.length
    }

    fn finish(&self, cell: &mut RodCell, _: f64, shortening: f64) -> bool {
        let force = cell.viscous_pressure * cell.volume / cell.elastic.length;
        cell.viscous_work += force * shortening;
        true
    }

    fn finishes(&self) -> bool {
        !self.viscosity.is_none()
    }

    fn stable_step(&self, cell: &RodCell, length: f64, approach: f64) -> f64 {
        let speed = self.speed(cell.elastic.stress);
        viscosity::stable_step(self.viscosity, length, speed, approach)
    }

    fn stable_step_of_all(
        &self,
        cells: &RodCells,
        range: Range<usize>,
        [lengths, approaches]: [&[f64]; 2],
    ) -> f64 {
        if !self.viscosity.is_none() {
            return stable_step_one_by_one(self, cells, range, [lengths, approaches]);
        }
        pulp::Arch::new().dispatch(StableStep {
            rod: self,
            blocks: cells.blocks(),
            range,
            lengths,
            approaches,
        })
    }

    fn stored(&self, cell: &RodCell) -> Stored {
        let stresses = cell.elastic.stress_before * cell.elastic.stress;
        Stored {
            elastic: cell.volume * stresses / (2.0 * self.modulus),
            plastic: cell.plastic_work,
            viscous: cell.viscous_work,
        }
    }

    fn view(&self, cell: &RodCell) -> View {
        View {
            initial_position: cell.initial_position,
            stress: cell.elastic.stress,
            strain: cell.elastic.strain,
            plastic_strain: cell.plastic.strain,
            strain_rate: cell.plastic.largest_rate,
            temperature: cell.plastic.temperature,
            diameter: self.diameter(cell.elastic.strain.exp()),
        }
    }

    fn axial_stress(&self, cell: &RodCell) -> f64 {
        cell.elastic.stress
    }
}
