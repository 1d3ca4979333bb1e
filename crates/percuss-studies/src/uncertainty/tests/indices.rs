//! Sobol' indices of functions whose indices are known.

use std::f64::consts::PI;

use super::super::{Estimate, SobolIndices, design::Rows, indices::indices};
use super::holds;

/// Indices of a function of numbers drawn evenly between 0 and 1.
fn indices_of(function: &dyn Fn(&[f64]) -> f64, dimensions: usize, seed: u64) -> SobolIndices {
    indices_on(4096, function, dimensions, seed)
}

fn indices_on(
    count: u64,
    function: &dyn Fn(&[f64]) -> f64,
    dimensions: usize,
    seed: u64,
) -> SobolIndices {
    let rows = Rows::new(count, seed, dimensions);
    let row = |i| {
        let others = (0..rows.others()).map(|place| rows.other(i, place));
        let points = std::iter::once(rows.first(i)).chain(others);
        points.map(|point| function(&point)).collect()
    };
    let values: Vec<Vec<f64>> = (0..count).map(row).collect();
    let keys: Vec<String> = (0..dimensions).map(|i| i.to_string()).collect();
    let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
    indices(&values, &keys, seed).unwrap()
}

/// Ishigami's function: `sin x + 7 sin² y + 0.1 z⁴ sin x`, each between -π and π.
#[test]
fn indices_of_ishigamis_function_are_the_exact_ones() {
    let (a, b) = (7.0, 0.1_f64);
    let function = |u: &[f64]| {
        let x: Vec<f64> = u.iter().map(|u| PI * (2.0 * u - 1.0)).collect();
        x[0].sin() + a * x[1].sin().powi(2) + b * x[2].powi(4) * x[0].sin()
    };
    let v1 = 0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2);
    let v2 = a * a / 8.0;
    let v13 = b * b * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
    let v = v1 + v2 + v13;
    for seed in [1, 2] {
        let found = indices_of(&function, 3, seed).parameters;
        let first = [v1, v2, 0.0];
        let total = [v1 + v13, v2, v13];
        for i in 0..3 {
            holds(
                found[i].first_order,
                first[i] / v,
                0.02,
                &format!("first {i}"),
            );
            holds(found[i].total, total[i] / v, 0.02, &format!("total {i}"));
        }
    }
}

/// Sobol's function: the product of `(|4 x - 2| + a) / (1 + a)`.
#[test]
fn indices_of_the_g_function_are_the_exact_ones() {
    let a = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0];
    let function = |u: &[f64]| {
        let factor = |(u, a): (&f64, &f64)| ((4.0 * u - 2.0).abs() + a) / (1.0 + a);
        u.iter().zip(&a).map(factor).product::<f64>()
    };
    let parts: Vec<f64> = a
        .iter()
        .map(|a| 1.0 / 3.0 / (1.0 + a) / (1.0 + a))
        .collect();
    let whole: f64 = parts.iter().map(|v| 1.0 + v).product::<f64>() - 1.0;
    let found = indices_of(&function, 6, 4).parameters;
    for (i, part) in parts.iter().enumerate() {
        let others = (whole + 1.0) / (1.0 + part);
        holds(
            found[i].first_order,
            part / whole,
            0.02,
            &format!("first {i}"),
        );
        holds(
            found[i].total,
            part * others / whole,
            0.02,
            &format!("total {i}"),
        );
    }
}

/// A parameter that causes nearly all has a narrow interval as well: products with A in full leave ±0.12 and ±0.09 on as many rows.
#[test]
fn indices_of_a_dominant_parameter_are_narrow() {
    let slopes = [3.0, 0.8, 0.5, 0.2];
    let function = |u: &[f64]| slopes.iter().zip(u).map(|(s, u)| s * u).sum::<f64>();
    let whole: f64 = slopes.iter().map(|s| s * s).sum();
    for seed in [1, 2, 3] {
        let found = indices_on(512, &function, 4, seed).parameters;
        for (i, slope) in slopes.iter().enumerate() {
            let exact = slope * slope / whole;
            holds(found[i].first_order, exact, 0.02, &format!("first {i}"));
            holds(found[i].total, exact, 0.02, &format!("total {i}"));
        }
        let half_width = |estimate: Estimate| 0.5 * (estimate.high - estimate.low);
        let widths = [found[0].first_order, found[0].total].map(half_width);
        assert!(widths[0] < 0.025 && widths[1] < 0.05, "{widths:?}");
    }
}

#[test]
fn a_constant_has_no_indices() {
    let rows = vec![vec![2.5; 5]; 64];
    let refused = indices(&rows, &["a", "b", "c"], 0).unwrap_err();
    assert!(refused.contains("the same in all runs"), "{refused}");
    assert!(indices(&rows[..3], &["a", "b", "c"], 0).is_err());
}
