//! Depth of a case by the reference, and the convergence check of the reference.

use serde::Serialize;

use super::{BenchmarkCase, Reference};
use percuss::richardson::{CREDIBLE_ORDERS, OnMesh, Trend, extrapolate, trend};

/// Order of the dominant error of a rod that hardly deforms: contact on a grid keeps bodies part of a cell apart, which makes a projectile
/// wider by as much. A rigid flat rod (L/D 3, 17600 kg/m³, 300 m/s, perfectly plastic target of 300 MPa) goes 7.22, 7.98 and 8.23 mm deep on
/// 4, 8 and 12 cells per radius, 8.73 mm extrapolated, and 8.58 mm by \[forrestal1988\] with a flat nose.
const FORMAL_ORDER: f64 = 1.0;
/// Largest change by an extrapolation, as a fraction of the depth on the finest mesh.
const LARGEST_EXTRAPOLATION: f64 = 0.25;
/// Largest spread of three meshes without an extrapolation, as a fraction of the depth on the finest mesh.
const AGREEMENT: f64 = 0.1;

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
    /// Three meshes without an extrapolation do not agree.
    NotConverged {
        /// Trend of the sequence.
        trend: Trend,
        /// Largest difference as a fraction of the depth on the finest mesh.
        spread: f64,
    },
    /// The extrapolation changes the depth by more than its limit.
    TooSteep {
        /// Change as a fraction of the depth on the finest mesh.
        change: f64,
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
            Self::NotConverged { trend, spread } => {
                let trend = match trend {
                    Trend::Oscillating => "the depth oscillates".to_owned(),
                    Trend::Monotone { order } => format!("observed order {order:.1}"),
                    Trend::Diverging | Trend::Exact => "the differences do not shrink".to_owned(),
                };
                format!(
                    "{trend} over three meshes, which differ by {:.0} %",
                    100.0 * spread
                )
            }
            Self::TooSteep { change } => format!(
                "the extrapolation changes the depth by {:+.0} %, more than {:.0} %",
                100.0 * change,
                100.0 * LARGEST_EXTRAPOLATION
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

/// Depth [mm] by the three finest meshes, in order from coarse to fine; or why they give none.
///
/// - **Monotone**, with an observed order of [`CREDIBLE_ORDERS`]: extrapolated at that order, but at most at the formal order 1
///   of contact, and refused where that changes the depth by more than 25 %. The uncertainty is the whole change.
/// - **Without such an order**: not extrapolated. The finest mesh counts, with the largest difference as its uncertainty, where
///   that is at most 10 %.
///
/// # Errors
/// The [`Refusal`].
pub fn depth_of(meshes: &[OnMesh]) -> Result<Estimate, Refusal> {
    let [.., coarse, medium, fine] = *meshes else {
        return Err(Refusal::TooFewMeshes);
    };
    let trend = trend([coarse, medium, fine]);
    if let Trend::Monotone { order } = trend
        && CREDIBLE_ORDERS.contains(&order)
    {
        let depth_mm = extrapolate(medium, fine, order.min(FORMAL_ORDER));
        let change = depth_mm / fine.value - 1.0;
        if change.abs() > LARGEST_EXTRAPOLATION {
            return Err(Refusal::TooSteep { change });
        }
        return Ok(Estimate {
            depth_mm,
            uncertainty_mm: change.abs() * fine.value,
        });
    }
    let estimate = finest([coarse, medium, fine]);
    let spread = estimate.uncertainty_mm / estimate.depth_mm;
    if spread <= AGREEMENT {
        return Ok(estimate);
    }
    Err(Refusal::NotConverged { trend, spread })
}

/// Depth on the finest of three meshes, with their largest difference as its uncertainty.
fn finest(meshes: [OnMesh; 3]) -> Estimate {
    let values = meshes.map(|mesh| mesh.value);
    let largest = values.into_iter().fold(f64::MIN, f64::max);
    let smallest = values.into_iter().fold(f64::MAX, f64::min);
    Estimate {
        depth_mm: values[2],
        uncertainty_mm: largest - smallest,
    }
}

#[cfg(test)]
#[path = "estimate_tests.rs"]
mod tests;
