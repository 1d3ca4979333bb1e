//! Depth of a case by the reference, and the convergence check of the reference.

use serde::Serialize;

use super::{BenchmarkCase, DIAMETER, Reference};
use percuss::{
    axisymmetric::{self, depth_resolution},
    outcome::BandQuantity,
    richardson::OnMesh,
};

/// Largest uncertainty of a reference that counts, as a fraction of the depth.
const LARGEST_UNCERTAINTY: f64 = 0.15;

/// Depth of a case by the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Depth of penetration, extrapolated in the cell size where the meshes allow it [mm].
    pub depth_mm: f64,
    /// Half width of the uncertainty due to the cell size [mm].
    pub uncertainty_mm: f64,
}

/// Reason why a reference does not count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Refusal {
    /// Fewer than three meshes.
    TooFewMeshes,
    /// The meshes leave a larger uncertainty than counts.
    NotConverged {
        /// Uncertainty as a fraction of the depth.
        uncertainty: f64,
    },
    /// A shorter rod of the same materials and velocity goes deeper, beyond both uncertainties.
    ShorterRodDeeper {
        /// Length of that rod over its diameter.
        length_to_diameter: f64,
        /// Its depth [mm].
        depth_mm: f64,
    },
}

impl Refusal {
    /// The reason in words.
    pub fn describe(&self) -> String {
        match *self {
            Self::TooFewMeshes => "fewer than three meshes".to_owned(),
            Self::NotConverged { uncertainty } => format!(
                "the meshes leave an uncertainty of {:.0} %, more than {:.0} %",
                100.0 * uncertainty,
                100.0 * LARGEST_UNCERTAINTY
            ),
            Self::ShorterRodDeeper {
                length_to_diameter,
                depth_mm,
            } => format!(
                "the shorter rod of L/D {length_to_diameter} penetrates deeper ({depth_mm:.3} mm)"
            ),
        }
    }
}

/// Reference of one case with the result of its check.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedReference {
    /// The case.
    pub case: BenchmarkCase,
    /// Depth [mm] on every mesh by cells per radius, from coarse to fine.
    pub meshes: Vec<OnMesh>,
    /// Depth, or the reason why the reference does not count.
    pub estimate: Result<Estimate, Refusal>,
}

impl CheckedReference {
    /// Case with the reason why its reference does not count.
    pub fn refused(&self) -> Option<RefusedReference> {
        let refusal = self.estimate.err()?;
        Some(RefusedReference {
            projectile: self.case.projectile.clone(),
            target: self.case.target.clone(),
            length_to_diameter: self.case.length_to_diameter,
            impact_velocity_m_s: self.case.speed,
            reason: refusal.describe(),
        })
    }
}

/// Case that is left out of all statistics.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RefusedReference {
    /// Id of the projectile's material.
    pub projectile: String,
    /// Id of the target's material.
    pub target: String,
    /// Length of the projectile over its diameter.
    pub length_to_diameter: f64,
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Reason why its reference does not count.
    pub reason: String,
}

/// Checks the reference of every case that has one.
///
/// Besides the check of the meshes of each case ([`depth_of`]), the depth of a longer rod must not be below that of a shorter one of the same materials and
/// velocity by more than both uncertainties; the longer rod, which has the coarser meshes, is refused.
pub fn check_references(
    cases: &[BenchmarkCase],
    references: &[Reference],
) -> Vec<CheckedReference> {
    let alone: Vec<CheckedReference> = cases
        .iter()
        .filter_map(|case| {
            let meshes = meshes(references, case);
            (!meshes.is_empty()).then(|| CheckedReference {
                case: case.clone(),
                estimate: depth_of(&meshes),
                meshes,
            })
        })
        .collect();
    let mut checked = alone.clone();
    for entry in &mut checked {
        let Ok(own) = entry.estimate else { continue };
        let shorter = alone.iter().filter(|other| {
            let BenchmarkCase {
                projectile,
                target,
                length_to_diameter,
                speed,
            } = &other.case;
            (projectile, target) == (&entry.case.projectile, &entry.case.target)
                && *speed == entry.case.speed
                && *length_to_diameter < entry.case.length_to_diameter
        });
        let mut deeper = shorter.filter_map(|other| {
            let depth = other.estimate.ok()?;
            let gap = depth.depth_mm - own.depth_mm - depth.uncertainty_mm - own.uncertainty_mm;
            (gap > 0.0).then_some((other.case.length_to_diameter, depth.depth_mm))
        });
        if let Some((length_to_diameter, depth_mm)) = deeper.next_back() {
            entry.estimate = Err(Refusal::ShorterRodDeeper {
                length_to_diameter,
                depth_mm,
            });
        }
    }
    checked
}

/// Depths of a case by cells per radius, from coarse to fine.
fn meshes(references: &[Reference], case: &BenchmarkCase) -> Vec<OnMesh> {
    let own = references
        .iter()
        .filter(|row| row.is_of(case) && row.depth_of_penetration_mm.is_finite());
    let mut meshes: Vec<OnMesh> = own
        .map(|row| OnMesh {
            cells: f64::from(row.cells_per_radius),
            value: row.depth_of_penetration_mm,
        })
        .collect();
    meshes.sort_by(|a, b| a.cells.total_cmp(&b.cells));
    meshes.dedup_by_key(|mesh| mesh.cells);
    meshes
}

/// Depth [mm] by the three finest meshes, in order from coarse to fine, by the rule of the axisymmetric answer
/// ([`axisymmetric::limit`]); or why they give none.
///
/// # Errors
/// The [`Refusal`]: fewer than three meshes, or an uncertainty above 15 %.
pub fn depth_of(meshes: &[OnMesh]) -> Result<Estimate, Refusal> {
    let [.., _, _, finest] = *meshes else {
        return Err(Refusal::TooFewMeshes);
    };
    let diameter = BandQuantity::DepthOfPenetration.in_unit(DIAMETER);
    let resolution = depth_resolution(finest.value, diameter, finest.cells);
    let limit = axisymmetric::limit(meshes, 0.0, resolution).ok_or(Refusal::TooFewMeshes)?;
    let uncertainty = limit.uncertainty / limit.value;
    if uncertainty.is_nan() || uncertainty > LARGEST_UNCERTAINTY {
        return Err(Refusal::NotConverged { uncertainty });
    }
    Ok(Estimate {
        depth_mm: limit.value,
        uncertainty_mm: limit.uncertainty,
    })
}

#[cfg(test)]
#[path = "estimate_tests.rs"]
mod tests;
