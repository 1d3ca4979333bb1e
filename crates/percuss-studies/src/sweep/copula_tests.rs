use std::f64::consts::PI;

use super::{Copula, Sweep, tests::sweep};

const NORMALS: &str = "
[[parameter]]
key = 'projectile.impact_velocity'
normal = { mean = '230 m/s', standard_deviation = '4 m/s' }
[[parameter]]
key = 'target.thickness'
normal = { mean = '25 mm', standard_deviation = '0.5 mm' }
[[parameter]]
key = 'chain.constraint_factor'
normal = { mean = 2.7, standard_deviation = 0.2 }
";
const SHAPES: &str = "
[[parameter]]
key = 'projectile.impact_velocity'
uniform = { from = '200 m/s', to = '260 m/s' }
[[parameter]]
key = 'target.thickness'
triangular = { from = '20 mm', mode = '22 mm', to = '30 mm' }
[[parameter]]
key = 'chain.constraint_factor'
lognormal = { median = 2.7, log_standard_deviation = 0.1 }
[[parameter]]
key = 'chain.border_shear'
normal = { mean = 0.5, standard_deviation = 0.3, min = 0, max = 1 }
";
const MATRIX: [[f64; 3]; 3] = [[1.0, 0.8, -0.3], [0.8, 1.0, 0.1], [-0.3, 0.1, 1.0]];

/// The first three parameters with the correlations of `MATRIX`.
fn correlation() -> String {
    let [a, b, c] = MATRIX;
    format!(
        "[correlation]
parameters = ['projectile.impact_velocity', 'target.thickness', 'chain.constraint_factor']
matrix = [{a:?}, {b:?}, {c:?}]"
    )
}

fn design(kind: &str, samples: u64) -> String {
    format!("design = '{kind}'\nsamples = {samples}\nseed = 11")
}

/// All values of a sweep, a list an axis.
fn columns(sweep: &Sweep) -> Vec<Vec<f64>> {
    let mut columns = vec![Vec::new(); sweep.axes.len()];
    for i in 0..sweep.runs() {
        let values = sweep.points.values(&sweep.axes, sweep.copula.as_ref(), i);
        for (column, value) in columns.iter_mut().zip(values) {
            column.push(value);
        }
    }
    columns
}

fn covariance(a: &[f64], b: &[f64]) -> f64 {
    let count = a.len() as f64;
    let mean = |x: &[f64]| x.iter().sum::<f64>() / count;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let products = a.iter().zip(b).map(|(a, b)| (a - mean_a) * (b - mean_b));
    products.sum::<f64>() / count
}

/// Places in the order of size, over the count: probabilities by the sample itself.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    for (place, index) in order.into_iter().enumerate() {
        ranks[index] = (place as f64 + 0.5) / values.len() as f64;
    }
    ranks
}

#[test]
fn sample_covariances_are_the_given_ones() {
    let deviations = [4.0, 0.5, 0.2];
    for (kind, most) in [("sobol", 0.003), ("latin-hypercube", 0.02)] {
        let text = format!("{NORMALS}{}", correlation());
        let sweep = sweep(&format!("covariance-{kind}"), &design(kind, 16384), &text);
        let columns = columns(&sweep);
        for i in 0..3 {
            for j in 0..3 {
                let scaled = covariance(&columns[i], &columns[j]) / (deviations[i] * deviations[j]);
                assert!(
                    (scaled - MATRIX[i][j]).abs() < most,
                    "{kind} {i} {j}: {scaled}"
                );
            }
        }
    }
}

/// A linear map of independent normal numbers, with a matrix whose square is the given one: jointly normal by definition.
#[test]
fn normal_parameters_are_exactly_jointly_normal() {
    let text = format!("{NORMALS}{}", correlation());
    let joined = sweep("jointly-normal", &design("sobol", 512), &text);
    let alone = sweep("normal-alone", &design("sobol", 512), NORMALS);
    let factor = &joined.copula.as_ref().unwrap().factor;
    for (i, expected) in MATRIX.iter().enumerate() {
        for (j, expected) in expected.iter().enumerate() {
            let entry: f64 = factor[i].iter().zip(&factor[j]).map(|(a, b)| a * b).sum();
            assert!((entry - expected).abs() < 1e-15);
        }
    }
    let (means, deviations) = ([230.0, 25.0, 2.7], [4.0, 0.5, 0.2]);
    for i in 0..512 {
        let of = |s: &Sweep| s.points.values(&s.axes, s.copula.as_ref(), i);
        let (joined, alone) = (of(&joined), of(&alone));
        let scores: Vec<f64> = (0..3)
            .map(|k| (alone[k] - means[k]) / deviations[k])
            .collect();
        for k in 0..3 {
            let z: f64 = factor[k].iter().zip(&scores).map(|(l, z)| l * z).sum();
            let expected = means[k] + deviations[k] * z;
            assert!((joined[k] - expected).abs() < 1e-12 * means[k], "{i} {k}");
        }
    }
}

#[test]
fn marginals_stay_and_ranks_correlate_as_the_copula_says() {
    let count = 8192;
    let text = format!("{SHAPES}{}", correlation());
    let joined = columns(&sweep("shapes", &design("sobol", count), &text));
    let alone = columns(&sweep("shapes-alone", &design("sobol", count), SHAPES));
    // The first of them and what is not named are as they were, to rounding.
    for (a, b) in joined[0].iter().zip(&alone[0]) {
        assert!((a / b - 1.0).abs() < 1e-12);
    }
    assert_eq!(joined[3], alone[3]);
    // Kolmogorov's distance of the probabilities of each value from even ones.
    let probabilities: [Box<dyn Fn(f64) -> f64>; 3] = [
        Box::new(|v| (v - 200.0) / 60.0),
        Box::new(|h| match h < 22.0 {
            true => (h - 20.0).powi(2) / 20.0,
            false => 1.0 - (30.0 - h).powi(2) / 80.0,
        }),
        Box::new(|f: f64| 0.5 * libm::erfc(-(f / 2.7).ln() / 0.1 / 2.0_f64.sqrt())),
    ];
    for (column, probability) in joined.iter().zip(&probabilities) {
        let distances = column
            .iter()
            .zip(ranks(column))
            .map(|(v, rank)| (probability(*v) - rank).abs());
        let largest = distances.fold(0.0, f64::max);
        assert!(largest < 0.004, "{largest}");
    }
    for i in 0..3 {
        for j in 0..i {
            let spearman = 12.0 * covariance(&ranks(&joined[i]), &ranks(&joined[j]));
            let expected = 6.0 / PI * (0.5 * MATRIX[i][j]).asin();
            assert!(
                (spearman - expected).abs() < 0.003,
                "{i} {j}: {spearman}, {expected}"
            );
        }
    }
}

#[test]
fn covariances_say_the_same_as_correlations() {
    let with = |matrix: &str| {
        let text = format!(
            "{NORMALS}[correlation]\nparameters = ['target.thickness', 'projectile.impact_velocity']\n{matrix}"
        );
        columns(&sweep("two-ways", &design("sobol", 64), &text))
    };
    let by_covariance = with("covariance = [[0.25, 0.5], [0.5, 16]]");
    let by_correlation = with("matrix = [[1, 0.25], [0.25, 1]]");
    assert_eq!(by_covariance, by_correlation);
}

#[test]
fn scores_far_out_stay_finite() {
    let text = format!("{SHAPES}{}", correlation());
    let sweep = sweep("far-out", &design("sobol", 8), &text);
    let copula = sweep.copula.as_ref().unwrap();
    for u in [2_f64.powi(-54), 1.0 - 2_f64.powi(-53)] {
        let mut values = vec![f64::NAN; 4];
        copula.join(&sweep.axes, &[u; 4], &mut values);
        assert!(values[..3].iter().all(|v| v.is_finite()), "{values:?}");
        let inside = (200.0..=260.0).contains(&values[0]) && (20.0..=30.0).contains(&values[1]);
        assert!(inside, "{values:?}");
    }
}

#[test]
fn only_positive_definite_matrices_are_taken() {
    let matrix = |r: f64| vec![vec![1.0, r, -r], vec![r, 1.0, r], vec![-r, r, 1.0]];
    // The smallest eigenvalue is 1 - 2 r.
    assert!(Copula::new(Vec::new(), &matrix(0.4999)).is_some());
    assert!(Copula::new(Vec::new(), &matrix(0.5)).is_none());
    assert!(Copula::new(Vec::new(), &matrix(f64::NAN)).is_none());
}
