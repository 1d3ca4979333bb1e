//! What the reference says of a shot when its cells are thought away.

use super::{Reference, Shot};

/// Depth of a shot by the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Depth of penetration [mm], extrapolated in the cell size where there are two meshes.
    pub depth_mm: f64,
    /// How far that lies from the finest mesh [mm]; unknown with one mesh.
    pub uncertainty_mm: Option<f64>,
    /// Cells along the projectile's radius of the finest mesh.
    pub finest: u32,
}

/// Depth of a shot by its two finest meshes, extrapolated at first order in the cell size h \[richardson1911, roache1994\]:
/// `d = d₁ + (d₁ − d₂)/(r − 1)` with `r = h₂/h₁`, the finest mesh having index 1.
///
/// First order, since contact on a grid keeps bodies about 0.8 of a cell apart, which makes a projectile wider by as much: a rigid
/// flat rod (L/D 3, 17600 kg/m³, 300 m/s, perfectly plastic target of 300 MPa) goes 5.96 and 7.14 mm deep on 4 and 8 cells per radius,
/// 8.32 mm extrapolated, and 8.58 mm by \[forrestal1988\] with a flat nose.
///
/// `None` when the shot has no reference, or one whose extrapolation is not positive: meshes that coarse say nothing of it.
pub fn estimate(references: &[Reference], shot: &Shot) -> Option<Estimate> {
    let mut own: Vec<(u32, f64)> = references
        .iter()
        .filter(|reference| reference.is_of(shot))
        .map(|reference| {
            (
                reference.cells_per_radius,
                reference.depth_of_penetration_mm,
            )
        })
        .filter(|(_, depth)| depth.is_finite())
        .collect();
    own.sort_by_key(|(cells, _)| std::cmp::Reverse(*cells));
    own.dedup_by_key(|(cells, _)| *cells);
    extrapolate(&own).filter(|estimate| estimate.depth_mm > 0.0)
}

/// From cells along a length and the depth [mm], the finest mesh first.
pub(super) fn extrapolate(meshes: &[(u32, f64)]) -> Option<Estimate> {
    match *meshes {
        [] => None,
        [(finest, depth_mm)] => Some(Estimate {
            depth_mm,
            uncertainty_mm: None,
            finest,
        }),
        [(finest, fine), (coarser, coarse), ..] => {
            let ratio = f64::from(finest) / f64::from(coarser);
            let depth_mm = fine + (fine - coarse) / (ratio - 1.0);
            Some(Estimate {
                depth_mm,
                uncertainty_mm: Some((depth_mm - fine).abs()),
                finest,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::extrapolate;

    #[test]
    fn an_error_of_first_order_is_removed() {
        let depth = |cells: u32| (cells, 8.5 - 7.7 / f64::from(cells));
        for meshes in [[8, 4, 2], [12, 8, 4], [9, 8, 4]] {
            let estimate = extrapolate(&meshes.map(depth)).unwrap();
            assert!((estimate.depth_mm - 8.5).abs() < 1e-12, "{estimate:?}");
            let off = 7.7 / f64::from(meshes[0]);
            assert!((estimate.uncertainty_mm.unwrap() - off).abs() < 1e-12);
        }
    }

    #[test]
    fn one_mesh_is_taken_as_it_is() {
        let estimate = extrapolate(&[(8, 2.0)]).unwrap();
        assert_eq!((estimate.depth_mm, estimate.uncertainty_mm), (2.0, None));
        assert_eq!(extrapolate(&[]), None);
    }
}
