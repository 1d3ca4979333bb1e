//! Section of a plate that bends and shears: moments and shear force from curvatures and slope, inside one yield surface.

use serde::{Deserialize, Serialize};

use std::f64::consts::PI;

use super::{band_law::Failure, plate_flow::FlowingRings};
use crate::{
    material::{DamageState, FlowState, Material, PreparedStrength},
    options::ChainOptions,
};

/// Part of the transverse shear stiffness that a rectangular section has \[mindlin1951\].
const SHEAR_CORRECTION: f64 = 5.0 / 6.0;
/// Multiplier from which the first flow is sought.
const FIRST_MULTIPLIER: f64 = 1e-3;

/// What is the same for all rings of a plate.
#[derive(Debug)]
pub(super) struct PlateSection {
    pub(super) thickness: f64,
    poissons_ratio: f64,
    density: f64,
    /// Bending stiffness D [N m].
    bending: f64,
    /// Transverse shear stiffness [N/m].
    shear: f64,
    /// How fast normal flow reduces the sum and the difference of the moments and the shear force.
    decay: [f64; 3],
    pub(super) strength: Box<dyn PreparedStrength>,
    /// Temperature rise per plastic work per volume [K m3/J].
    heating: f64,
    pub(super) rate_effects: bool,
    start_temperature: f64,
    failure: Failure,
}

impl PlateSection {
    pub(super) fn new(
        material: &Material,
        thickness: f64,
        start_temperature: f64,
        failure: Failure,
        options: &ChainOptions,
    ) -> Self {
        let nu = material.poissons_ratio;
        let bending = material.youngs_modulus.si() * thickness.powi(3) / (12.0 * (1.0 - nu * nu));
        let shear = SHEAR_CORRECTION * material.shear_modulus() * thickness;
        Self {
            thickness,
            poissons_ratio: nu,
            density: material.density.si(),
            bending,
            shear,
            decay: [
                1.0 + nu,
                3.0 * (1.0 - nu),
                0.375 * shear * thickness * thickness / bending,
            ],
            strength: material.strength.law().prepare(material, 1.0),
            heating: super::part::heating(material, options, 1.0),
            rate_effects: options.rate_effects(),
            start_temperature,
            failure,
        }
    }

    /// Mass per area [kg/m2].
    pub(super) fn areal_density(&self) -> f64 {
        self.density * self.thickness
    }

    /// Longest stable time step with rings of a width at a radius and beyond [s].
    ///
    /// The energy of a ring is at most that of its bending and twice those of its slope and of its rotation in shear.
    pub(super) fn stable_step(&self, width: f64, radius: f64) -> f64 {
        let areal = self.areal_density();
        let rotary = areal * self.thickness * self.thickness / 12.0;
        let slope = 8.0 * self.shear / (areal * width * width);
        let curvature = 4.0 / (width * width) + 1.0 / (radius * radius);
        let bending = (1.0 + self.poissons_ratio) * self.bending * curvature;
        let turn = (bending + 2.0 * self.shear) / rotary;
        2.0 / slope.max(turn).sqrt()
    }

    /// Fully plastic moment over the flow stress.
    #[inline(always)]
    pub(super) fn modulus(&self) -> f64 {
        0.25 * self.thickness * self.thickness
    }

    /// Moment that uses up as much of a section as moments and shear force do together: `√(M_r² − M_r M_θ + M_θ² + 3 (Q h/4)²)`.
    #[inline(always)]
    pub(super) fn equivalent(&self, loads: [f64; 3]) -> f64 {
        self.equivalent_squared(loads).sqrt()
    }

    #[inline(always)]
    fn equivalent_squared(&self, [sum, difference, shear]: [f64; 3]) -> f64 {
        let of_shear = 0.5 * self.thickness * shear;
        0.25 * (sum * sum + 3.0 * (difference * difference + of_shear * of_shear))
    }

    /// Trial moments and shear force after normal flow with a multiplier.
    #[inline(always)]
    pub(super) fn returned(&self, trial: [f64; 3], multiplier: f64) -> [f64; 3] {
        let [sum, difference, shear] = self.decay;
        [
            trial[0] / (1.0 + multiplier * sum),
            trial[1] / (1.0 + multiplier * difference),
            trial[2] / (1.0 + multiplier * shear),
        ]
    }

    /// Slope of the equivalent moment with the multiplier, after the return with it.
    #[inline(always)]
    pub(super) fn slope_of_equivalent(
        &self,
        returned: [f64; 3],
        multiplier: f64,
        moment: f64,
    ) -> f64 {
        let [first, second, third] = self.decay;
        let of_sum = -returned[0] * returned[0] * first / (1.0 + multiplier * first);
        let of_difference = -returned[1] * returned[1] * second / (1.0 + multiplier * second);
        let of_force = -returned[2] * returned[2] * third / (1.0 + multiplier * third);
        let of_shear = 0.25 * self.thickness * self.thickness * of_force;
        0.25 * (of_sum + 3.0 * (of_difference + of_shear)) / moment
    }

    /// Mean plastic strain of normal flow: work per area is σ h Δε with σ = 4M/h², so that a curvature Δκ has the strain h Δκ/4.
    #[inline(always)]
    pub(super) fn strain(&self, multiplier: f64, moment: f64) -> f64 {
        0.5 * self.thickness * multiplier * moment / self.bending
    }

    /// Stiffness of the sum and the difference of the moments and of the shear force.
    fn stiffness(&self) -> [f64; 3] {
        let nu = self.poissons_ratio;
        [
            self.bending * (1.0 + nu),
            self.bending * (1.0 - nu),
            self.shear,
        ]
    }
}

/// A ring of a plate. Moments are kept as their sum and their difference, which the elastic law does not mix.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Ring {
    /// Of its middle [m].
    pub(super) radius: f64,
    /// [m].
    pub(super) width: f64,
    sum: f64,
    difference: f64,
    shear: f64,
    sum_before: f64,
    difference_before: f64,
    shear_before: f64,
    /// Plastic curvatures, sum and difference, and slope, and those of the last step and of the one before.
    plastic: [f64; 3],
    plastic_step: [f64; 3],
    plastic_before: [f64; 3],
    /// Mean equivalent plastic strain of the section and its temperature, at rest.
    state: FlowState,
    damage: f64,
    /// Flow stress in that state, where it is known [Pa].
    slow: Option<f64>,
    /// Stress at which it flowed last [Pa].
    reached: f64,
    /// Multiplier of the last flow.
    last_multiplier: f64,
}

impl Ring {
    pub(super) fn new(section: &PlateSection, radius: f64, width: f64) -> Self {
        Self {
            radius,
            width,
            sum: 0.0,
            difference: 0.0,
            shear: 0.0,
            sum_before: 0.0,
            difference_before: 0.0,
            shear_before: 0.0,
            plastic: [0.0; 3],
            plastic_step: [0.0; 3],
            plastic_before: [0.0; 3],
            state: FlowState {
                plastic_strain: 0.0,
                strain_rate: 0.0,
                temperature: section.start_temperature,
                pressure: 0.0,
            },
            damage: 0.0,
            slow: None,
            reached: f64::INFINITY,
            last_multiplier: FIRST_MULTIPLIER,
        }
    }

    /// Whether it has failed.
    pub(super) fn has_failed(&self, section: &PlateSection) -> bool {
        section
            .failure
            .is_reached(self.state.plastic_strain, self.damage)
    }

    /// Area of the ring in the plane of the plate [m2].
    fn area(&self) -> f64 {
        2.0 * PI * self.radius * self.width
    }

    /// Force on its inner circle, the opposite of that on its outer one, and the moments on both.
    #[inline]
    pub(super) fn loads(&self) -> (f64, [f64; 2]) {
        let radial = 0.5 * (self.sum + self.difference);
        let hoop = 0.5 * (self.sum - self.difference);
        let common = 0.5 * hoop / self.radius + 0.5 * self.shear;
        let ends = radial / self.width;
        (
            self.shear * self.area() / self.width,
            [
                (ends - common) * self.area(),
                (-ends - common) * self.area(),
            ],
        )
    }

    /// Whether an update without motion would change nothing.
    #[inline]
    pub(super) fn is_settled(&self) -> bool {
        self.plastic_step == [0.0; 3]
            && self.sum == self.sum_before
            && self.difference == self.difference_before
            && self.shear == self.shear_before
    }

    /// Brings the ring to new deflections and rotations of its circles, to moments and a shear force as if nothing flowed; whether these are
    /// beyond the yield surface.
    #[inline]
    pub(super) fn deform(
        &mut self,
        section: &PlateSection,
        deflections: [f64; 2],
        rotations: [f64; 2],
    ) -> bool {
        let radial = (rotations[1] - rotations[0]) / self.width;
        let hoop = 0.5 * (rotations[0] + rotations[1]) / self.radius;
        let slope = (deflections[1] - deflections[0]) / self.width;
        self.sum_before = self.sum;
        self.difference_before = self.difference;
        self.shear_before = self.shear;
        let inclined = slope + 0.5 * (rotations[0] + rotations[1]);
        self.shear = section.shear * (inclined - self.plastic[2]);
        let stiffness = section.bending;
        let nu = section.poissons_ratio;
        self.sum = stiffness * (1.0 + nu) * (radial + hoop - self.plastic[0]);
        self.difference = stiffness * (1.0 - nu) * (radial - hoop - self.plastic[1]);
        self.plastic_before = self.plastic_step;
        self.plastic_step = [0.0; 3];
        !self.is_elastic(section)
    }

    /// Plastic work between the half steps around the current time [J].
    #[inline]
    pub(super) fn plastic_work(&self) -> f64 {
        let steps: [f64; 3] =
            std::array::from_fn(|i| self.plastic_before[i] + self.plastic_step[i]);
        // M_r κ_r + M_θ κ_θ is half of what sums and differences give; half of the two steps belongs to this time.
        let bending = self.sum_before * steps[0] + self.difference_before * steps[1];
        (0.25 * bending + 0.5 * self.shear_before * steps[2]) * self.area()
    }

    /// Whether the trial moments and shear force are inside the yield surface.
    #[inline]
    fn is_elastic(&mut self, section: &PlateSection) -> bool {
        let square = section.equivalent_squared([self.sum, self.difference, self.shear]);
        let within = |stress: f64| square <= (section.modulus() * stress).powi(2);
        // What was reached with a strain rate is flow at any rate.
        within(self.reached)
            && within(
                *self
                    .slow
                    .get_or_insert_with(|| section.strength.flow_stress(&self.state).stress),
            )
    }

    /// Takes a lane of rings that flow.
    pub(super) fn join(&self, rings: &mut FlowingRings, lane: usize) {
        let trial = [self.sum, self.difference, self.shear];
        for (lanes, trial) in rings.trial.iter_mut().zip(trial) {
            lanes[lane] = trial;
        }
        rings.multiplier[lane] = self.last_multiplier;
        rings.plastic_strain[lane] = self.state.plastic_strain;
        rings.temperature[lane] = self.state.temperature;
    }

    /// Returns trial moments and shear force to the yield surface by a multiplier of normal flow.
    pub(super) fn flow(&mut self, section: &PlateSection, multiplier: f64, time_step: f64) {
        let trial = [self.sum, self.difference, self.shear];
        self.last_multiplier = multiplier;
        let returned = section.returned(trial, multiplier);
        let increment = section.strain(multiplier, section.equivalent(returned));
        let temperature = self.state.temperature;
        let rate = DamageState::rate(increment, time_step, section.rate_effects);
        self.damage = section
            .failure
            .grow(self.damage, increment, rate, temperature);
        [self.sum, self.difference, self.shear] = returned;
        let stiffness = section.stiffness();
        self.plastic_step = std::array::from_fn(|i| (trial[i] - returned[i]) / stiffness[i]);
        for (plastic, step) in self.plastic.iter_mut().zip(self.plastic_step) {
            *plastic += step;
        }
        self.state.plastic_strain += increment;
        self.reached = section.equivalent(returned) / section.modulus();
        self.state.temperature += section.heating * self.reached * increment;
        self.slow = None;
    }

    /// Elastic energy between two steps [J]: the form that central differences conserve.
    pub(super) fn elastic_energy(&self, section: &PlateSection) -> f64 {
        let nu = section.poissons_ratio;
        let bending = self.sum_before * self.sum / (section.bending * (1.0 + nu))
            + self.difference_before * self.difference / (section.bending * (1.0 - nu));
        let shear = self.shear_before * self.shear / section.shear;
        (0.25 * bending + 0.5 * shear) * self.area()
    }
}
