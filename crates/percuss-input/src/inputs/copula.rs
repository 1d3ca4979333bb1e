//! Gaussian copula of correlated parameters.
//!
//! Each parameter has its own distribution and a normal score, the quantile of the standard normal distribution at its probability.
//! The scores are jointly normal with given correlations. Parameters with normal distributions are then jointly normal with the
//! same correlations; of others the rank correlation (Spearman) is `(6/π) asin(ρ/2)`, whatever their distributions are.

use super::{axis::Axis, distribution::score};

/// Part of a parameter's variance that the others have to leave, for the matrix to count as positive definite.
const LEAST_PIVOT: f64 = 1e-10;

/// What makes dependent normal scores of independent ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Copula {
    /// Indices of the axes that it joins.
    members: Vec<usize>,
    /// Cholesky factor of the correlation matrix: as many entries in each row as there are up to the diagonal.
    pub factor: Vec<Vec<f64>>,
}

impl Copula {
    /// The copula of a symmetric matrix with unit diagonal; `None` when it is not positive definite.
    pub fn new(members: Vec<usize>, correlations: &[Vec<f64>]) -> Option<Self> {
        let mut factor: Vec<Vec<f64>> = Vec::new();
        for (i, row) in correlations.iter().enumerate() {
            let mut entries: Vec<f64> = Vec::with_capacity(i + 1);
            for j in 0..i {
                let sum: f64 = (0..j).map(|k| entries[k] * factor[j][k]).sum();
                entries.push((row[j] - sum) / factor[j][j]);
            }
            let pivot = row[i] - entries.iter().map(|entry| entry * entry).sum::<f64>();
            if pivot.is_nan() || pivot <= LEAST_PIVOT {
                return None;
            }
            entries.push(pivot.sqrt());
            factor.push(entries);
        }
        Some(Self { members, factor })
    }

    /// Puts the values of the axes that it joins instead of independent ones; `u` are evenly drawn numbers between 0 and 1.
    pub fn join(&self, axes: &[Axis], u: &[f64], values: &mut [f64]) {
        let scores: Vec<f64> = self.members.iter().map(|&i| score(u[i])).collect();
        for (&member, row) in self.members.iter().zip(&self.factor) {
            let z = row.iter().zip(&scores).map(|(l, z)| l * z).sum();
            if let Some(distribution) = axes[member].distribution() {
                values[member] = distribution.at_score(z);
            }
        }
    }
}
