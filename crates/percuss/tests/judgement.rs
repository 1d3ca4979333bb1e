//! The stored judgement: what it rests on is sound, and it is what the models of today give.

use percuss::judge::{self, Verdict, ablation, reference, shots, study};

#[test]
fn reference_depths_are_of_the_design_and_balance_their_books() {
    let (references, shots) = (reference::built_in(), shots());
    for reference in &references {
        assert!(
            shots.iter().any(|shot| reference.is_of(shot)),
            "of no shot of the design: {reference:?}"
        );
        assert!(
            reference.energy_residual.abs() <= 0.01 && reference.depth_of_penetration_mm > 0.0,
            "{reference:?}"
        );
    }
    // One mesh says nothing of its error.
    for shot in shots {
        let meshes: Vec<u32> = references
            .iter()
            .filter(|reference| reference.is_of(&shot))
            .map(|reference| reference.cells_per_radius)
            .collect();
        let mut different = meshes.clone();
        different.sort_unstable();
        different.dedup();
        assert_eq!(meshes.len(), different.len(), "twice on a mesh: {shot:?}");
        assert!(
            references.is_empty() || meshes.len() >= 2,
            "{shot:?}: {meshes:?}"
        );
    }
}

/// An entry that fails the convergence check is in no verdict, hence in no statistics, figures, findings or expected errors.
#[test]
fn a_refused_reference_is_left_out_of_the_stored_judgement() {
    let checked = judge::check_references(&shots(), &reference::built_in());
    let refused = checked.iter().filter(|entry| entry.estimate.is_err());
    assert!(refused.clone().count() > 10);
    for entry in refused {
        let stored = judge::verdicts().iter().any(|v| v.is_of(&entry.shot));
        assert!(!stored, "{entry:?}");
    }
}

#[test]
fn the_study_of_the_papers_case_closes_its_energy_balance_on_every_mesh() {
    let rows = study::built_in();
    for &speed in study::SPEEDS {
        for &(cells, radius) in study::VARIANTS {
            let of = |row: &&study::Study| {
                row.impact_velocity_m_s == speed
                    && row.cells_per_radius == cells
                    && row.target_radius_mm == radius
            };
            assert_eq!(
                rows.iter().filter(of).count(),
                1,
                "{speed} {cells} {radius}"
            );
        }
    }
    for row in rows {
        assert!(study::SPEEDS.contains(&row.impact_velocity_m_s), "{row:?}");
        assert!(
            row.energy_residual.abs() <= 0.01 && row.depth_of_penetration_mm > 0.0,
            "{row:?}"
        );
    }
}

/// Depths are sums over thousands of steps, which another machine rounds differently: 1e-6 is far below any change of a model.
const SAME: f64 = 1e-6;

#[test]
fn the_stored_judgement_is_what_judging_gives() {
    let now = judge::judge(&shots(), &reference::built_in()).unwrap();
    let stored = judge::verdicts();
    let key = |verdict: &Verdict| {
        let Verdict {
            contender,
            projectile,
            target,
            length_to_diameter,
            impact_velocity_m_s,
            ..
        } = verdict;
        format!(
            "{contender}: {projectile} on {target}, L/D {length_to_diameter}, {impact_velocity_m_s} m/s"
        )
    };
    let keys = |verdicts: &[Verdict]| verdicts.iter().map(key).collect::<Vec<_>>();
    let remedy = "write the judgement anew: see CONTRIBUTING.md";
    assert_eq!(keys(stored), keys(&now), "{remedy}");
    for (stored, now) in stored.iter().zip(&now) {
        let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
        assert!(
            stored.regime == now.regime
                && same(stored.depth_of_penetration_mm, now.depth_of_penetration_mm)
                && same(stored.reference_depth_mm, now.reference_depth_mm)
                && same(
                    stored.reference_uncertainty_mm,
                    now.reference_uncertainty_mm
                ),
            "{remedy}: stored {stored:?}, now {now:?}"
        );
    }
}

#[test]
fn every_variant_of_the_ablation_answers() {
    let lines = ablation::ablation(&[]).unwrap();
    assert_eq!(lines.len(), 8 * study::SPEEDS.len(), "{lines:?}");
    assert!(
        lines.iter().all(|line| line.depth_of_penetration_mm > 0.0),
        "{lines:?}"
    );
    let depth = |speed: f64, name: &str| {
        let own =
            |line: &&ablation::Line| line.impact_velocity_m_s == speed && line.variant == name;
        lines.iter().find(own).unwrap().depth_of_penetration_mm
    };
    for &speed in study::SPEEDS {
        // What holds the target less lets the rod deeper.
        assert!(depth(speed, "column") < depth(speed, "column, no border shear"));
        assert!(
            depth(speed, "column, no border shear")
                < depth(speed, "column, no border shear, factor 1")
        );
    }
}
