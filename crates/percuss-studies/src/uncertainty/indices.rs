//! First-order and total Sobol' indices.
//!
//! First order: the estimator of Saltelli and others (2010) [saltelli2010]. Total: that of Jansen (1999) [jansen1999]. Intervals:
//! percentiles of a bootstrap over the rows of the design [efron1993].

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
const FEWEST: usize = 16;
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
    if rows.len() < FEWEST {
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
    let spread = variance(&sums(&terms, 0..rows.len()));
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

/// What a row adds: values and squares at A and B, and for each parameter the products of either index.
fn terms(row: &[f64], mean: f64) -> Vec<f64> {
    let (a, b) = (row[0] - mean, row[1] - mean);
    let mut terms = vec![a + b, a * a + b * b];
    for mixed in &row[2..] {
        let mixed = mixed - mean;
        terms.push(b * (mixed - a));
        terms.push(0.5 * (a - mixed).powi(2));
    }
    terms
}

/// Means of the terms of some rows.
fn sums(terms: &[Vec<f64>], rows: impl ExactSizeIterator<Item = usize>) -> Vec<f64> {
    let count = rows.len() as f64;
    let mut sums = vec![0.0; terms[0].len()];
    for row in rows {
        for (sum, term) in sums.iter_mut().zip(&terms[row]) {
            *sum += term;
        }
    }
    sums.iter().map(|sum| sum / count).collect()
}

fn variance(means: &[f64]) -> f64 {
    0.5 * means[1] - (0.5 * means[0]).powi(2)
}

/// First-order and total index of each parameter in turn.
fn estimates(terms: &[Vec<f64>], rows: impl ExactSizeIterator<Item = usize>) -> Vec<f64> {
    let means = sums(terms, rows);
    let variance = variance(&means);
    means[2..].iter().map(|mean| mean / variance).collect()
}
