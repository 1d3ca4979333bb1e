//! Depth of a shot by the reference, and the convergence check that a reference has to pass before it counts.

use serde::Serialize;

use super::{Reference, Shot};
use crate::richardson::{CREDIBLE_ORDERS, OnMesh, Trend, extrapolate, trend};

/// Order of the dominant error. Contact on a grid keeps bodies about 0.8 of a cell apart, which makes a projectile wider by as much: a
/// rigid flat rod (L/D 3, 17600 kg/m³, 300 m/s, perfectly plastic target of 300 MPa) goes 5.96 and 7.14 mm deep on 4 and 8 cells per
/// radius, 8.32 mm extrapolated, and 8.58 mm by \[forrestal1988\] with a flat nose.
const FORMAL_ORDER: f64 = 1.0;
/// Largest change by an extrapolation from three meshes, as a part of the depth on the finest one.
const STEEPEST: f64 = 0.25;
/// Largest spread of three meshes that give no extrapolation, as a part of the depth on the finest one.
const AGREEMENT: f64 = 0.1;
/// Largest change by an extrapolation from two meshes, whose order is assumed.
const STEEPEST_PROVISIONAL: f64 = 0.15;
/// Uncertainty of an extrapolation from two meshes over its distance from the finer one, and its least part of the depth. Of 33 such
/// extrapolations a third mesh fell within one distance in 19, and within two distances or 5 % in 32.
const PROVISIONAL_FACTOR: f64 = 2.0;
const PROVISIONAL_LEAST: f64 = 0.05;

/// Depth of a shot by the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Depth of penetration, extrapolated in the cell size where the meshes allow it [mm].
    pub depth_mm: f64,
    /// Uncertainty that the cell size leaves, either way [mm].
    pub uncertainty_mm: f64,
    /// Meshes that it rests on: three, or two where it is provisional.
    pub meshes: usize,
}

/// Reason why a reference does not count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Refusal {
    /// Fewer than two meshes.
    TooFewMeshes,
    /// Three meshes give no extrapolation and do not agree.
    NotConverged {
        /// What their sequence is.
        trend: Trend,
        /// Largest difference as a part of the depth on the finest mesh.
        spread: f64,
    },
    /// The extrapolation changes the depth by more than its limit.
    TooSteep {
        /// Change as a part of the depth on the finest mesh.
        change: f64,
        /// Its limit.
        limit: f64,
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
    pub fn in_words(&self) -> String {
        match *self {
            Self::TooFewMeshes => "fewer than two meshes".to_owned(),
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
            Self::TooSteep { change, limit } => format!(
                "the extrapolation changes the depth by {:+.0} %, more than {:.0} %",
                100.0 * change,
                100.0 * limit
            ),
            Self::ShorterRodDeeper {
                length_to_diameter,
                depth_mm,
            } => format!("the rod of L/D {length_to_diameter} goes deeper ({depth_mm:.3} mm)"),
        }
    }
}

/// The reference of one shot, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedReference {
    /// The shot.
    pub shot: Shot,
    /// Depth [mm] on every mesh by cells per radius, from coarse to fine.
    pub meshes: Vec<OnMesh>,
    /// Its depth, or why it does not count.
    pub estimate: Result<Estimate, Refusal>,
}

impl CheckedReference {
    /// The shot with the reason why it has no reference that counts.
    pub fn refused(&self) -> Option<RefusedReference> {
        let refusal = self.estimate.err()?;
        Some(RefusedReference {
            projectile: self.shot.projectile.clone(),
            target: self.shot.target.clone(),
            length_to_diameter: self.shot.length_to_diameter,
            impact_velocity_m_s: self.shot.speed,
            reason: refusal.in_words(),
        })
    }
}

/// A shot that is left out of all statistics.
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
    /// Why its reference does not count.
    pub reason: String,
}

/// Checks the reference of every shot that has one.
///
/// Beside the check of each shot's meshes ([`depth_of`]), a longer rod must not stop short of a shorter one of the same materials and
/// velocity by more than both uncertainties; the longer rod, which has the coarser meshes, is refused.
pub fn check_references(shots: &[Shot], references: &[Reference]) -> Vec<CheckedReference> {
    let alone: Vec<CheckedReference> = shots
        .iter()
        .filter_map(|shot| {
            let meshes = meshes(references, shot);
            (!meshes.is_empty()).then(|| CheckedReference {
                shot: shot.clone(),
                estimate: depth_of(&meshes),
                meshes,
            })
        })
        .collect();
    let mut checked = alone.clone();
    for entry in &mut checked {
        let Ok(own) = entry.estimate else { continue };
        let shorter = alone.iter().filter(|other| {
            let Shot {
                projectile,
                target,
                length_to_diameter,
                speed,
            } = &other.shot;
            (projectile, target) == (&entry.shot.projectile, &entry.shot.target)
                && *speed == entry.shot.speed
                && *length_to_diameter < entry.shot.length_to_diameter
        });
        let mut deeper = shorter.filter_map(|other| {
            let depth = other.estimate.ok()?;
            let gap = depth.depth_mm - own.depth_mm - depth.uncertainty_mm - own.uncertainty_mm;
            (gap > 0.0).then_some((other.shot.length_to_diameter, depth.depth_mm))
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

/// Depths of a shot by cells per radius, from coarse to fine.
fn meshes(references: &[Reference], shot: &Shot) -> Vec<OnMesh> {
    let own = references
        .iter()
        .filter(|row| row.is_of(shot) && row.depth_of_penetration_mm.is_finite());
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

/// Depth [mm] by the finest meshes, in order from coarse to fine; or why they give none.
///
/// - **Three meshes**, monotone, with an observed order of [`CREDIBLE_ORDERS`]: extrapolated at that order, but at most at the formal order 1
///   of contact, and refused where that changes the depth by more than 25 %. The uncertainty is the whole change.
/// - **Three meshes** without such an order: not extrapolated. The finest one counts, with the largest difference as its uncertainty, where
///   that is at most 10 %.
/// - **Two meshes**: provisional, extrapolated at order 1, and refused where that changes the depth by more than 15 %. The uncertainty is
///   twice the change, and at least 5 %.
///
/// # Errors
/// The [`Refusal`].
pub fn depth_of(meshes: &[OnMesh]) -> Result<Estimate, Refusal> {
    match *meshes {
        [] | [_] => Err(Refusal::TooFewMeshes),
        [medium, fine] => {
            let (depth_mm, change) =
                extrapolated([medium, fine], FORMAL_ORDER, STEEPEST_PROVISIONAL)?;
            let part = (PROVISIONAL_FACTOR * change.abs()).max(PROVISIONAL_LEAST);
            Ok(Estimate {
                depth_mm,
                uncertainty_mm: part * fine.value,
                meshes: 2,
            })
        }
        [.., coarse, medium, fine] => {
            let trend = trend([coarse, medium, fine]);
            if let Trend::Monotone { order } = trend
                && CREDIBLE_ORDERS.contains(&order)
            {
                let order = order.min(FORMAL_ORDER);
                let (depth_mm, change) = extrapolated([medium, fine], order, STEEPEST)?;
                return Ok(Estimate {
                    depth_mm,
                    uncertainty_mm: change.abs() * fine.value,
                    meshes: 3,
                });
            }
            let estimate = finest([coarse, medium, fine]);
            let spread = estimate.uncertainty_mm / estimate.depth_mm;
            if spread <= AGREEMENT {
                return Ok(estimate);
            }
            Err(Refusal::NotConverged { trend, spread })
        }
    }
}

/// Depth extrapolated at an order, and its change as a part of that on the finer mesh, which must not be beyond a limit.
fn extrapolated(
    [medium, fine]: [OnMesh; 2],
    order: f64,
    limit: f64,
) -> Result<(f64, f64), Refusal> {
    let depth = extrapolate(medium, fine, order);
    let change = depth / fine.value - 1.0;
    match change.abs() <= limit {
        true => Ok((depth, change)),
        false => Err(Refusal::TooSteep { change, limit }),
    }
}

/// Depth on the finest of three meshes, with their largest difference as its uncertainty.
pub(super) fn finest(meshes: [OnMesh; 3]) -> Estimate {
    let values = meshes.map(|mesh| mesh.value);
    let largest = values.into_iter().fold(f64::MIN, f64::max);
    let smallest = values.into_iter().fold(f64::MAX, f64::min);
    Estimate {
        depth_mm: values[2],
        uncertainty_mm: largest - smallest,
        meshes: 3,
    }
}

#[cfg(test)]
#[path = "estimate_tests.rs"]
mod tests;
