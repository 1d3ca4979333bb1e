//! A row of the benchmark's results.

use serde::{Deserialize, Serialize};

use crate::regime::ProjectileRegime;

/// Depth of one case by one model beside that by the reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ErrorRecord {
    /// Name of the candidate.
    pub candidate: String,
    /// Id of the projectile's material.
    pub projectile: String,
    /// Id of the target's material.
    pub target: String,
    /// Flow stress of the projectile over that of the target, at a plastic strain of 0.1.
    pub strength_ratio: f64,
    /// Density of the projectile over that of the target.
    pub density_ratio: f64,
    /// Length of the projectile over its diameter.
    pub length_to_diameter: f64,
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// What the projectile does in this case.
    pub regime: ProjectileRegime,
    /// Depth by the candidate [mm].
    pub depth_of_penetration_mm: f64,
    /// Depth by the reference [mm], extrapolated in the cell size.
    pub reference_depth_mm: f64,
    /// Distance of that from the reference's finest mesh [mm].
    pub reference_uncertainty_mm: f64,
}

impl ErrorRecord {
    /// Relative error: positive where the candidate goes deeper than the reference.
    pub fn error(&self) -> f64 {
        self.depth_of_penetration_mm / self.reference_depth_mm - 1.0
    }
}
