//! Bodies of the chain: what is the same for all elements of a projectile or a layer.

use std::f64::consts::PI;

use super::tate::USED_UP_STRAIN;
use crate::{
    material::{Material, PreparedFailure, PreparedStrength},
    options::{ChainOptions, ErosionCriterion, Kinematics},
    units::Quantity,
};

/// What a part is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Projectile,
    Target,
}

/// A projectile or a layer of the target.
#[derive(Debug)]
pub(super) struct Section {
    pub(super) role: Role,
    /// Number of elements; a rigid wall has none.
    pub(super) elements: usize,
    pub(super) modulus: f64,
    /// Inverse of the modulus [1/Pa].
    pub(super) compliance: f64,
    pub(super) density: f64,
    pub(super) wave_speed: f64,
    /// Inverse of the wave speed [s/m].
    pub(super) slowness: f64,
    pub(super) area: f64,
    pub(super) strength: Box<dyn PreparedStrength>,
    /// Temperature rise per plastic work per volume [K m3/J]; 0 without heating.
    pub(super) heating: f64,
    pub(super) start_temperature: f64,
    pub(super) rate_effects: bool,
    pub(super) kinematics: Kinematics,
    /// Factor on the flow stress.
    pub(super) constraint: f64,
    /// When it parts in tension; `None` when it does not.
    pub(super) failure: Option<Box<dyn PreparedFailure>>,
    /// Energy that a crack takes to open, per area [J/m2].
    pub(super) fracture_energy: f64,
    /// Border shear per length of element [N/m]; 0 for a projectile.
    pub(super) friction_per_length: f64,
}

impl Section {
    /// A deformable part. `factor` multiplies its flow stress.
    pub(super) fn new(
        role: Role,
        material: &Material,
        area: f64,
        elements: usize,
        factor: f64,
        options: &ChainOptions,
    ) -> Self {
        // What the constraint adds to the stress is work against the material around the column, not heat in it.
        let heating = heating(material, options, factor);
        let factor = match options.erosion_criterion() {
            ErosionCriterion::Strain => factor,
            // An element's force over the part of its length that is used up does the work of its flow stress over all of it.
            ErosionCriterion::Tate => factor / USED_UP_STRAIN,
        };
        Self {
            role,
            elements,
            modulus: material.youngs_modulus.si(),
            compliance: 1.0 / material.youngs_modulus.si(),
            density: material.density.si(),
            wave_speed: material.bar_wave_speed(),
            slowness: 1.0 / material.bar_wave_speed(),
            area,
            strength: material.strength.law().prepare(material, factor),
            heating,
            start_temperature: material.room_temperature.si(),
            rate_effects: options.rate_effects(),
            kinematics: options.kinematics(),
            constraint: factor,
            failure: options
                .failure
                .as_ref()
                .and_then(|failure| failure.law().prepare(material)),
            fracture_energy: options.fracture_energy.map_or(0.0, Quantity::si),
            friction_per_length: 0.0,
        }
    }

    /// Diameter at an axial strain [m].
    pub(super) fn diameter_at(&self, strain: f64) -> f64 {
        let diameter = 2.0 * (self.area / PI).sqrt();
        match self.kinematics {
            Kinematics::Logarithmic => diameter * (0.5 * strain).exp(),
            Kinematics::SmallStrain => diameter,
        }
    }

    /// Length at an axial strain [m].
    pub(super) fn length_at(&self, rest_length: f64, strain: f64) -> f64 {
        match self.kinematics {
            Kinematics::Logarithmic => rest_length * (-strain).exp(),
            Kinematics::SmallStrain => rest_length * (1.0 - strain),
        }
    }
}

/// Temperature rise per work per volume of a flow stress with a factor on it [K m3/J]; 0 without heating.
pub(super) fn heating(material: &Material, options: &ChainOptions, factor: f64) -> f64 {
    match material.specific_heat {
        Some(heat) if options.adiabatic_heating() => {
            options.heat_fraction() / (factor * material.density.si() * heat.si())
        }
        _ => 0.0,
    }
}
