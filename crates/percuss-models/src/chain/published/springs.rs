//! Springs of the published scheme, and what it takes.

use crate::{
    Scenario,
    material::{Material, Strength},
    options::SmallStrainStiffness,
    problem::RearFaceCondition,
    scenario::{Plate, TargetBody},
};

/// Springs of one body: all alike.
#[derive(Debug, Clone, Copy)]
pub(super) struct Springs {
    /// Length of an element [m].
    pub(super) length: f64,
    /// Elastic stiffness `E A/l` [N/m], equation (7).
    pub(super) stiffness: f64,
    /// `factor σ₀ A` [N]: force at unit strain.
    pub(super) strength: f64,
    pub(super) exponent: f64,
    pub(super) small_strain: SmallStrainStiffness,
    pub(super) mass: f64,
    pub(super) border_shear: f64,
}

impl Springs {
    /// Force at a shortening `u` of a spring of length `length`, equations (8)–(14).
    pub(super) fn force(&self, u: f64, length: f64) -> f64 {
        let strain = u.abs() / length;
        let plastic = self.strength * strain.powf(self.exponent);
        let force = match self.small_strain {
            SmallStrainStiffness::PowerLaw if u == 0.0 => 0.0,
            SmallStrainStiffness::PowerLaw => plastic,
            SmallStrainStiffness::Elastic => {
                plastic.min(self.stiffness * self.length / length * u.abs())
            }
        };
        force.copysign(u)
    }
}
pub(super) fn law(material: &Material, factor: f64, area: f64) -> Option<(f64, f64)> {
    match &material.strength {
        Strength::PowerLaw(law) => Some((factor * law.coefficient.si() * area, law.exponent)),
        Strength::Elastic(_) => Some((material.youngs_modulus.si() * area, 1.0)),
        _ => None,
    }
}

pub(super) fn single_plate(scenario: &Scenario) -> Option<(&Plate, f64, f64)> {
    match &scenario.target {
        TargetBody::Layers {
            layers,
            back_face: RearFaceCondition::Fixed,
            column_diameter,
            separate_layers: false,
            ..
        } => match layers.as_slice() {
            [plate] => Some((plate, plate.thickness?, *column_diameter)),
            _ => None,
        },
        _ => None,
    }
}
