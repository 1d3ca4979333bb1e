//! Correlation of parameters as a file gives it, with its checks.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{axis::Axis, copula::Copula};
use crate::{bisection::bisect, check::Check, document::Renamed, units::significant};

/// Relative difference of two entries that are to be equal and may be rounded.
const ROUNDED: f64 = 1e-9;
/// Relative difference of a variance and the square of a standard deviation, which a file may round.
const VARIANCE_ROUNDED: f64 = 1e-3;

/// How parameters with distributions depend on each other: one of `matrix` and `covariance`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Correlation {
    /// Keys of the parameters, in the order of the rows.
    pub parameters: Vec<String>,
    /// Correlation coefficients of the normal scores; of normal distributions those of the parameters themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub matrix: Option<Vec<Vec<f64>>>,
    /// Covariances in the units of the parameters, where all of them are normal; the diagonal repeats the variances.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Vec<Vec<f64>>>,
}

impl Correlation {
    /// Checks what is written; `None` when something is wrong.
    pub(crate) fn resolve(&self, axes: &[Axis], check: &mut Check<'_>) -> Option<Copula> {
        let (name, matrix) = self.given(check)?;
        let members = self.members(axes, check)?;
        let correlations = match is_symmetric(name, matrix, members.len(), check) {
            false => return None,
            true if name == "matrix" => correlations(matrix, check)?,
            true => from_covariances(matrix, axes, &members, check)?,
        };
        let copula = Copula::new(members, &correlations);
        if copula.is_none() {
            check.fail(
                name,
                "the matrix is not positive definite",
                remedy(&correlations),
            );
        }
        copula
    }

    fn given(&self, check: &mut Check<'_>) -> Option<(&'static str, &Vec<Vec<f64>>)> {
        const ONE: &str = "give one of matrix (correlation coefficients) and covariance";
        match (&self.matrix, &self.covariance) {
            (Some(matrix), None) => return Some(("matrix", matrix)),
            (None, Some(covariance)) => return Some(("covariance", covariance)),
            (None, None) => check.fail("", "the correlation has no matrix", ONE),
            (Some(_), Some(_)) => check.fail("covariance", "the matrix is given twice", ONE),
        }
        None
    }

    /// Indices of the axes that are named.
    fn members(&self, axes: &[Axis], check: &mut Check<'_>) -> Option<Vec<usize>> {
        let mut members = Vec::new();
        for (i, key) in self.parameters.iter().enumerate() {
            let place = format!("parameters.{i}");
            let Some(index) = axes.iter().position(|axis| axis.key == *key) else {
                let known: Vec<&str> = axes.iter().map(|axis| axis.key.as_str()).collect();
                let (message, help) = match Renamed::of(key) {
                    Some(renamed) => (renamed.message(), renamed.help()),
                    None => (
                        format!("`{key}` is not varied"),
                        format!("parameters: {}", known.join(", ")),
                    ),
                };
                check.fail(&place, message, help);
                return None;
            };
            if axes[index].distribution().is_none() {
                let message = format!("`{key}` takes values of a list");
                check.fail(
                    &place,
                    message,
                    "only parameters with a distribution can be correlated",
                );
                return None;
            }
            if members.contains(&index) {
                check.fail(
                    &place,
                    format!("`{key}` stands here twice"),
                    "remove one of the two",
                );
                return None;
            }
            members.push(index);
        }
        if members.len() < 2 {
            check.fail(
                "parameters",
                "it takes two parameters to correlate",
                "name at least two, or remove the table",
            );
            return None;
        }
        Some(members)
    }
}

/// Whether a matrix is square, of the size that is due, and symmetric; says what is wrong if it is not.
fn is_symmetric(name: &str, matrix: &[Vec<f64>], size: usize, check: &mut Check<'_>) -> bool {
    let due = format!("give {size} rows of {size} numbers, one for each of `parameters`");
    if matrix.len() != size {
        let message = format!("the matrix has {} rows for {size} parameters", matrix.len());
        check.fail(name, message, due);
        return false;
    }
    for (i, row) in matrix.iter().enumerate() {
        if row.len() != size {
            let message = format!("the row has {} numbers for {size} parameters", row.len());
            check.fail(&format!("{name}.{i}"), message, due);
            return false;
        }
        if let Some(j) = row.iter().position(|entry| !entry.is_finite()) {
            check.fail(
                &format!("{name}.{i}.{j}"),
                "the number is not finite",
                "write a finite number",
            );
            return false;
        }
        for (j, &entry) in row.iter().enumerate().take(i) {
            let mirrored = matrix[j][i];
            if (entry - mirrored).abs() > ROUNDED * entry.abs().max(mirrored.abs()) {
                let message = format!(
                    "the matrix is not symmetric: {} here, {} in row {} and column {}",
                    significant(entry, 6),
                    significant(mirrored, 6),
                    j + 1,
                    i + 1
                );
                check.fail(
                    &format!("{name}.{i}.{j}"),
                    message,
                    "write the same number in both places",
                );
                return false;
            }
        }
    }
    true
}

/// The entries of a matrix of correlation coefficients, if they can be some.
fn correlations(matrix: &[Vec<f64>], check: &mut Check<'_>) -> Option<Vec<Vec<f64>>> {
    for (i, row) in matrix.iter().enumerate() {
        for (j, &entry) in row.iter().enumerate() {
            let place = format!("matrix.{i}.{j}");
            if i == j && (entry - 1.0).abs() > ROUNDED {
                let message = format!("{} stands on the diagonal", significant(entry, 6));
                let help = "the diagonal of a correlation matrix is 1; variances go into covariance = [[…]]";
                check.fail(&place, message, help);
                return None;
            }
            if i != j && entry.abs() >= 1.0 {
                let message = format!("{} is out of range", significant(entry, 6));
                check.fail(&place, message, "allowed: more than -1, less than 1");
                return None;
            }
        }
    }
    Some(matrix.to_vec())
}

/// Correlation coefficients from covariances, if their diagonal is what the distributions say.
fn from_covariances(
    matrix: &[Vec<f64>],
    axes: &[Axis],
    members: &[usize],
    check: &mut Check<'_>,
) -> Option<Vec<Vec<f64>>> {
    for (i, &member) in members.iter().enumerate() {
        let axis = &axes[member];
        let Some(deviation) = axis.distribution().and_then(|d| d.normal_deviation()) else {
            let message = format!("`{}` has no plain normal distribution", axis.key);
            let help = "covariances go with normal distributions that are not cut off; write matrix = [[…]] otherwise";
            check.fail(&format!("parameters.{i}"), message, help);
            return None;
        };
        let variance = matrix[i][i];
        if (variance / (deviation * deviation) - 1.0).abs() > VARIANCE_ROUNDED {
            let message = format!(
                "the variance of `{}` is {} here, and {} by its standard deviation",
                axis.key,
                significant(variance, 6),
                significant(deviation * deviation, 6)
            );
            let help = "write the square of the standard deviation on the diagonal, in the parameter's unit";
            check.fail(&format!("covariance.{i}.{i}"), message, help);
            return None;
        }
    }
    let entry = |i: usize, j: usize| matrix[i][j] / (matrix[i][i] * matrix[j][j]).sqrt();
    let size = 0..members.len();
    Some(
        size.clone()
            .map(|i| size.clone().map(|j| entry(i, j)).collect())
            .collect(),
    )
}

/// By how much the entries off the diagonal have to shrink.
fn remedy(correlations: &[Vec<f64>]) -> String {
    let shrunk = |factor: f64| -> Vec<Vec<f64>> {
        let mut matrix = correlations.to_vec();
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = if i == j { 1.0 } else { *entry * factor };
            }
        }
        matrix
    };
    let is_possible = |factor: f64| Copula::new(Vec::new(), &shrunk(factor)).is_some();
    let (good, _) = bisect(0.0, 1.0, 30, is_possible);
    // Rounded down, so that what it says suffices.
    format!(
        "these correlations contradict each other; weaken them, for example multiply those off the diagonal by {}",
        (good * 100.0).floor() / 100.0
    )
}
