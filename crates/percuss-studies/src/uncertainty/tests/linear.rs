//! A linear model of normal variables: every number is known exactly.

use super::*;

/// Normal scores of the percentiles.
const SCORES: [(f64, f64); 7] = [
    (1.0, -2.326_347_874_040_841),
    (5.0, -1.644_853_626_951_472_7),
    (25.0, -0.674_489_750_196_081_7),
    (50.0, 0.0),
    (75.0, 0.674_489_750_196_081_7),
    (95.0, 1.644_853_626_951_472_7),
    (99.0, 2.326_347_874_040_841),
];

#[test]
fn a_linear_model_has_its_exact_statistics_and_indices() {
    let found = analysed(&study(NORMALS), &LINEAR, &settings(4096));
    assert_eq!(found.quantities.len(), 1);
    let depth = &found.quantities[0];
    let deviation = (0..3).map(part).sum::<f64>().sqrt();
    assert_eq!(depth.quantity, "depth_of_penetration_mm");
    assert!((depth.nominal.unwrap() - mean()).abs() < 1e-9);
    assert!((depth.statistics.mean - mean()).abs() < 1e-3 * deviation);
    assert!((depth.statistics.standard_deviation / deviation - 1.0).abs() < 2e-3);
    for (percent, score) in SCORES {
        let found = depth.statistics.percentile(percent);
        let exact = mean() + score * deviation;
        let off = (found.value - exact).abs() / deviation;
        // The tails have fewer runs.
        assert!(
            off < if score.abs() > 2.0 { 0.03 } else { 0.01 },
            "{percent}: {off}"
        );
        assert!(
            found.low.unwrap() <= exact && exact <= found.high.unwrap(),
            "{percent}"
        );
    }
    let indices = depth.indices.as_ref().unwrap();
    assert_eq!(indices.rows, 2048);
    for (i, index) in indices.parameters.iter().enumerate() {
        let exact = part(i) / deviation.powi(2);
        holds(index.first_order, exact, 0.01, &index.key);
        holds(index.total, exact, 0.01, &index.key);
    }
    // The bars of the linear model are exact, and the longest stands first.
    for bar in &depth.tornado {
        let i = found
            .inputs
            .iter()
            .position(|input| input.key == bar.key)
            .unwrap();
        let exact = SLOPES[i] * DEVIATIONS[i] * 1.644_853_626_951_472_7;
        assert!((bar.at_high.unwrap() - mean() - exact).abs() < 1e-9);
        assert!((bar.at_low.unwrap() - mean() + exact).abs() < 1e-9);
    }
    assert!(
        depth
            .tornado
            .windows(2)
            .all(|pair| pair[0].length() >= pair[1].length())
    );
    assert_eq!(found.runs, 1 + 6 + 4096 + 4 * 2048);
}

#[test]
fn correlated_parameters_have_their_exact_spread_and_no_indices() {
    let found = analysed(
        &study(&format!("{NORMALS}{CORRELATION}")),
        &LINEAR,
        &settings(4096),
    );
    let depth = &found.quantities[0];
    let shared = 2.0 * 0.6 * SLOPES[0] * SLOPES[1] * DEVIATIONS[0] * DEVIATIONS[1];
    let deviation = ((0..3).map(part).sum::<f64>() + shared).sqrt();
    assert!((depth.statistics.mean - mean()).abs() < 2e-3 * deviation);
    assert!((depth.statistics.standard_deviation / deviation - 1.0).abs() < 3e-3);
    assert!(depth.indices.is_none());
    assert!(found.no_indices.unwrap().contains("correlated"));
    assert_eq!(found.runs, 1 + 6 + 4096);
}

#[test]
fn standard_errors_shrink_and_means_err_less() {
    let study = study(NORMALS);
    let of = |samples| {
        let settings = Settings {
            indices: false,
            ..settings(samples)
        };
        analysed(&study, &LINEAR, &settings).quantities[0]
            .statistics
            .clone()
    };
    let (few, many) = (of(256), of(4096));
    assert!((few.standard_error / many.standard_error / 4.0 - 1.0).abs() < 0.02);
    for statistics in [few, many] {
        assert!((statistics.mean - mean()).abs() < 0.2 * statistics.standard_error);
    }
}

#[test]
fn bands_hold_the_velocity_and_spread_the_rest() {
    let settings = Settings {
        indices: false,
        velocities: vec![150.0, 400.0],
        ..settings(256)
    };
    let found = analysed(&study(NORMALS), &LINEAR, &settings);
    let deviation = (part(1) + part(2)).sqrt();
    for band in &found.bands {
        let exact = mean() + SLOPES[0] * (band.impact_velocity_m_s - MEANS[0]);
        let statistics = band.quantities[0].statistics.as_ref().unwrap();
        assert!(
            (statistics.mean - exact).abs() < 0.02 * deviation,
            "{}",
            band.impact_velocity_m_s
        );
        assert!((statistics.standard_deviation / deviation - 1.0).abs() < 0.02);
        assert_eq!(band.runs, 256);
    }
}
