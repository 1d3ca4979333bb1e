//! What makes two cases similar: velocity, L/D, strength ratio and density ratio.

use super::ErrorRecord;
use crate::{Scenario, material::Material, regime::STRENGTH_STRAIN, scenario::TargetBody};

/// Logarithms of impact velocity [m/s], L/D, and ratios of flow stress and density, projectile over target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Features([f64; 4]);

impl Features {
    /// Those of a case; `None` for a target without a material, or a material that never yields.
    pub(super) fn of(scenario: &Scenario) -> Option<Self> {
        let rod = &scenario.projectile;
        let [strength, density] = ratios(scenario)?;
        Some(Self::new(
            scenario.impact_velocity,
            rod.length / rod.diameter,
            strength,
            density,
        ))
    }

    /// Those of a benchmark case.
    pub(super) fn of_record(record: &ErrorRecord) -> Self {
        Self::new(
            record.impact_velocity_m_s,
            record.length_to_diameter,
            record.strength_ratio,
            record.density_ratio,
        )
    }

    fn new(velocity: f64, length_to_diameter: f64, strength: f64, density: f64) -> Self {
        Self([velocity, length_to_diameter, strength, density].map(f64::ln))
    }

    /// Distance of two cases.
    pub(super) fn distance(&self, other: &Self) -> f64 {
        let squares = self.0.iter().zip(&other.0).map(|(a, b)| (a - b) * (a - b));
        squares.sum::<f64>().sqrt()
    }
}

/// Ratios of flow stress, at a plastic strain of 0.1, and of density, projectile over the target's first layer.
pub fn ratios(scenario: &Scenario) -> Option<[f64; 2]> {
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        return None;
    };
    let (rod, target): (&Material, &Material) =
        (&scenario.projectile.material, &layers.first()?.material);
    let strength = |material: &Material| material.flow_stress(STRENGTH_STRAIN);
    Some([
        strength(rod)? / strength(target)?,
        rod.density.si() / target.density.si(),
    ])
}
