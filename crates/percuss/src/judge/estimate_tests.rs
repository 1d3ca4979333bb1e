//! The convergence check on made-up sequences of meshes, and on the stored reference.

use super::*;
use crate::judge::{reference, shots};

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

#[test]
fn an_error_of_first_order_is_removed() {
    for cells in [
        &[4, 8][..],
        &[6, 8],
        &[4, 6, 8],
        &[4, 8, 12],
        &[2, 4, 8, 16],
    ] {
        for constant in [3.0, -3.0] {
            let estimate = depth_of(&power(cells, 1.0, constant)).unwrap();
            assert!((estimate.depth_mm - 8.5).abs() < 1e-9, "{estimate:?}");
            let off = 3.0 / f64::from(*cells.last().unwrap());
            let expected = if cells.len() == 2 { 2.0 * off } else { off };
            assert!((estimate.uncertainty_mm - expected).abs() < 1e-9);
            assert_eq!(estimate.meshes, cells.len().min(3));
        }
    }
}

#[test]
fn a_slower_order_is_followed_and_a_faster_one_is_not_trusted() {
    let slow = depth_of(&power(&[4, 8, 12], 0.6, 2.0)).unwrap();
    assert!((slow.depth_mm - 8.5).abs() < 1e-9, "{slow:?}");
    let meshes = power(&[4, 8, 16], 2.0, 20.0);
    let fast = depth_of(&meshes).unwrap();
    // At the formal order 1 the step from 8 to 16 cells is taken once more.
    let step = meshes[2].value - meshes[1].value;
    assert!((fast.depth_mm - (meshes[2].value + step)).abs() < 1e-12);
    assert!((fast.uncertainty_mm - step).abs() < 1e-12);
    assert!((fast.depth_mm - 8.5).abs() < fast.uncertainty_mm);
}

#[test]
fn three_meshes_without_an_order_count_where_they_agree() {
    let of = |meshes: &[(u32, f64)]| depth_of(&on(meshes));
    // Oscillating, diverging, too slow and too fast, each within 10 % and beyond.
    for (good, bad) in [
        ([0.95, 1.04, 1.0], [0.9, 1.05, 1.0]),
        ([0.94, 0.96, 1.0], [0.86, 0.92, 1.0]),
        ([0.96, 0.98, 1.0], [0.86, 0.928, 1.0]),
        ([0.95, 0.998, 1.0], [0.85, 0.995, 1.0]),
    ] {
        let on = |values: [f64; 3]| of(&[(4, values[0]), (8, values[1]), (16, values[2])]);
        let spread = |values: [f64; 3]| {
            values.iter().fold(f64::MIN, |a, b| a.max(*b))
                - values.iter().fold(f64::MAX, |a, b| a.min(*b))
        };
        let estimate = on(good).unwrap();
        assert_eq!(estimate.depth_mm, 1.0);
        assert_eq!(estimate.uncertainty_mm, spread(good));
        let Err(Refusal::NotConverged { spread: found, .. }) = on(bad) else {
            panic!("{bad:?}: {:?}", on(bad));
        };
        assert_eq!(found, spread(bad));
    }
    assert_eq!(of(&[]), Err(Refusal::TooFewMeshes));
    assert_eq!(of(&[(8, 2.0)]), Err(Refusal::TooFewMeshes));
}

#[test]
fn a_steep_extrapolation_is_refused() {
    let change = |meshes: &[(u32, f64)]| match depth_of(&on(meshes)) {
        Err(Refusal::TooSteep { change, limit }) => Some((change, limit)),
        _ => None,
    };
    // 10 % between 4 and 6 cells are 20 % of extrapolation; between 4 and 8 they are 10 %.
    let (steep, limit) = change(&[(4, 0.9), (6, 1.0)]).unwrap();
    assert!((steep - 0.2).abs() < 1e-12 && limit == 0.15);
    assert_eq!(change(&[(4, 0.9), (8, 1.0)]), None);
    // Downwards it is as steep: a depth cannot be extrapolated to nothing.
    assert!(change(&[(4, 1.1), (6, 1.0)]).is_some());
    assert!(change(&[(4, 2.0), (8, 1.0)]).is_some());
    // Three meshes know their order, and may be steeper.
    assert!(depth_of(&power(&[4, 8, 12], 1.0, 20.0)).is_ok());
    let Err(Refusal::TooSteep {
        change: steep,
        limit,
    }) = depth_of(&power(&[4, 8, 12], 1.0, 24.0))
    else {
        panic!("not refused");
    };
    assert!(steep > 0.25 && limit == 0.25, "{steep}");
}

#[test]
fn a_small_difference_of_two_meshes_claims_no_accuracy() {
    let estimate = depth_of(&on(&[(4, 0.999), (8, 1.0)])).unwrap();
    assert_eq!(estimate.uncertainty_mm, 0.05);
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
        vec![
            row(3.0, 4, 0.95),
            row(3.0, 8, 1.0),
            row(10.0, 4, long),
            row(10.0, 8, long),
        ]
    };
    let refused = |long: f64| {
        let checked = check_references(&shots(), &references(long));
        assert_eq!(checked.len(), 2);
        assert!(checked[0].estimate.is_ok());
        checked[1].estimate.err()
    };
    // 1.05 ± 0.10 mm at L/D 3, and ± 5 % at L/D 10.
    assert_eq!(refused(0.91), None);
    assert!(matches!(
        refused(0.90),
        Some(Refusal::ShorterRodDeeper {
            length_to_diameter: 3.0,
            ..
        })
    ));
}

/// Finer runs of three entries of the stored reference disagree with what two of its meshes extrapolate to: 0.91 mm on 12 cells, 65.2 and
/// 25.7 mm on 8. The check refuses them by its rule.
#[test]
fn entries_that_finer_runs_contradict_are_refused() {
    let checked = check_references(&shots(), &reference::built_in());
    assert!(checked.len() == shots().len());
    for (projectile, target, speed, contradicted) in [
        ("4340-johnson-cook", "6061-t6-lesuer", 150.0, 0.567),
        ("ofhc-copper-johnson-cook", "6061-t6-lesuer", 1500.0, 92.6),
        ("4340-johnson-cook", "weldox-460-e-borvik", 1500.0, 34.7),
        // Less deep than the rod of L/D 3.
        ("6061-t6-lesuer", "4340-johnson-cook", 1500.0, 0.72),
    ] {
        let entry = checked.iter().find(|entry| {
            (entry.shot.projectile.as_str(), entry.shot.target.as_str()) == (projectile, target)
                && entry.shot.length_to_diameter == 10.0
                && entry.shot.speed == speed
        });
        let entry = entry.unwrap();
        assert!(entry.estimate.is_err(), "{entry:?}");
        // Two of the meshes would give what the finer runs contradict.
        let [coarse, medium] = [4.0, 6.0].map(|cells| {
            *entry
                .meshes
                .iter()
                .find(|mesh| mesh.cells == cells)
                .unwrap()
        });
        let two = extrapolate(coarse, medium, 1.0);
        assert!((two / contradicted - 1.0).abs() < 2e-3, "{two}");
        assert!(depth_of(&[coarse, medium]).is_err());
    }
}
