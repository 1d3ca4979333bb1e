//! First-order and total Sobol' indices.
//!
//! With values a, b and m at A, B and A with coordinate i of B, less their mean, and T₀ the estimate of Jansen (1999) [jansen1999],
//! `T₀ = mean((a - m)²) / 2 / var(a, m)`:
//!
//! - first order `mean(b (m - (1 - T₀) a)) / var(b, m)`; with `b (m - a)` that of Saltelli and others (2010) [saltelli2010];
//! - total `T₀ + T₀ mean(a b) / var(a, m)`.
//!
//! The product a b has a mean of zero. Its part in both estimates is that which lets them scatter least where parameters act one by one,
//! so that the indices of the parameter that matters most are as sure as the small ones. Variances are pooled for the same reason [janon2014].
//! Intervals: percentiles of a bootstrap over the rows of the design [efron1993].

use rayon::prelude::*;
use serde::Serialize;

use super::statistics::Estimate;
use crate::{
    statistics::{quantile, sorted},
    sweep::{bits, stream},
};

/// Resamples of the bootstrap.
const RESAMPLES: u64 = 1000;
/// Purpose that random numbers are drawn for: none of those of a sweep's points.
const BOOTSTRAP: u64 = 4;
/// Fewest rows that an interval can be told from.
pub(super) const FEWEST_ROWS: u64 = 16;
/// Variance below this part of the square of the largest value is rounding.
const ROUNDING: f64 = 1e-20;

/// Sobol' indices of a quantity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SobolIndices {
    /// Rows of the design that they rest on: those in which no run lacks a value.
    pub rows: usize,
    /// One a parameter, in the order of the case.
    pub parameters: Vec<Index>,
}

/// Sobol' indices of a parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Index {
    /// Key of the parameter.
    pub key: String,
    /// Fraction of the variance that it causes alone.
    pub first_order: Estimate,
    /// Fraction of the variance that it causes alone and together with others.
    pub total: Estimate,
}

/// Estimates the indices from rows of values at the points A, B, and A with coordinate i of B.
///
/// # Errors
/// Why there are none, in words.
pub(super) fn indices(rows: &[Vec<f64>], keys: &[&str], seed: u64) -> Result<SobolIndices, String> {
    if rows.len() < FEWEST_ROWS as usize {
        return Err(format!(
            "only {} of the rows of points have values in all their runs",
            rows.len()
        ));
    }
    // Estimates scatter least about a mean of zero.
    let mean = rows.iter().map(|row| row[0] + row[1]).sum::<f64>() / (2 * rows.len()) as f64;
    let terms: Vec<Vec<f64>> = rows.iter().map(|row| terms(row, mean)).collect();
    let all = estimates(&terms, 0..rows.len());
    let size = rows
        .iter()
        .flatten()
        .fold(0.0_f64, |size, v| size.max(v.abs()));
    let means = means(&terms, 0..rows.len());
    let spread = 0.5 * (means[0] + means[1]);
    if spread.is_nan() || spread <= ROUNDING * size * size {
        return Err("the value is the same in all runs".to_owned());
    }
    let resampled: Vec<Vec<f64>> = (0..RESAMPLES)
        .into_par_iter()
        .map(|resample| {
            let stream = stream(seed, BOOTSTRAP, resample as usize);
            // The upper bits of a product with the count: even to one part in 2^64 / count.
            let draw = |i: usize| {
                let bits = u128::from(bits(stream, i as u64));
                ((bits * terms.len() as u128) >> 64) as usize
            };
            estimates(&terms, (0..terms.len()).map(draw))
        })
        .collect();
    let estimate = |place: usize| {
        let found = resampled.iter().map(|estimates| estimates[place]);
        let found = sorted(found.filter(|value| value.is_finite()));
        Estimate {
            value: all[place],
            low: quantile(&found, 0.025),
            high: quantile(&found, 0.975),
        }
    };
    let index = |(i, key): (usize, &&str)| Index {
        key: (*key).to_owned(),
        first_order: estimate(2 * i),
        total: estimate(2 * i + 1),
    };
    Ok(SobolIndices {
        rows: rows.len(),
        parameters: keys.iter().enumerate().map(index).collect(),
    })
}

/// What a row adds: squares at A and B and their product; for each parameter the square at its point, its product with B, and half the square
/// of its difference from A.
fn terms(row: &[f64], mean: f64) -> Vec<f64> {
    let (a, b) = (row[0] - mean, row[1] - mean);
    let mut terms = vec![a * a, b * b, a * b];
    for mixed in &row[2..] {
        let mixed = mixed - mean;
        terms.extend([mixed * mixed, b * mixed, 0.5 * (a - mixed).powi(2)]);
    }
    terms
}

/// Means of the terms of some rows.
fn means(terms: &[Vec<f64>], rows: impl ExactSizeIterator<Item = usize>) -> Vec<f64> {
    let count = rows.len() as f64;
    let mut sums = vec![0.0; terms[0].len()];
    for row in rows {
        for (sum, term) in sums.iter_mut().zip(&terms[row]) {
            *sum += term;
        }
    }
    sums.iter().map(|sum| sum / count).collect()
}

/// First-order and total index of each parameter in turn.
fn estimates(terms: &[Vec<f64>], rows: impl ExactSizeIterator<Item = usize>) -> Vec<f64> {
    let means = means(terms, rows);
    let [aa, bb, ab] = [means[0], means[1], means[2]];
    let of_parameter = |of: &[f64]| {
        let [mm, bm, difference] = [of[0], of[1], of[2]];
        let (with_a, with_b) = (0.5 * (aa + mm), 0.5 * (bb + mm));
        let total = difference / with_a;
        let shared = total.clamp(0.0, 1.0);
        [
            (bm - (1.0 - shared) * ab) / with_b,
            total + shared * ab / with_a,
        ]
    };
    means[3..].chunks(3).flat_map(of_parameter).collect()
}
