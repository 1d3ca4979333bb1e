//! Shear band: constraint of the slice of plug that belongs to a node.

use serde::{Deserialize, Serialize};

use super::{band_law::BandLaw, shear_zone::SQRT_3};
use crate::material::{DamageState, FlowState, Trial, YieldPoint};

/// Band of one target node. Strains and damage are those of the rim.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Band {
    pub(super) node: usize,
    pub(super) law: usize,
    pub(super) rest_position: f64,
    /// Middle of the plug that belongs to the node, from the node [m], and how much there is of it.
    pub(super) offset: f64,
    pub(super) length: f64,
    /// Length that is still inside the plate [m]; 0 when the band has ended.
    pub(super) held: f64,
    /// Shear stress for an elastic slip [Pa/m].
    pub(super) stiffness: f64,
    pub(super) stress: f64,
    stress_before: f64,
    /// Plastic slip, and that of the last step [m].
    plastic_slip: f64,
    plastic_step: f64,
    plastic_strain: f64,
    pub(super) temperature: f64,
    damage: f64,
    yield_point: YieldPoint,
}

impl Band {
    /// The band of a node at rest: the plug between two positions belongs to it.
    pub(super) fn new(
        node: usize,
        position: f64,
        span: [f64; 2],
        number: usize,
        law: &BandLaw,
    ) -> Self {
        let state = FlowState {
            plastic_strain: 0.0,
            strain_rate: 0.0,
            temperature: law.start_temperature,
            pressure: 0.0,
        };
        Self {
            node,
            law: number,
            rest_position: position,
            offset: 0.5 * (span[0] + span[1]) - position,
            length: span[1] - span[0],
            held: span[1] - span[0],
            stiffness: law.stiffness(),
            stress: 0.0,
            stress_before: 0.0,
            plastic_slip: 0.0,
            plastic_step: 0.0,
            plastic_strain: 0.0,
            temperature: law.start_temperature,
            damage: 0.0,
            yield_point: YieldPoint::slow(&*law.strength, &state),
        }
    }

    /// Elastic energy per area between two steps [J/m2].
    pub(super) fn stored(&self) -> f64 {
        self.stress_before * self.stress / (2.0 * self.stiffness)
    }

    /// Shortens what is held of a circumference; returns the energy that was stored in the rest.
    pub(super) fn release(&mut self, held: f64, perimeter: f64) -> f64 {
        let freed = (self.held - held) * perimeter * self.stored();
        self.held = held;
        freed
    }

    pub(super) fn has_failed(&self, law: &BandLaw) -> bool {
        law.failure.is_reached(self.plastic_strain, self.damage)
    }

    /// Brings the band to a given slip; returns the plastic work per area between the half steps around the current time.
    pub(super) fn deform(&mut self, law: &BandLaw, slip: f64, time_step: f64) -> f64 {
        let trial = self.stiffness * (slip - self.plastic_slip);
        self.stress_before = self.stress;
        self.stress = trial;
        let before = self.plastic_step;
        self.plastic_step = 0.0;
        if !self.yield_point.holds(SQRT_3 * trial.abs()) {
            let state = FlowState {
                plastic_strain: self.plastic_strain,
                strain_rate: 0.0,
                temperature: self.temperature,
                pressure: 0.0,
            };
            let width = law.spread.width(self.plastic_strain);
            // With q = √3 τ and Δu = w √3 Δε; 3G for a band that is as wide when it flows as when it does not.
            let increment = self.yield_point.plastic_increment(
                &*law.strength,
                &state,
                &Trial {
                    stress: SQRT_3 * trial.abs(),
                    modulus: 3.0 * self.stiffness * width,
                    pressure_fall: 0.0,
                    elapsed: law.rate_effects.then_some(time_step),
                },
            );
            if increment > 0.0 {
                self.flow(law, trial, increment, width, time_step);
            }
        }
        0.5 * self.stress_before * (before + self.plastic_step)
    }

    fn flow(&mut self, law: &BandLaw, trial: f64, increment: f64, width: f64, time_step: f64) {
        let rate = DamageState::rate(increment, time_step, law.rate_effects);
        self.damage = law
            .failure
            .grow(self.damage, increment, rate, self.temperature);
        self.plastic_step = (SQRT_3 * increment * width).copysign(trial);
        self.plastic_slip += self.plastic_step;
        self.stress = trial - self.stiffness * self.plastic_step;
        self.plastic_strain += increment;
        let mean = 0.5 * SQRT_3 * (self.stress_before + self.stress).abs();
        self.temperature += law.heating * mean * increment;
    }
}
