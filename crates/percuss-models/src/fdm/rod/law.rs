//! Law of a rod: uniaxial stress in rate form, constant volume.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::{
    fdm::{
        grid::{Law, Motion, Stored, View},
        viscosity,
    },
    material::{FlowState, PreparedStrength, Trial, YieldPoint},
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

/// A cell: its stress, and what led to it.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct RodCell {
    initial_position: f64,
    volume: f64,
    rest_length: f64,
    /// Length at the last load [m].
    length: f64,
    strain: f64,
    stress: f64,
    stress_before: f64,
    viscous_pressure: f64,
    /// Signed axial plastic strain, compression positive.
    axial_plastic: f64,
    plastic_strain: f64,
    /// Signed plastic strain of the last load.
    plastic_step: f64,
    strain_rate: f64,
    temperature: f64,
    yield_point: YieldPoint,
    plastic_work: f64,
    viscous_work: f64,
}

impl RodCell {
    /// Length without load [m].
    pub(super) fn unloaded_length(&self) -> f64 {
        self.rest_length * (-self.axial_plastic).exp()
    }

    pub(super) fn rest_length(&self) -> f64 {
        self.rest_length
    }

    pub(super) fn strain(&self) -> f64 {
        self.strain
    }
}

impl RodLaw {
    fn flow_state(&self, cell: &RodCell) -> FlowState {
        FlowState {
            plastic_strain: cell.plastic_strain,
            strain_rate: 0.0,
            temperature: cell.temperature,
            pressure: cell.stress / 3.0,
        }
    }

    fn diameter(&self, shortening: f64) -> f64 {
        2.0 * (self.area * shortening / PI).sqrt()
    }

    /// Diameter of a cell without load [m].
    pub(super) fn unloaded_diameter(&self, cell: &RodCell) -> f64 {
        self.diameter(cell.axial_plastic.exp())
    }

    #[inline(never)]
    fn flow(&self, cell: &mut RodCell, trial: f64, elapsed: f64) {
        let start = FlowState {
            pressure: trial / 3.0,
            ..self.flow_state(cell)
        };
        let increment = cell.yield_point.plastic_increment(
            &*self.strength,
            &start,
            &Trial {
                stress: trial.abs(),
                modulus: self.modulus,
                pressure_fall: self.modulus.copysign(trial) / 3.0,
                elapsed: self.rate_effects.then_some(elapsed),
            },
        );
        if increment == 0.0 {
            return;
        }
        cell.plastic_step = increment.copysign(trial);
        cell.stress = trial - self.modulus * cell.plastic_step;
        cell.axial_plastic += cell.plastic_step;
        cell.plastic_strain += increment;
        let mean = 0.5 * (cell.stress_before + cell.stress).abs();
        cell.temperature += self.heating * mean * increment;
        if elapsed > 0.0 {
            cell.strain_rate = cell.strain_rate.max(increment / elapsed);
        }
    }
}

impl Law for RodLaw {
    type Cell = RodCell;
    const STORED_ACROSS_STEPS: bool = true;

    fn cell(&self, back: f64, front: f64) -> RodCell {
        let length = front - back;
        let mut cell = RodCell {
            initial_position: 0.5 * (back + front),
            volume: self.area * length,
            rest_length: length,
            length,
            strain: 0.0,
            stress: 0.0,
            stress_before: 0.0,
            viscous_pressure: 0.0,
            axial_plastic: 0.0,
            plastic_strain: 0.0,
            plastic_step: 0.0,
            strain_rate: 0.0,
            temperature: self.start_temperature,
            yield_point: YieldPoint::default(),
            plastic_work: 0.0,
            viscous_work: 0.0,
        };
        cell.yield_point = YieldPoint::slow(&*self.strength, &self.flow_state(&cell));
        cell
    }

    /// `Δσ = E (Δε − Δε_p)` with the shortening over the mean length as Δε.
    ///
    /// The plastic work that belongs to a stress is that stress times half the plastic strain before it and half the one
    /// after it: with that, elastic, plastic and kinetic energy add up exactly for a constant step.
    #[inline(always)]
    fn load(&self, cell: &mut RodCell, motion: Motion) {
        let step = 2.0 * (cell.length - motion.length) / (cell.length + motion.length);
        cell.length = motion.length;
        cell.strain += step;
        let trial = cell.stress + self.modulus * step;
        let plastic_before = cell.plastic_step;
        cell.stress_before = cell.stress;
        cell.stress = trial;
        cell.plastic_step = 0.0;
        if !cell.yield_point.holds(trial.abs()) {
            self.flow(cell, trial, motion.since_load);
        }
        cell.plastic_work +=
            0.5 * cell.volume * cell.stress_before * (plastic_before + cell.plastic_step);
        cell.viscous_pressure = viscosity::viscous_pressure(
            self.viscosity,
            self.density,
            self.wave_speed,
            motion.approach,
        );
    }

    fn force(&self, cell: &RodCell) -> f64 {
        (cell.stress + cell.viscous_pressure) * cell.volume / cell.length
    }

    fn finish(&self, cell: &mut RodCell, _: f64, shortening: f64) -> bool {
        if cell.viscous_pressure != 0.0 {
            let force = cell.viscous_pressure * cell.volume / cell.length;
            cell.viscous_work += force * shortening;
        }
        true
    }

    fn stable_step(&self, cell: &RodCell, length: f64, approach: f64) -> f64 {
        // The force grows faster than the stress as the area grows: the tangent is E + σ.
        let stiffness = 1.0 + (cell.stress / self.modulus).max(0.0);
        let speed = self.wave_speed * (1.0 + 0.5 * (stiffness - 1.0));
        viscosity::stable_step(self.viscosity, length, speed, approach)
    }

    fn allows(&self, cell: &RodCell, length: f64, step: f64) -> bool {
        let stiffness = self.modulus + 0.5 * cell.stress.max(0.0);
        self.viscosity.is_none() && length * self.modulus > step * self.wave_speed * stiffness
    }

    fn stored(&self, cell: &RodCell) -> Stored {
        Stored {
            elastic: cell.volume * cell.stress_before * cell.stress / (2.0 * self.modulus),
            plastic: cell.plastic_work,
            viscous: cell.viscous_work,
        }
    }

    fn view(&self, cell: &RodCell) -> View {
        View {
            initial_position: cell.initial_position,
            stress: cell.stress,
            strain: cell.strain,
            plastic_strain: cell.plastic_strain,
            strain_rate: cell.strain_rate,
            temperature: cell.temperature,
            diameter: self.diameter(cell.strain.exp()),
        }
    }

    fn is_settled(&self, cell: &RodCell) -> bool {
        cell.plastic_step == 0.0
            && cell.viscous_pressure == 0.0
            && cell.stress == cell.stress_before
    }

    fn axial_stress(&self, cell: &RodCell) -> f64 {
        cell.stress
    }
}
