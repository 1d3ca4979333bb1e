use std::f64::consts::{FRAC_2_PI, PI};

use rand_distr::{Distribution, StandardNormal};
use rand_pcg::{Pcg64, rand_core::SeedableRng};

use super::*;

/// Chains of `x' = φ x + √(1 − φ²) e`, with the standard normal distribution throughout.
fn autoregressive(phi: f64, chains: u64, length: usize) -> Vec<Vec<f64>> {
    let chain = |seed| {
        let mut random = Pcg64::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut x = normal();
        (0..length)
            .map(|_| {
                x = phi * x + (1.0 - phi * phi).sqrt() * normal();
                x
            })
            .collect()
    };
    (0..chains).map(chain).collect()
}

/// Half of the chains changed.
fn half(mut chains: Vec<Vec<f64>>, change: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
    let from = chains.len() / 2;
    for chain in &mut chains[from..] {
        chain.iter_mut().for_each(|x| *x = change(*x));
    }
    chains
}

/// R-hat of chains of which half have all the ranks below and half all those above: the scores are half-normal, with the means
/// ±√(2/π) of eight halves and the variance 1 − 2/π.
fn of_two_kinds() -> f64 {
    (1.0 + 8.0 / 7.0 * FRAC_2_PI / (1.0 - FRAC_2_PI)).sqrt()
}

fn near(found: f64, exact: f64, fraction: f64) {
    assert!(
        (found / exact - 1.0).abs() < fraction,
        "{found}, exact {exact}"
    );
}

/// By hand: the halves 1 2, 3 4, 2 3, 5 6 have variances 1/2 and means 1.5, 3.5, 2.5, 5.5, whose variance is 8.75/3.
#[test]
fn split_r_hat_of_a_few_numbers_is_the_one_by_hand() {
    let chains = [vec![1.0, 2.0, 3.0, 4.0], vec![2.0, 3.0, 5.0, 6.0]];
    let exact: f64 = (0.5 * 0.5 + 8.75 / 3.0) / 0.5;
    assert!((split_r_hat(&chains) - exact.sqrt()).abs() < 1e-14);
}

/// By hand: of six numbers, two equal ones have the ranks 2 and 3; Blom's places are (r − 3/8)/6.25.
#[test]
fn scores_of_a_few_numbers_are_the_ones_by_hand() {
    let scores = normal_scores(&[vec![7.0, 1.0, 3.0], vec![3.0, 100.0, -5.0]]);
    let exact = |rank: f64| sweep::score((rank - 0.375) / 6.25);
    let by_hand = [5.0, 2.0, 3.5, 3.5, 6.0, 1.0].map(exact);
    assert_eq!(scores.concat(), by_hand);
    near(exact(6.0), 1.281_551_565_544_600_4, 1e-12);
}

#[test]
fn independent_draws_agree_and_count_in_full() {
    let chains = autoregressive(0.0, 4, 10_000);
    let found = r_hat(&chains);
    assert!((0.999..1.002).contains(&found), "{found}");
    near(bulk_effective_size(&chains, 1), 40_000.0, 0.05);
    near(tail_effective_size(&chains, 1), 40_000.0, 0.05);
}

#[test]
fn chains_at_different_places_are_found() {
    let chains = half(autoregressive(0.0, 4, 2000), |x| x + 100.0);
    near(r_hat(&chains), of_two_kinds(), 0.01);
    // A small shift, which leaves the scores about normal: R² = 1 + 0.2² · 8/7.
    let chains = half(autoregressive(0.0, 4, 10_000), |x| x + 0.4);
    near(r_hat(&chains), (1.0 + 0.04 * 8.0 / 7.0_f64).sqrt(), 0.005);
    // A drift within the chains is seen by their halves.
    let drift = |(i, x): (usize, f64)| x + if i < 1000 { 0.0 } else { 100.0 };
    let drifting = autoregressive(0.0, 4, 2000)
        .into_iter()
        .map(|chain| chain.into_iter().enumerate().map(drift).collect());
    near(r_hat(&drifting.collect::<Vec<_>>()), of_two_kinds(), 0.01);
}

/// Chains of one median that spread differently: their places agree, their distances from the median do not.
#[test]
fn a_different_scale_is_found_by_the_folded_ranks_alone() {
    let chains = half(autoregressive(0.0, 4, 2000), |x| 1e6 * x);
    let located = split_r_hat(&normal_scores(&chains));
    assert!(located < 1.005, "{located}");
    assert!(split_r_hat(&chains) < 1.005);
    near(r_hat(&chains), of_two_kinds(), 0.01);
}

/// Ranks do not change when the scale is bent.
#[test]
fn a_bent_scale_changes_nothing() {
    let chains = autoregressive(0.5, 4, 500);
    let bent = map(&chains, |x| (5.0 * x).exp());
    assert_eq!(
        bulk_effective_size(&bent, 1),
        bulk_effective_size(&chains, 1)
    );
    assert_eq!(normal_scores(&bent), normal_scores(&chains));
}

#[test]
fn chains_that_stand_still_have_no_sample() {
    let (one, two) = (vec![1.0; 8], vec![2.0; 8]);
    assert_eq!(r_hat(&[one.clone(), one.clone()]), 1.0);
    assert_eq!(r_hat(&[one.clone(), two]), f64::INFINITY);
    assert_eq!(bulk_effective_size(std::slice::from_ref(&one), 1), 0.0);
    assert_eq!(tail_effective_size(&[one], 2), 0.0);
    assert!(r_hat(&[vec![1.0]]).is_nan());
    assert!(bulk_effective_size(&[vec![1.0, 2.0]], 1).is_nan());
    assert!(r_hat(&[]).is_nan() && tail_effective_size(&[], 1).is_nan());
}

/// An autoregressive process has the integrated autocorrelation time (1 + φ)/(1 − φ).
#[test]
fn bulk_size_of_an_autoregressive_process_is_the_analytic_one() {
    for (phi, allowed) in [(-0.5, 0.1), (0.5, 0.1), (0.9, 0.15)] {
        let chains = autoregressive(phi, 4, 40_000);
        let exact = 160_000.0 * (1.0 - phi) / (1.0 + phi);
        near(bulk_effective_size(&chains, 1), exact, allowed);
        assert!(r_hat(&chains) < 1.005);
    }
}

/// Being below a quantile z of two normal variables with the correlation r has the covariance ∫₀^r φ₂(z, z; s) ds.
#[test]
fn tail_size_of_an_autoregressive_process_is_the_analytic_one() {
    let phi: f64 = 0.7;
    let z = sweep::score(0.05);
    let density = |s: f64| (-z * z / (1.0 + s)).exp() / (2.0 * PI * (1.0 - s * s).sqrt());
    let covariance = |r: f64| {
        let parts = 2000;
        let middle = |i: i32| density(r * (f64::from(i) + 0.5) / f64::from(parts));
        (0..parts).map(middle).sum::<f64>() * r / f64::from(parts)
    };
    let correlations = (1..60).map(|lag| covariance(phi.powi(lag)) / (0.05 * 0.95));
    let time = 1.0 + 2.0 * correlations.sum::<f64>();
    let chains = autoregressive(phi, 4, 40_000);
    // The smaller of both tails.
    let found = tail_effective_size(&chains, 1) * time / 160_000.0;
    assert!((0.9..1.03).contains(&found), "{found}");
}

/// Independent chains as the walkers of two ensembles: the sizes add up.
#[test]
fn walkers_together_have_the_size_of_all_of_them() {
    let (walkers, length) = (5, 20_000);
    let single = autoregressive(0.5, 10, length);
    let ensemble = |chains: &[Vec<f64>]| {
        let step = |i: usize| chains.iter().map(move |chain| chain[i]);
        (0..length).flat_map(step).collect()
    };
    let ensembles: Vec<Vec<f64>> = single.chunks(walkers).map(ensemble).collect();
    let exact = 10.0 * length as f64 / 3.0;
    near(bulk_effective_size(&ensembles, walkers), exact, 0.1);
}
