//! A slice of the projectile that widens as it shortens, and takes time to do so.
//!
//! Bar theory lets a bar widen at once. A slice has its radius as a second degree of freedom: points move outwards in proportion to
//! their radius, so that the slice has the kinetic energy `¼ m Ṙ²` of it \[love1927\], and starts in uniaxial strain before it comes to
//! uniaxial stress. Neighbours that widen at different rates shear each other, as in the theory of Mindlin and Herrmann
//! \[mindlin1952\]: that keeps a head from running away from the rod behind it.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::material::{FlowState, Material, PreparedStrength, Trial, YieldPoint};

/// Constants of the projectile.
#[derive(Debug)]
pub(super) struct Metal {
    pub(super) density: f64,
    /// Inverse of the speed of waves in a bar [s/m].
    pub(super) slowness: f64,
    pub(super) bulk_modulus: f64,
    pub(super) shear_modulus: f64,
    pub(super) strength: Box<dyn PreparedStrength>,
    /// Temperature rise per plastic work per volume [K m3/J]; 0 without heating.
    pub(super) heating: f64,
    pub(super) rate_effects: bool,
}

impl Metal {
    /// Of a material; `heat_fraction` is 0 without heating.
    pub(super) fn new(material: &Material, heat_fraction: f64, rate_effects: bool) -> Self {
        let density = material.density.si();
        Self {
            density,
            slowness: 1.0 / material.bar_wave_speed(),
            bulk_modulus: material.bulk_modulus(),
            shear_modulus: material.shear_modulus(),
            strength: material.strength.law().prepare(material, 1.0),
            heating: material
                .specific_heat
                .map_or(0.0, |heat| heat_fraction / (density * heat.si())),
            rate_effects,
        }
    }

    /// Square of the highest frequency that a slice under an axial stress has by itself, times the density [Pa/m2].
    #[inline(always)]
    pub(super) fn stiffness(&self, axial_stress: f64, length: f64, radius: f64) -> f64 {
        let shear = self.shear_modulus;
        let axial = self.bulk_modulus + shear / 0.75 + axial_stress.abs();
        let radial = self.bulk_modulus + shear / 3.0 + axial_stress.abs();
        4.0 * (axial + shear) / (length * length) + 8.0 * radial / (radius * radius)
    }
}

/// A slice between two nodes of the projectile. Stresses are those per area at rest in each direction (Kirchhoff), compression
/// positive, so that their work on logarithmic strains is exact.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Slice {
    pub(super) mass: f64,
    pub(super) rest_length: f64,
    pub(super) length: f64,
    rest_radius: f64,
    pub(super) radius: f64,
    pub(super) radial_velocity: f64,
    /// Force that drives it outwards [N].
    pub(super) radial_force: f64,
    pub(super) axial_force: f64,
    /// Pressure and axial less radial stress, a step before and now.
    pub(super) pressure: [f64; 2],
    pub(super) difference: [f64; 2],
    /// Axial plastic strain, compression positive, and its part in the last step.
    pub(super) plastic_axial: f64,
    pub(super) plastic_step: f64,
    pub(super) plastic_strain: f64,
    pub(super) largest_rate: f64,
    pub(super) temperature: f64,
    pub(super) yield_point: YieldPoint,
    pub(super) initial_position: f64,
    /// By the failure law, failed at 1; and whether it has separated from a neighbour.
    pub(super) damage: f64,
    pub(super) parted: bool,
}

impl Slice {
    pub(super) fn new(
        metal: &Metal,
        length: f64,
        radius: f64,
        temperature: f64,
        position: f64,
    ) -> Self {
        let at_rest = FlowState {
            plastic_strain: 0.0,
            strain_rate: 0.0,
            temperature,
            pressure: 0.0,
        };
        Self {
            mass: metal.density * PI * radius * radius * length,
            rest_length: length,
            length,
            rest_radius: radius,
            radius,
            radial_velocity: 0.0,
            radial_force: 0.0,
            axial_force: 0.0,
            pressure: [0.0; 2],
            difference: [0.0; 2],
            plastic_axial: 0.0,
            plastic_step: 0.0,
            plastic_strain: 0.0,
            largest_rate: 0.0,
            temperature,
            yield_point: YieldPoint::slow(&*metal.strength, &at_rest),
            initial_position: position,
            damage: 0.0,
            parted: false,
        }
    }

    pub(super) fn rest_volume(&self) -> f64 {
        PI * self.rest_radius * self.rest_radius * self.rest_length
    }

    /// Mass that moves with the outer radius [kg]: `∫ (r/R)² dm`.
    pub(super) fn radial_mass(&self) -> f64 {
        0.5 * self.mass
    }

    pub(super) fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// Logarithmic axial strain, compression positive.
    pub(super) fn strain(&self) -> f64 {
        (self.rest_length / self.length).ln()
    }

    /// Logarithmic radial strain, compression positive.
    pub(super) fn radial_strain(&self) -> f64 {
        (self.rest_radius / self.radius).ln()
    }

    /// Axial stress [Pa].
    pub(super) fn axial_stress(&self) -> f64 {
        self.pressure[1] + self.difference[1] / 1.5
    }

    /// Stress of a bar that flows as this slice does [Pa].
    pub(super) fn flow_stress(&self) -> f64 {
        self.difference[1].abs()
    }

    pub(super) fn yield_stress(&self) -> f64 {
        self.yield_point.stress()
    }

    /// Length and radius when it is unloaded [m].
    pub(super) fn unloaded(&self) -> (f64, f64) {
        (
            self.rest_length * (-self.plastic_axial).exp(),
            self.rest_radius * (0.5 * self.plastic_axial).exp(),
        )
    }

    /// Elastic energy between two steps [J].
    pub(super) fn elastic_energy(&self, metal: &Metal) -> f64 {
        let volumetric = self.pressure[0] * self.pressure[1] / (2.0 * metal.bulk_modulus);
        let distortion = self.difference[0] * self.difference[1] / (6.0 * metal.shear_modulus);
        self.rest_volume() * (volumetric + distortion)
    }

    /// Kinetic energy of its widening [J].
    pub(super) fn radial_energy(&self) -> f64 {
        0.5 * self.radial_mass() * self.radial_velocity * self.radial_velocity
    }

    /// Goes on to the stresses that belong to its length and radius after a step; gives the plastic work between the half steps
    /// around the current time [J].
    pub(super) fn deform(&mut self, metal: &Metal, time_step: f64) -> f64 {
        let axial = self.strain();
        let radial = self.radial_strain();
        let pressure = metal.bulk_modulus * (axial + 2.0 * radial);
        let elastic = axial - radial - 1.5 * self.plastic_axial;
        let trial = 2.0 * metal.shear_modulus * elastic;
        self.pressure = [self.pressure[1], pressure];
        let step_before = self.plastic_step;
        self.plastic_step = 0.0;
        if metal.strength.depends_on_pressure() {
            self.yield_point.forget();
        }
        let mut difference = trial;
        if !self.yield_point.holds(trial.abs()) {
            difference = self.flow(metal, trial, time_step);
        }
        self.difference = [self.difference[1], difference];
        let volume = self.rest_volume();
        self.axial_force = self.axial_stress() * volume / self.length;
        self.radial_force = 2.0 * (pressure - difference / 3.0) * volume / self.radius;
        0.5 * volume * self.difference[0] * (step_before + self.plastic_step)
    }

    /// Returns a trial stress difference to the yield surface.
    pub(super) fn flow(&mut self, metal: &Metal, trial: f64, time_step: f64) -> f64 {
        let modulus = 3.0 * metal.shear_modulus;
        let increment = self.yield_point.plastic_increment(
            &*metal.strength,
            &FlowState {
                plastic_strain: self.plastic_strain,
                strain_rate: 0.0,
                temperature: self.temperature,
                pressure: self.pressure[1],
            },
            &Trial {
                stress: trial.abs(),
                modulus,
                pressure_fall: 0.0,
                elapsed: metal.rate_effects.then_some(time_step),
            },
        );
        self.plastic_step = increment.copysign(trial);
        let difference = trial - modulus * self.plastic_step;
        self.plastic_axial += self.plastic_step;
        self.plastic_strain += increment;
        self.largest_rate = self.largest_rate.max(increment / time_step);
        let mean = 0.5 * (self.difference[1] + difference).abs();
        self.temperature += metal.heating * mean * increment;
        difference
    }

    /// Square of the highest frequency that it has by itself, times the density [Pa/m2].
    pub(super) fn stiffness(&self, metal: &Metal) -> f64 {
        metal.stiffness(self.axial_stress(), self.length, self.radius)
    }
}

/// Shear between two neighbours that widen at different rates.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Shear {
    /// Stress at the radius of the rod [Pa], now and a step before, and the plastic strain of the last step.
    stress: [f64; 2],
    plastic_step: f64,
    volume: f64,
    /// Force on the first of the two, outwards [N].
    pub(super) force: f64,
}

impl Shear {
    pub(super) fn elastic_energy(&self, metal: &Metal) -> f64 {
        // The strain grows with the radius from the axis, and its square is half as large on the mean.
        0.25 * self.volume * self.stress[0] * self.stress[1] / metal.shear_modulus
    }

    /// Follows its two slices over a step; gives the plastic work between the half steps around the current time [J].
    pub(super) fn deform(
        &mut self,
        metal: &Metal,
        behind: &Slice,
        ahead: &Slice,
        time_step: f64,
    ) -> f64 {
        let length = 0.5 * (behind.length + ahead.length);
        let strain = (ahead.radial_velocity - behind.radial_velocity) * time_step / length;
        let trial = self.stress[1] + metal.shear_modulus * strain;
        // A slice that flows in shear all over turns as much work into heat as this stress at its outer radius would.
        let yield_stress = 0.5 * (behind.yield_stress() + ahead.yield_stress());
        // A metal that melts has no strength, except for rounding to either side.
        let limit = 4.0 / 3.0 * yield_stress.max(0.0) / 3.0_f64.sqrt();
        let stress = trial.clamp(-limit, limit);
        let step_before = self.plastic_step;
        self.plastic_step = (trial - stress) / metal.shear_modulus;
        self.stress = [self.stress[1], stress];
        // Per volume at rest, as in the slices: the energy of a stress that stays must not change with the volume.
        self.volume = 0.5 * (behind.rest_volume() + ahead.rest_volume());
        self.force = 0.5 * self.volume / length * stress;
        0.25 * self.volume * self.stress[0] * (step_before + self.plastic_step)
    }
}
