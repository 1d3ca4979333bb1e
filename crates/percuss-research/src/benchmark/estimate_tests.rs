//! Tests of the convergence check on made-up sequences of meshes and on the stored reference.

use super::*;
use crate::benchmark::{cases, reference};

fn on(meshes: &[(u32, f64)]) -> Vec<OnMesh> {
    let meshes = meshes.iter();
    meshes
        .map(|&(cells, value)| OnMesh {
            cells: f64::from(cells),
            value,
        })
        .collect()
}

fn power(cells: &[u32], order: f64, constant: f64) -> Vec<OnMesh> {
    let value = |cells: u32| (cells, 8.5 - constant * f64::from(cells).powf(-order));
    on(&cells.iter().map(|&cells| value(cells)).collect::<Vec<_>>())
}

/// The rule is that of the axisymmetric answer, which has tests of its own; here it is what counts as a reference.
#[test]
fn an_error_of_first_order_is_removed() {
    for cells in [&[4, 6, 8][..], &[4, 8, 12], &[2, 4, 8, 16]] {
        for constant in [3.0, -3.0] {
            let estimate = depth_of(&power(cells, 1.0, constant)).unwrap();
            assert!((estimate.depth_mm - 8.5).abs() < 1e-9, "{estimate:?}");
            // With the factor of safety of three meshes.
            let off = 1.25 * 3.0 / f64::from(*cells.last().unwrap());
            assert!((estimate.uncertainty_mm - off).abs() < 1e-9);
        }
    }
}

#[test]
fn an_uncertainty_above_15_percent_is_refused() {
    let of = |meshes: &[(u32, f64)]| depth_of(&on(meshes));
    let oscillating = |amplitude: f64| of(&[(4, 8.0 - amplitude), (8, 8.0 + amplitude), (16, 8.0)]);
    assert!(oscillating(0.5).is_ok());
    let Err(Refusal::NotConverged { uncertainty }) = oscillating(0.61) else {
        panic!("{:?}", oscillating(0.61));
    };
    assert!((uncertainty - 1.22 / 8.0).abs() < 1e-12);
    // A shallow crater is known to 8 % of a cell: 0.025 mm on 8 cells of a radius of 2.5 mm.
    assert!(of(&[(4, 0.17), (6, 0.17), (8, 0.17)]).is_ok());
    assert!(of(&[(4, 0.16), (6, 0.16), (8, 0.16)]).is_err());
    for few in [&[][..], &[(8, 2.0)], &[(4, 2.0), (8, 2.0)]] {
        assert_eq!(of(few), Err(Refusal::TooFewMeshes));
    }
}

fn row(length_to_diameter: f64, cells: u32, depth: f64) -> Reference {
    Reference {
        length_to_diameter,
        cells_per_radius: cells,
        depth_of_penetration_mm: depth,
        ..reference::built_in().remove(0)
    }
}

#[test]
fn a_long_rod_that_stops_short_of_a_shorter_one_is_refused() {
    let references = |long: f64| {
        let mut rows = vec![row(3.0, 4, 0.9), row(3.0, 8, 0.95), row(3.0, 16, 0.975)];
        rows.extend(
            [0.95, 1.0, 1.0]
                .map(|part| part * long)
                .iter()
                .zip([4, 8, 16])
                .map(|(depth, cells)| row(10.0, cells, *depth)),
        );
        rows
    };
    let refused = |long: f64| {
        let checked = check_references(&cases(), &references(long));
        assert_eq!(checked.len(), 2);
        assert!(checked[0].estimate.is_ok());
        checked[1].estimate.err()
    };
    // 1.000 ± 0.031 mm at L/D 3, and ± 5 % at L/D 10.
    assert_eq!(refused(0.93), None);
    assert!(matches!(
        refused(0.92),
        Some(Refusal::ShorterRodDeeper {
            length_to_diameter: 3.0,
            ..
        })
    ));
}

/// Every entry that counts rests on three meshes.
#[test]
fn no_stored_entry_on_fewer_meshes_counts() {
    let checked = check_references(&cases(), &reference::built_in());
    for entry in checked {
        assert!(
            entry.meshes.len() >= 3 || entry.estimate.is_err(),
            "{entry:?}"
        );
    }
}
