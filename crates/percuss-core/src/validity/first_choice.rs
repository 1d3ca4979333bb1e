//! Cases for which a model is the first choice.

use serde::Serialize;

use super::NoseKind;
use crate::{
    material::MaterialClass,
    regime::{ProjectileRegime, Regime, TargetKind},
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
            && scenario.brittle().is_empty()
    }
}
