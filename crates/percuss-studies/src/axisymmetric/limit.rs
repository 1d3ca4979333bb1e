//! Limit of a number on successively finer meshes, with its discretisation uncertainty.

use crate::richardson::{OnMesh, SAFETY, Trend, extrapolate, trend};

/// Observed orders that are taken for those of convergence. The scheme is of second order where nothing breaks; three meshes whose sizes
/// differ by a factor of two find more by chance.
const CREDIBLE: std::ops::RangeInclusive<f64> = 0.5..=3.0;
/// Highest order of an extrapolation: that of the scheme.
pub const HIGHEST_ORDER: f64 = 2.0;
/// Lowest order of the error of a single mesh, and of an extrapolation: at lower orders it makes depths worse, by up to 60 % in the cases of
/// the benchmark.
const FIRST: f64 = 1.0;
/// Error of an observed order by rounding.
const ROUNDING: f64 = 1e-6;
/// Least uncertainty, as a part of what the impact changed.
const LEAST: f64 = 0.01;

/// Limit of a number in the cell size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshLimit {
    /// The number.
    pub value: f64,
    /// Half width of its uncertainty.
    pub uncertainty: f64,
    /// Observed order of convergence, where the value is extrapolated.
    pub order: Option<f64>,
}

/// Limit of the values on two or more meshes, from coarse to fine; the last three count. `untouched` is the value if the impact changed
/// nothing: 0 for a depth, the initial length for a final length. `resolution` is the smallest difference that the finest mesh shows.
///
/// - **Extrapolated**: three monotone values with an observed order p of 1 to 3. The order of the extrapolation is p, at most 2. The
///   uncertainty is 1.25 times the larger of the change by the extrapolation and its difference from an extrapolation at first order; the
///   factor is that of the grid convergence index \[roache1994\].
/// - **At an order of 0.5 to 1** the value of the finest mesh. The uncertainty is the change that an extrapolation would make.
/// - **Otherwise** the value of the finest mesh. The uncertainty is the larger of the largest difference between meshes and the change
///   that an extrapolation at first order by the two finest would make.
///
/// The uncertainty is at least the resolution, and 1 % of the difference between the value and `untouched`. With one mesh there is no
/// limit.
pub fn limit(meshes: &[OnMesh], untouched: f64, resolution: f64) -> Option<MeshLimit> {
    let [.., medium, fine] = *meshes else {
        return None;
    };
    let at_first_order = extrapolate(medium, fine, FIRST);
    let found = match meshes {
        [.., coarse, _, _] => order([*coarse, medium, fine]).map(|order| {
            let value = extrapolate(medium, fine, order.min(HIGHEST_ORDER));
            let change = (value - fine.value).abs();
            if order < FIRST - ROUNDING {
                MeshLimit {
                    value: fine.value,
                    uncertainty: change,
                    order: None,
                }
            } else {
                MeshLimit {
                    value,
                    uncertainty: SAFETY * change.max((value - at_first_order).abs()),
                    order: Some(order),
                }
            }
        }),
        _ => None,
    };
    let limit = found.unwrap_or_else(|| MeshLimit {
        value: fine.value,
        uncertainty: spread(meshes).max((at_first_order - fine.value).abs()),
        order: None,
    });
    let least = LEAST * (limit.value - untouched).abs();
    Some(MeshLimit {
        uncertainty: limit.uncertainty.max(least).max(resolution),
        ..limit
    })
}

/// Observed order of three meshes, where it is credible. Values that agree to rounding have none.
fn order(meshes: [OnMesh; 3]) -> Option<f64> {
    match trend(meshes) {
        Trend::Monotone { order } => CREDIBLE.contains(&order).then_some(order),
        Trend::Exact | Trend::Oscillating | Trend::Diverging => None,
    }
}

/// Largest difference among the last three meshes.
fn spread(meshes: &[OnMesh]) -> f64 {
    let last = &meshes[meshes.len().saturating_sub(3)..];
    let values = || last.iter().map(|mesh| mesh.value);
    values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
}
