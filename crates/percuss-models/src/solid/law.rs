//! Material law of a body, and the limits of its particles.

use super::points::MaterialPoints;
use crate::{
    lanes::{Lanes, lanes},
    material::{
        DamageState, Material, PreparedDamage, PreparedStrength, StateEquation, YieldPoint,
    },
    options::{ArtificialViscosity, Eos},
    solver::Particle,
};

/// Pressure against volume and energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Pressure {
    /// `p = K (ρ/ρ₀ − 1)`.
    Linear,
    /// Mie–Grüneisen about the linear Hugoniot.
    MieGruneisen(StateEquation),
}

/// The constants of a body.
#[derive(Debug)]
pub(crate) struct Law {
    pub(crate) density: f64,
    pub(crate) shear_modulus: f64,
    pub(crate) bulk_modulus: f64,
    pub(crate) pressure: Pressure,
    pub(crate) strength: Box<dyn PreparedStrength>,
    pub(crate) rate_effects: bool,
    /// Temperature rise per plastic work per mass [K kg/J]; 0 without heating.
    pub(crate) heating: f64,
    pub(crate) viscosity: ArtificialViscosity,
    /// Tension beyond which a particle spalls [Pa].
    pub(crate) spall_strength: Option<f64>,
    /// How plastic strain uses a particle up.
    pub(crate) damage: Option<PreparedDamage>,
    /// Width of the band that localized strain is in [m].
    pub(crate) band_width: f64,
    /// Equivalent plastic strain at which a particle fails.
    pub(crate) failure_strain: Option<f64>,
    /// Whether a particle that fails leaves the body.
    pub(crate) erode_failed: bool,
    /// Equivalent plastic strain at which a particle leaves the body.
    pub(crate) erosion_strain: Option<f64>,
    /// Off only in plane strain, which some exact checks need.
    pub(crate) axisymmetric: bool,
}

/// What the options of a model leave of a material.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Behaviour {
    pub(crate) equation_of_state: Eos,
    pub(crate) rate_effects: bool,
    /// Fraction of plastic work that becomes heat; 0 without heating.
    pub(crate) heat_fraction: f64,
    pub(crate) viscosity: ArtificialViscosity,
}

impl Law {
    /// A solid of a density [kg/m3], a shear and a bulk modulus [Pa] and a strength law, in plane strain: without rate, heat, artificial
    /// viscosity and failure.
    pub(crate) fn plain(
        density: f64,
        [shear_modulus, bulk_modulus]: [f64; 2],
        strength: Box<dyn PreparedStrength>,
    ) -> Self {
        Self {
            density,
            shear_modulus,
            bulk_modulus,
            pressure: Pressure::Linear,
            strength,
            rate_effects: false,
            heating: 0.0,
            viscosity: ArtificialViscosity {
                linear: 0.0,
                quadratic: 0.0,
            },
            spall_strength: None,
            damage: None,
            band_width: 1.0,
            failure_strain: None,
            erode_failed: false,
            erosion_strain: None,
            axisymmetric: false,
        }
    }

    /// The law of a material that does not fail, in plane strain.
    pub(crate) fn of(material: &Material, behaviour: &Behaviour) -> Self {
        let moduli = [material.shear_modulus(), material.bulk_modulus()];
        let strength = material.strength.law().prepare(material, 1.0);
        let state = match behaviour.equation_of_state {
            Eos::Linear => None,
            Eos::MieGruneisen => StateEquation::of(material),
        };
        Self {
            pressure: state.map_or(Pressure::Linear, Pressure::MieGruneisen),
            rate_effects: behaviour.rate_effects,
            heating: material
                .specific_heat
                .map_or(0.0, |heat| behaviour.heat_fraction / heat.si()),
            viscosity: behaviour.viscosity,
            ..Self::plain(material.density.si(), moduli, strength)
        }
    }

    /// Where a particle stands that does not flow.
    pub(crate) fn slow_yield_point(&self, particle: &Particle) -> YieldPoint {
        YieldPoint::slow(&*self.strength, &particle.flow_state())
    }

    /// Squares of the speeds of longitudinal waves [m2/s2].
    #[inline(always)]
    pub(crate) fn wave_speed_squared(&self, block: &MaterialPoints) -> Lanes {
        let shear = 4.0 / 3.0 * self.shear_modulus;
        let (mass, volume, pressure) = (block.mass, block.volume, block.pressure);
        let specific = lanes(|l| volume[l] * (1.0 / mass[l]));
        match &self.pressure {
            // dp/dρ is K/ρ₀ at any density.
            Pressure::Linear => lanes(|l| self.bulk_modulus / self.density + shear * specific[l]),
            Pressure::MieGruneisen(state) => {
                lanes(|l| state.sound_speed_squared(specific[l], pressure[l]) + shear * specific[l])
            }
        }
    }

    /// Whether there is anything that a particle can fail by.
    pub(crate) fn can_fail(&self) -> bool {
        self.damage.is_some() || self.failure_strain.is_some() || self.spall_strength.is_some()
    }

    /// Failure in shear and in tension: what a particle that fails gives up counts as failure work [J].
    pub(crate) fn fail(
        &self,
        particle: &mut Particle,
        increment: f64,
        cell: f64,
        time_step: f64,
    ) -> f64 {
        if particle.has_failed() {
            return 0.0;
        }
        if let Some(law) = self.damage.filter(|_| increment > 0.0) {
            let increment =
                increment * (1.0 + particle.localization * (cell / self.band_width - 1.0));
            let state = DamageState {
                triaxiality: -particle.pressure / particle.equivalent_stress(),
                strain_rate: DamageState::rate(increment, time_step, self.rate_effects),
                temperature: particle.temperature,
            };
            particle.damage = law.grow(particle.damage, &state, increment);
        }
        let sheared = self
            .failure_strain
            .is_some_and(|most| particle.plastic_strain >= most);
        let torn = self
            .spall_strength
            .is_some_and(|most| particle.pressure < 0.0 && particle.largest_tension() > most);
        if !(sheared || torn || particle.has_failed()) {
            return 0.0;
        }
        let whole = self.elastic_energy(particle);
        particle.damage = 1.0;
        particle.deviator = [0.0; 3];
        particle.pressure = particle.pressure.max(0.0);
        whole - self.elastic_energy(particle)
    }

    /// Elastic energy of a particle, for small strains [J].
    pub(crate) fn elastic_energy(&self, particle: &Particle) -> f64 {
        let shear = particle.equivalent_stress();
        let per_volume = shear * shear / (6.0 * self.shear_modulus)
            + particle.pressure * particle.pressure / (2.0 * self.bulk_modulus);
        per_volume * particle.volume
    }

    /// Damage and equivalent plastic strain at which a particle is to leave its body.
    #[inline(always)]
    pub(crate) fn erosion(&self) -> [f64; 2] {
        [
            if self.erode_failed {
                1.0
            } else {
                f64::INFINITY
            },
            self.erosion_strain.unwrap_or(f64::INFINITY),
        ]
    }
}
