//! Eight material points side by side, so that one instruction works on all of them.

use crate::{
    lanes::{Lanes, PerLane, lanes, one},
    material::{FlowState, YieldPoint},
    solver::Particle,
};

/// Material of points, named as in [`Particle`]. Those without mass are no part of a body.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(crate) struct MaterialPoints {
    pub(crate) deviator: [Lanes; 3],
    pub(crate) pressure: Lanes,
    pub(crate) viscous_pressure: Lanes,
    pub(crate) mass: Lanes,
    pub(crate) volume: Lanes,
    pub(crate) plastic_strain: Lanes,
    pub(crate) temperature: Lanes,
    pub(crate) energy: Lanes,
    pub(crate) damage: Lanes,
    pub(crate) localization: Lanes,
    pub(crate) yield_point: YieldPoint<Lanes>,
}

impl MaterialPoints {
    /// The material of a point.
    #[inline]
    pub(crate) fn particle(&self, lane: usize) -> Particle {
        Particle {
            deviator: one(&self.deviator, lane),
            pressure: self.pressure[lane],
            viscous_pressure: self.viscous_pressure[lane],
            mass: self.mass[lane],
            volume: self.volume[lane],
            plastic_strain: self.plastic_strain[lane],
            yield_point: self.yield_point.lane(lane),
            temperature: self.temperature[lane],
            energy: self.energy[lane],
            damage: self.damage[lane],
            localization: self.localization[lane],
            ..Particle::default()
        }
    }

    /// Replaces the material of a point.
    #[inline]
    pub(crate) fn set_particle(&mut self, lane: usize, particle: &Particle) {
        set_one(&mut self.deviator, lane, particle.deviator);
        self.pressure[lane] = particle.pressure;
        self.viscous_pressure[lane] = particle.viscous_pressure;
        self.mass[lane] = particle.mass;
        self.volume[lane] = particle.volume;
        self.plastic_strain[lane] = particle.plastic_strain;
        self.yield_point.set_lane(lane, particle.yield_point);
        self.temperature[lane] = particle.temperature;
        self.energy[lane] = particle.energy;
        self.damage[lane] = particle.damage;
        self.localization[lane] = particle.localization;
    }

    /// What the strength of a point depends on before it flows.
    #[inline(always)]
    pub(crate) fn flow_state(&self, lane: usize) -> FlowState {
        FlowState {
            plastic_strain: self.plastic_strain[lane],
            strain_rate: 0.0,
            temperature: self.temperature[lane],
            pressure: self.pressure[lane],
        }
    }

    /// Pressures with the artificial viscosity [Pa].
    #[inline(always)]
    pub(crate) fn whole_pressure(&self) -> Lanes {
        let (pressure, viscous) = (self.pressure, self.viscous_pressure);
        lanes(|l| pressure[l] + viscous[l])
    }
}

/// Replaces the numbers of one lane.
#[inline(always)]
pub(crate) fn set_one<const N: usize>(all: &mut [Lanes; N], lane: usize, values: [f64; N]) {
    for (entry, value) in all.iter_mut().zip(values) {
        entry[lane] = value;
    }
}
