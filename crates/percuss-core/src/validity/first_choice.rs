//! Cases for which a model is the first choice.

use serde::Serialize;

use super::NoseKind;
use crate::{
    material::MaterialClass,
    regime::{ProjectileRegime, Regime, THIN, TargetKind, is_thinner},
    scenario::{Scenario, TargetBody},
};

/// A kind of case for which a model is the first choice.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FirstChoice {
    /// What the projectile does.
    pub projectile: ProjectileRegime,
    /// What is struck.
    pub targets: &'static [TargetKind],
    /// Noses.
    pub noses: &'static [NoseKind],
    /// Class of the target's material.
    pub target_material: MaterialClass,
    /// Why this model.
    pub because: &'static str,
}

/// Whether a target of several layers is as thin as a plate that no such choice is made for.
fn is_thin(scenario: &Scenario, regime: &Regime) -> bool {
    let thickness = scenario.target_thickness();
    regime.target == TargetKind::Layered
        && thickness.is_some_and(|thickness| is_thinner(thickness, THIN, scenario))
}

impl FirstChoice {
    /// Whether a case is of this kind.
    pub fn fits(&self, scenario: &Scenario, regime: &Regime) -> bool {
        let classes = match &scenario.target {
            TargetBody::Layers { layers, .. } => layers
                .iter()
                .all(|layer| layer.material.class() == self.target_material),
            _ => true,
        };
        self.projectile == regime.projectile
            && self.targets.contains(&regime.target)
            && self.noses.contains(&NoseKind::of(scenario.projectile.nose))
            && classes
            && !is_thin(scenario, regime)
            && scenario.brittle().is_empty()
    }
}
