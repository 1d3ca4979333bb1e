//! A slice of the projectile that widens as it shortens, and takes time to do so.
//!
//! Bar theory lets a bar widen at once. A slice has its radius as a second degree of freedom: points move outwards in proportion to
//! their radius, so that the slice has the kinetic energy `¼ m Ṙ²` of it \[love1927\], and starts in uniaxial strain before it comes to
//! uniaxial stress. Neighbours that widen at different rates shear each other, as in the theory of Mindlin and Herrmann
//! \[mindlin1952\]: that keeps a head from running away from the rod behind it.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::{
    chain::element::Plastic,
    lanes::{Real, larger, smaller},
    material::{FlowState, Material, PreparedStrength, Trial, YieldPoint},
};

/// Constants of the projectile.
#[derive(Debug)]
pub(super) struct Metal {
    pub(super) density: f64,
    /// Inverse of the speed of waves in a bar [s/m].
    pub(super) slowness: f64,
    pub(super) bulk_modulus: f64,
    pub(super) shear_modulus: f64,
    /// Inverse of the shear modulus [1/Pa].
    shear_compliance: f64,
    /// Axial and radial stiffness of a slice and the shear beside it, without the stress [Pa].
    stiffness: [f64; 2],
    pub(super) strength: Box<dyn PreparedStrength>,
    /// Temperature rise per plastic work per volume [K m3/J]; 0 without heating.
    pub(super) heating: f64,
    pub(super) rate_effects: bool,
}

impl Metal {
    /// Of a material; `heat_fraction` is 0 without heating.
    pub(super) fn new(material: &Material, heat_fraction: f64, rate_effects: bool) -> Self {
        let density = material.density.si();
        let (bulk, shear) = (material.bulk_modulus(), material.shear_modulus());
        Self {
            density,
            slowness: 1.0 / material.bar_wave_speed(),
            bulk_modulus: bulk,
            shear_modulus: shear,
            shear_compliance: 1.0 / shear,
            stiffness: [bulk + shear / 0.75 + shear, bulk + shear / 3.0],
            strength: material.strength.law().prepare(material, 1.0),
            heating: material
                .specific_heat
                .map_or(0.0, |heat| heat_fraction / (density * heat.si())),
            rate_effects,
        }
    }

    /// Square of the highest frequency that a slice under an axial stress has by itself, times the density [Pa/m2]; of its length and its
    /// radius it takes the inverses.
    #[inline(always)]
    pub(super) fn stiffness(&self, axial_stress: f64, [length, radius]: [f64; 2]) -> f64 {
        let [axial, radial] = self.stiffness;
        let stress = axial_stress.abs();
        4.0 * (axial + stress) * (length * length) + 8.0 * (radial + stress) * (radius * radius)
    }
}

/// A slice without load. All slices of a projectile are alike.
#[derive(Debug, Clone, Copy)]
pub(super) struct Undeformed {
    pub(super) mass: f64,
    pub(super) length: f64,
    pub(super) radius: f64,
    pub(super) volume: f64,
}

impl Undeformed {
    /// With a length and a radius [m].
    pub(super) fn new(metal: &Metal, length: f64, radius: f64) -> Self {
        Self {
            mass: metal.density * PI * radius * radius * length,
            length,
            radius,
            volume: PI * radius * radius * length,
        }
    }

    /// Mass that moves with the outer radius [kg]: `∫ (r/R)² dm`.
    #[inline(always)]
    pub(super) fn radial_mass(&self) -> f64 {
        0.5 * self.mass
    }

    /// Cross-section [m2].
    pub(super) fn area(&self) -> f64 {
        self.volume / self.length
    }
}

percuss_core::per_lane! {
    /// A slice between two nodes of the projectile, or one in every lane. Stresses are those per area at rest in each direction
    /// (Kirchhoff), compression positive, so that their work on logarithmic strains is exact.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Slice<R: Real = f64> {
        pub(super) length: R,
        pub(super) radius: R,
        pub(super) radial_velocity: R,
        /// Logarithmic axial strain, compression positive.
        pub(super) strain: R,
        /// Force that drives it outwards, without the shear of its neighbours [N].
        pub(super) radial_force: R,
        pub(super) axial_force: R,
        /// Pressure and axial less radial stress, a step before and now.
        pub(super) pressure: [R; 2],
        pub(super) difference: [R; 2],
        pub(super) plastic: Plastic<R>,
        /// Where it stands on its yield surface.
        pub(super) yield_point: YieldPoint<R>,
    }
}

/// What a slice has that no step works on in lanes.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Particulars {
    pub(super) initial_position: f64,
    /// By the failure law, failed at 1; and whether it has separated from a neighbour.
    pub(super) damage: f64,
    pub(super) parted: bool,
}

/// Axial stress of a slice under a pressure and a difference of axial and radial stress.
#[inline(always)]
pub(super) fn axial_stress(pressure: f64, difference: f64) -> f64 {
    pressure + 2.0 / 3.0 * difference
}

impl Slice {
    pub(super) fn new(size: &Undeformed, yield_point: YieldPoint, temperature: f64) -> Self {
        Self {
            length: size.length,
            radius: size.radius,
            plastic: Plastic {
                temperature,
                ..Plastic::default()
            },
            yield_point,
            ..Self::default()
        }
    }

    pub(super) fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// Axial stress [Pa].
    pub(super) fn axial_stress(&self) -> f64 {
        axial_stress(self.pressure[1], self.difference[1])
    }

    /// Stress of a bar that flows as this slice does [Pa].
    pub(super) fn flow_stress(&self) -> f64 {
        self.difference[1].abs()
    }

    /// Length and radius when it is unloaded [m].
    pub(super) fn unloaded(&self, size: &Undeformed) -> (f64, f64) {
        (
            size.length * (-self.plastic.axial).exp(),
            size.radius * (0.5 * self.plastic.axial).exp(),
        )
    }

    /// Elastic energy between two steps [J].
    #[inline(always)]
    pub(super) fn elastic_energy(&self, metal: &Metal, size: &Undeformed) -> f64 {
        let volumetric = self.pressure[0] * self.pressure[1] / (2.0 * metal.bulk_modulus);
        let distortion = self.difference[0] * self.difference[1] / (6.0 * metal.shear_modulus);
        size.volume * (volumetric + distortion)
    }

    /// Kinetic energy of its widening [J].
    #[inline(always)]
    pub(super) fn radial_energy(&self, size: &Undeformed) -> f64 {
        0.5 * size.radial_mass() * self.radial_velocity * self.radial_velocity
    }

    /// Plastic strain that returns a trial stress difference [Pa] to the yield surface, by any strength law.
    pub(super) fn plastic_increment(&mut self, metal: &Metal, trial: f64, time_step: f64) -> f64 {
        self.yield_point.plastic_increment(
            &*metal.strength,
            &FlowState {
                plastic_strain: self.plastic.strain,
                strain_rate: 0.0,
                temperature: self.plastic.temperature,
                pressure: self.pressure[1],
            },
            &Trial {
                stress: trial.abs(),
                modulus: 3.0 * metal.shear_modulus,
                pressure_fall: 0.0,
                elapsed: metal.rate_effects.then_some(time_step),
            },
        )
    }
}

percuss_core::per_lane! {
    /// Shear between two neighbours that widen at different rates.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Shear<R = f64> {
        /// Stress at the radius of the rod [Pa], now and a step before, and the plastic strain of the last step.
        pub(super) stress: [R; 2],
        pub(super) plastic_step: R,
        /// Force on the first of the two, outwards [N].
        pub(super) force: R,
    }
}

/// Shear stress at the outer radius of a slice that flows in shear all over, per yield stress: `4/(3 √3)`.
const SHEAR_YIELD: f64 = 0.769_800_358_919_501;

/// What the shear between two neighbours follows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Neighbours {
    /// Mean length [m].
    pub(super) length: f64,
    /// Radial velocity of the one ahead, less that of the other one [m/s].
    pub(super) widening: f64,
    /// Mean yield stress [Pa].
    pub(super) yield_stress: f64,
}

impl Shear {
    #[inline(always)]
    pub(super) fn elastic_energy(&self, metal: &Metal, size: &Undeformed) -> f64 {
        // The strain grows with the radius from the axis, and its square is half as large on the mean.
        0.25 * size.volume * self.stress[0] * self.stress[1] * metal.shear_compliance
    }

    /// Follows its two slices over a step; gives the plastic work between the half steps around the current time [J].
    #[inline(always)]
    pub(super) fn deform(
        &mut self,
        metal: &Metal,
        size: &Undeformed,
        slices: &Neighbours,
        time_step: f64,
    ) -> f64 {
        let per_length = 1.0 / slices.length;
        let strain = slices.widening * time_step * per_length;
        let trial = self.stress[1] + metal.shear_modulus * strain;
        // A slice that flows in shear all over turns as much work into heat as this stress at its outer radius would. A metal that
        // melts has no strength, except for rounding to either side.
        let limit = SHEAR_YIELD * larger(slices.yield_stress, 0.0);
        let stress = smaller(larger(trial, -limit), limit);
        let step_before = self.plastic_step;
        self.plastic_step = (trial - stress) * metal.shear_compliance;
        self.stress = [self.stress[1], stress];
        // Per volume at rest, as in the slices: the energy of a stress that stays must not change with the volume.
        self.force = 0.5 * size.volume * per_length * stress;
        0.25 * size.volume * self.stress[0] * (step_before + self.plastic_step)
    }
}
