//! Stored benchmark results: sound references, and depths that the models give now.

use percuss::model_error::{self, ErrorRecord};
use percuss_research::{
    benchmark::{self, BenchmarkCase, Design, reference},
    paper_case::{self, variants},
};

fn all_cases() -> Vec<BenchmarkCase> {
    Design::ALL
        .iter()
        .flat_map(|design| design.cases())
        .collect()
}

#[test]
fn reference_depths_are_of_the_design_and_close_their_energy_balance() {
    let (references, cases) = (reference::built_in(), all_cases());
    for reference in &references {
        assert!(
            cases.iter().any(|case| reference.is_of(case)),
            "of no case of the design: {reference:?}"
        );
        assert!(
            reference.energy_residual.abs() <= 0.01 && reference.depth_of_penetration_mm >= 0.0,
            "{reference:?}"
        );
    }
    // One mesh says nothing of its error.
    for case in cases {
        let meshes: Vec<u32> = references
            .iter()
            .filter(|reference| reference.is_of(&case))
            .map(|reference| reference.cells_per_radius)
            .collect();
        let mut different = meshes.clone();
        different.sort_unstable();
        different.dedup();
        assert_eq!(meshes.len(), different.len(), "twice on a mesh: {case:?}");
        assert!(
            references.is_empty() || meshes.len() >= 2,
            "{case:?}: {meshes:?}"
        );
    }
}

/// An entry that fails the convergence check is in no result, hence in no statistics, figures, findings or expected errors.
#[test]
fn a_refused_reference_is_left_out_of_the_stored_results() {
    let checked = benchmark::check_references(&all_cases(), &reference::built_in());
    let refused = checked.iter().filter(|entry| entry.estimate.is_err());
    assert!(refused.clone().count() > 10);
    for entry in refused {
        let stored = model_error::records().iter().any(|v| entry.case.is_of(v));
        assert!(!stored, "{entry:?}");
    }
}

#[test]
fn the_study_of_the_papers_case_closes_its_energy_balance_on_every_mesh() {
    let rows = paper_case::built_in();
    for &speed in paper_case::SPEEDS {
        for &(cells, radius) in paper_case::VARIANTS {
            let of = |row: &&paper_case::PaperCaseRow| {
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
        assert!(
            paper_case::SPEEDS.contains(&row.impact_velocity_m_s),
            "{row:?}"
        );
        assert!(
            row.energy_residual.abs() <= 0.01 && row.depth_of_penetration_mm > 0.0,
            "{row:?}"
        );
    }
}

/// Depths are sums over thousands of steps, which another machine rounds differently: 1e-6 is far below any change of a model.
const SAME: f64 = 1e-6;

#[test]
fn the_stored_results_are_those_of_the_models() {
    let now = benchmark::compare(&all_cases(), &reference::built_in()).unwrap();
    let stored = model_error::records();
    let key = |verdict: &ErrorRecord| {
        let ErrorRecord {
            candidate,
            projectile,
            target,
            length_to_diameter,
            impact_velocity_m_s,
            ..
        } = verdict;
        format!(
            "{candidate}: {projectile} on {target}, L/D {length_to_diameter}, {impact_velocity_m_s} m/s"
        )
    };
    let keys = |verdicts: &[ErrorRecord]| verdicts.iter().map(key).collect::<Vec<_>>();
    let remedy = "regenerate the benchmark: see CONTRIBUTING.md";
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
    let lines = variants::compute(&[]).unwrap();
    assert_eq!(lines.len(), 8 * paper_case::SPEEDS.len(), "{lines:?}");
    assert!(
        lines.iter().all(|line| line.depth_of_penetration_mm > 0.0),
        "{lines:?}"
    );
    let depth = |speed: f64, name: &str| {
        let own = |line: &&variants::VariantResult| {
            line.impact_velocity_m_s == speed && line.variant == name
        };
        lines.iter().find(own).unwrap().depth_of_penetration_mm
    };
    for &speed in paper_case::SPEEDS {
        // What holds the target less lets the rod deeper.
        assert!(depth(speed, "column") < depth(speed, "column, no border shear"));
        assert!(
            depth(speed, "column, no border shear")
                < depth(speed, "column, no border shear, factor 1")
        );
    }
}

/// The designs together span what the estimates of model errors need.
#[test]
fn the_designs_span_strengths_densities_and_laws() {
    let cases = all_cases();
    assert!(cases.len() >= 200);
    let ratios: Vec<[f64; 2]> = cases
        .iter()
        .map(|case| model_error::ratios(&case.scenario().unwrap()).unwrap())
        .collect();
    let range = |k: usize| {
        let values = || ratios.iter().map(|ratio| ratio[k]);
        (
            values().fold(f64::MAX, f64::min),
            values().fold(f64::MIN, f64::max),
        )
    };
    let (weakest, strongest) = range(0);
    assert!(weakest < 0.15 && strongest > 9.0, "{weakest} {strongest}");
    let (lightest, densest) = range(1);
    assert!(lightest < 0.16 && densest > 7.0, "{lightest} {densest}");
    for case in Design::Spread.cases() {
        assert!((1.0..=20.0).contains(&case.length_to_diameter));
        assert!((100.0..=2500.0).contains(&case.speed));
    }
}

/// Where the pairs of materials are left out in turn, 75 to 85 % of a pair's cases lie in their intervals.
#[test]
fn intervals_of_model_errors_cover_pairs_that_are_left_out() {
    for name in [
        "chain: expanding-cavity",
        "chain: column",
        "walker_anderson",
        "crater_energy",
    ] {
        let found = model_error::coverage(name).unwrap();
        assert!(found.pairs > 25, "{name}: {found:?}");
        assert!((0.75..=0.85).contains(&found.coverage), "{name}: {found:?}");
    }
}
