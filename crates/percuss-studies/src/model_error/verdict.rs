//! A row of the benchmark's results.

use serde::{Deserialize, Serialize};

use crate::regime::ProjectileRegime;

/// Depth of one shot by one model beside that by the reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Name of the contender.
    pub contender: String,
    /// Id of the projectile's material.
    pub projectile: String,
    /// Id of the target's material.
    pub target: String,
    /// Length of the projectile over its diameter.
    pub length_to_diameter: f64,
    /// Impact speed [m/s].
    pub impact_velocity_m_s: f64,
    /// What the projectile does in this shot.
    pub regime: ProjectileRegime,
    /// Depth by the contender [mm].
    pub depth_of_penetration_mm: f64,
    /// Depth by the reference [mm], extrapolated in the cell size.
    pub reference_depth_mm: f64,
    /// Distance of that from the reference's finest mesh [mm].
    pub reference_uncertainty_mm: f64,
}

impl Verdict {
    /// Relative error: positive where the contender goes deeper than the reference.
    pub fn error(&self) -> f64 {
        self.depth_of_penetration_mm / self.reference_depth_mm - 1.0
    }
}
