//! Law of a planar body: Mie–Grüneisen pressure, hypoelastic deviator, artificial viscosity, energy by the work done.

use serde::{Deserialize, Serialize};

use crate::{
    fdm::{
        grid::{Law, Motion, Stored, View},
        viscosity,
    },
    material::{FlowState, PreparedStrength, StateEquation, Trial, YieldPoint},
    options::ArtificialViscosity,
};

/// A planar body.
#[derive(Debug)]
pub(super) struct PlanarLaw {
    pub(super) state: StateEquation,
    pub(super) area: f64,
    pub(super) start_density: f64,
    /// Energy at the start [J/kg].
    pub(super) start_energy: f64,
    pub(super) shear_modulus: f64,
    /// `None` for a fluid.
    pub(super) strength: Option<Box<dyn PreparedStrength>>,
    /// Part of the plastic work that heats the body.
    pub(super) heat_fraction: f64,
    pub(super) specific_heat: Option<f64>,
    pub(super) start_temperature: f64,
    pub(super) rate_effects: bool,
    pub(super) viscosity: ArtificialViscosity,
    pub(super) spall_strength: Option<f64>,
}

/// A cell, at the start of a step, and what its middle needs.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct PlanarCell {
    initial_position: f64,
    mass: f64,
    length: f64,
    pub(super) volume: f64,
    pub(super) energy: f64,
    pub(super) pressure: f64,
    /// Axial deviator, compression positive [Pa].
    pub(super) deviator: f64,
    plastic_strain: f64,
    /// Slow flow stress of the current state.
    yield_point: YieldPoint,
    temperature: f64,
    strain_rate: f64,
    wave_speed: f64,
    plastic_work: f64,
    viscous_work: f64,
    time_step: f64,
    /// Pressure, deviator and viscous pressure in the middle of the step.
    middle: [f64; 3],
}

/// Deviator after a change of length.
struct Sheared {
    deviator: f64,
    increment: f64,
    /// Equivalent stress [Pa].
    stress: f64,
}

impl PlanarLaw {
    fn flow_state(&self, cell: &PlanarCell) -> FlowState {
        FlowState {
            plastic_strain: cell.plastic_strain,
            strain_rate: 0.0,
            temperature: cell.temperature,
            pressure: cell.pressure,
        }
    }

    fn yield_point(&self, cell: &PlanarCell) -> YieldPoint {
        match &self.strength {
            Some(strength) => YieldPoint::slow(&**strength, &self.flow_state(cell)),
            None => YieldPoint::default(),
        }
    }

    /// `Δs = (4/3) G Δε`, Δε the logarithmic shortening, returned to `(3/2)|s| = Y`.
    fn shear(&self, cell: &PlanarCell, length: f64, elapsed: f64) -> Sheared {
        let Some(strength) = &self.strength else {
            return Sheared {
                deviator: 0.0,
                increment: 0.0,
                stress: 0.0,
            };
        };
        let trial = cell.deviator + 4.0 / 3.0 * self.shear_modulus * (cell.length / length).ln();
        let equivalent = 1.5 * trial.abs();
        if cell.yield_point.holds(equivalent) {
            return Sheared {
                deviator: trial,
                increment: 0.0,
                stress: equivalent,
            };
        }
        // The middle of a step and its end start from the same state: the cell's own point stays.
        let mut point = cell.yield_point;
        let increment = point.plastic_increment(
            &**strength,
            &self.flow_state(cell),
            &Trial {
                stress: equivalent,
                modulus: 3.0 * self.shear_modulus,
                pressure_fall: 0.0,
                elapsed: self.rate_effects.then_some(elapsed),
            },
        );
        let stress = equivalent - 3.0 * self.shear_modulus * increment;
        Sheared {
            deviator: (stress / 1.5).copysign(trial),
            increment,
            stress,
        }
    }

    /// Longitudinal wave speed [m/s].
    fn wave_speed(&self, volume: f64, pressure: f64) -> f64 {
        let bulk = self.state.sound_speed_squared(volume, pressure);
        (bulk + 4.0 / 3.0 * self.shear_modulus * volume).sqrt()
    }

    /// Longitudinal wave speed at rest [m/s].
    pub(super) fn wave_speed_at_rest(&self) -> f64 {
        let volume = 1.0 / self.start_density;
        self.wave_speed(volume, self.state.pressure(volume, self.start_energy))
    }
}

impl PlanarLaw {
    /// Speed of the fastest wave that an impact at a velocity [m/s] can send into the body at rest [m/s].
    pub(super) fn fastest_wave(&self, velocity: f64) -> f64 {
        let shock = self.state.shock_speed(velocity);
        shock.map_or(self.wave_speed_at_rest(), |shock| {
            shock.max(self.wave_speed_at_rest())
        })
    }
}

impl Law for PlanarLaw {
    type Cell = PlanarCell;
    type Cells = Vec<PlanarCell>;
    const STORED_ACROSS_STEPS: bool = false;

    fn cell(&self, back: f64, front: f64) -> PlanarCell {
        let volume = 1.0 / self.start_density;
        let pressure = self.state.pressure(volume, self.start_energy);
        let mut cell = PlanarCell {
            initial_position: 0.5 * (back + front),
            mass: self.start_density * self.area * (front - back),
            length: front - back,
            volume,
            energy: self.start_energy,
            pressure,
            deviator: 0.0,
            plastic_strain: 0.0,
            yield_point: YieldPoint::default(),
            temperature: self.start_temperature,
            strain_rate: 0.0,
            wave_speed: self.wave_speed(volume, pressure),
            plastic_work: 0.0,
            viscous_work: 0.0,
            time_step: 0.0,
            middle: [pressure, 0.0, 0.0],
        };
        cell.yield_point = self.yield_point(&cell);
        cell
    }

    /// The energy in the middle of the step takes half the work of the stresses at its start and half that of the stresses
    /// sought; as the pressure is linear in the energy, that has a closed form.
    fn load(&self, cell: &mut PlanarCell, motion: Motion) {
        let settled = cell.middle == [cell.pressure, cell.deviator, 0.0];
        if settled && motion.approach == 0.0 && motion.length == cell.length {
            return;
        }
        let volume = cell.volume * motion.length / cell.length;
        let change = volume - cell.volume;
        let sheared = self.shear(cell, motion.length, 0.5 * motion.time_step);
        let viscous = viscosity::viscous_pressure(
            self.viscosity,
            1.0 / cell.volume,
            cell.wave_speed,
            motion.approach,
        );
        let (cold, slope) = self.state.coefficients(volume);
        let known = 0.5 * (cell.pressure + cold + cell.deviator + sheared.deviator) + viscous;
        let energy = (cell.energy - known * change) / (1.0 + 0.5 * slope * change);
        cell.middle = [cold + slope * energy, sheared.deviator, viscous];
        cell.time_step = motion.time_step;
    }

    fn force(&self, cell: &PlanarCell) -> f64 {
        self.area * (cell.middle[0] + cell.middle[1] + cell.middle[2])
    }

    /// The energy takes exactly the work that the forces of the step did on the nodes, so the total is conserved to rounding.
    fn finish(&self, cell: &mut PlanarCell, length: f64, shortening: f64) -> bool {
        let work = shortening * self.area / cell.mass;
        let volume = cell.volume - work;
        if !self.state.reaches(volume) {
            return false;
        }
        let [pressure, deviator, viscous] = cell.middle;
        let sheared = self.shear(cell, length, cell.time_step);
        let mean_volume = 0.5 * (cell.volume + volume);
        // Where flow begins within the step, the work starts at the yield stress, not at the stress before it.
        let mean_stress = 0.5 * (sheared.stress + cell.yield_point.stress().min(sheared.stress));
        let plastic = mean_stress * sheared.increment * mean_volume;
        cell.plastic_work += cell.mass * plastic;
        cell.viscous_work += cell.mass * viscous * work;
        cell.temperature *= (self.state.heating_by_compression(mean_volume) * work).exp();
        if let Some(heat) = self.specific_heat {
            cell.temperature += (self.heat_fraction * plastic + viscous * work) / heat;
        }
        if sheared.increment > 0.0 && cell.time_step > 0.0 {
            cell.strain_rate = cell.strain_rate.max(sheared.increment / cell.time_step);
        }
        cell.plastic_strain += sheared.increment;
        cell.deviator = sheared.deviator;
        cell.energy += (pressure + deviator + viscous) * work;
        cell.volume = volume;
        cell.length = length;
        cell.pressure = self.state.pressure(volume, cell.energy);
        cell.wave_speed = self.wave_speed(volume, cell.pressure);
        cell.yield_point = self.yield_point(cell);
        true
    }

    fn stable_step(&self, cell: &PlanarCell, length: f64, approach: f64) -> f64 {
        viscosity::stable_step(self.viscosity, length, cell.wave_speed, approach)
    }

    /// What is neither plastic nor viscous work counts as elastic: recoverable, with the heat of compression in it.
    fn stored(&self, cell: &PlanarCell) -> Stored {
        let gained = cell.mass * (cell.energy - self.start_energy);
        Stored {
            elastic: gained - cell.plastic_work - cell.viscous_work,
            plastic: cell.plastic_work,
            viscous: cell.viscous_work,
        }
    }

    fn view(&self, cell: &PlanarCell) -> View {
        View {
            initial_position: cell.initial_position,
            stress: self.axial_stress(cell),
            strain: -(cell.volume * self.start_density).ln(),
            plastic_strain: cell.plastic_strain,
            strain_rate: cell.strain_rate,
            temperature: cell.temperature,
            diameter: 2.0 * (self.area / std::f64::consts::PI).sqrt(),
        }
    }

    fn spall_strength(&self) -> Option<f64> {
        self.spall_strength
    }

    fn axial_stress(&self, cell: &PlanarCell) -> f64 {
        cell.pressure + cell.deviator
    }
}
