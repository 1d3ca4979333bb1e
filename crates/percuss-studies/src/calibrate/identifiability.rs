//! Identifiability of the parameters.

use nalgebra::{DMatrix, SVD};
use serde::Serialize;

/// A singular value below this part of the largest one is zero: derivatives by differences have errors of about 1e-8.
const RANK: f64 = 1e-5;
/// Smallest part that a parameter has in a combination for it to be named.
const PART: f64 = 0.05;
/// Part of its prior's width at which a parameter is as uncertain as it was before.
const WIDE: f64 = 0.9;
/// Correlation beyond which two parameters are known as a combination only.
const CORRELATED: f64 = 0.95;

/// What is wrong with the identification of parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Weakness {
    /// No measured value depends on it.
    NoInfluence,
    /// They change without any change of what the model gives: rank of the derivatives.
    Combination,
    /// Nearly so: the posterior has them almost perfectly correlated.
    Correlated,
    /// Its posterior is as wide as its prior.
    AsWideAsPrior,
    /// The best value stands at the end of its range.
    AtBound,
}

/// Parameters that the data do not determine, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Unidentified {
    /// What is wrong.
    pub weakness: Weakness,
    /// Keys of the parameters.
    pub parameters: Vec<String>,
    /// The finding in words.
    pub words: String,
}

/// Parameters of which nothing, or only a combination, can be found from the derivatives of what the model gives.
///
/// `slopes` has one row per measured value over its standard deviation and one column per parameter over the standard deviation of its prior.
pub(super) fn of_rank(keys: &[&str], slopes: &DMatrix<f64>) -> Vec<Unidentified> {
    let largest = slopes.column_iter().map(|c| c.norm()).fold(0.0, f64::max);
    let silent = |i: usize| slopes.column(i).norm() <= RANK * largest;
    let mut findings: Vec<Unidentified> = (0..keys.len())
        .filter(|&i| silent(i))
        .map(|i| Unidentified {
            weakness: Weakness::NoInfluence,
            parameters: vec![keys[i].to_owned()],
            words: format!("no measured value depends on {}", keys[i]),
        })
        .collect();
    let heard: Vec<usize> = (0..keys.len()).filter(|&i| !silent(i)).collect();
    if heard.len() < 2 {
        return findings;
    }
    // Columns of length one: whether parameters are told apart is no question of how strongly they act.
    let columns: Vec<_> = heard
        .iter()
        .map(|&i| slopes.column(i) / slopes.column(i).norm())
        .collect();
    let mut columns = DMatrix::from_columns(&columns);
    // With fewer rows than columns the decomposition would not name the directions that nothing is known of.
    if columns.nrows() < columns.ncols() {
        columns = columns.resize_vertically(heard.len(), 0.0);
    }
    let decomposition = SVD::new(columns, false, true);
    let Some(directions) = decomposition.v_t else {
        return findings;
    };
    let top = decomposition.singular_values.max();
    for (value, direction) in decomposition
        .singular_values
        .iter()
        .zip(directions.row_iter())
    {
        if *value > RANK * top {
            continue;
        }
        let named: Vec<String> = heard
            .iter()
            .zip(direction.iter())
            .filter(|(_, part)| part.abs() > PART)
            .map(|(&i, _)| keys[i].to_owned())
            .collect();
        findings.push(Unidentified {
            weakness: Weakness::Combination,
            words: format!(
                "{} act together only: they can change against each other without any change of what the model gives",
                listed(&named)
            ),
            parameters: named,
        });
    }
    findings
}

/// Parameters that are as uncertain as before, or known as combinations only, from their standard deviations over those of their
/// priors and their correlations. Those in `known` have been found wanting already.
pub(super) fn of_posterior(
    keys: &[&str],
    widths: &[f64],
    correlations: &DMatrix<f64>,
    known: &[Unidentified],
) -> Vec<Unidentified> {
    let named = |names: &[&str]| {
        known.iter().any(|finding| {
            names
                .iter()
                .all(|name| finding.parameters.iter().any(|found| found == name))
        })
    };
    let mut findings = Vec::new();
    for i in 0..keys.len() {
        if widths[i] > WIDE && !named(&[keys[i]]) {
            findings.push(Unidentified {
                weakness: Weakness::AsWideAsPrior,
                parameters: vec![keys[i].to_owned()],
                words: format!(
                    "{} is as uncertain as before: its posterior has {:.0} % of the width of its prior",
                    keys[i],
                    100.0 * widths[i]
                ),
            });
        }
        for (j, other) in keys[..i].iter().enumerate() {
            let correlation = correlations[(i, j)];
            if correlation.abs() > CORRELATED && !named(&[keys[i], other]) {
                findings.push(Unidentified {
                    weakness: Weakness::Correlated,
                    parameters: vec![(*other).to_owned(), keys[i].to_owned()],
                    words: format!(
                        "{} and {} are known as a combination only: their correlation is {correlation:.3}",
                        other, keys[i]
                    ),
                });
            }
        }
    }
    findings
}

/// A parameter whose best value is at the end of its range.
pub(super) fn at_bound(key: &str, end: &str) -> Unidentified {
    Unidentified {
        weakness: Weakness::AtBound,
        parameters: vec![key.to_owned()],
        words: format!(
            "the best value of {key} is at the {end} end of its range, which holds it there"
        ),
    }
}

fn listed(names: &[String]) -> String {
    match names {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        names => names.join(""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slopes of `a b x + c x²` at four places: a and b enter as a product; d not at all.
    #[test]
    fn a_product_and_a_parameter_without_influence_are_named() {
        let (a, b) = (2.0, 300.0);
        let row = |x: f64| [b * x, a * x, x * x, 0.0];
        let slopes = DMatrix::from_fn(4, 4, |i, j| row(1.0 + i as f64)[j]);
        let found = of_rank(&["a", "b", "c", "d"], &slopes);
        let said: Vec<(Weakness, &[String])> = found
            .iter()
            .map(|finding| (finding.weakness, finding.parameters.as_slice()))
            .collect();
        let (d, ab) = (["d".to_owned()], ["a".to_owned(), "b".to_owned()]);
        assert_eq!(
            said,
            [
                (Weakness::NoInfluence, d.as_slice()),
                (Weakness::Combination, ab.as_slice())
            ]
        );
        assert!(found[1].words.starts_with("a and b act together only"));
    }

    #[test]
    fn fewer_values_than_parameters_leave_a_combination() {
        let slopes = DMatrix::from_row_slice(1, 2, &[1.0, 5.0]);
        let found = of_rank(&["a", "b"], &slopes);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].parameters, ["a", "b"]);
        assert!(of_rank(&["a"], &DMatrix::from_row_slice(1, 1, &[1.0])).is_empty());
    }

    #[test]
    fn wide_and_correlated_parameters_are_named_once() {
        let correlations = DMatrix::from_row_slice(2, 2, &[1.0, -0.99, -0.99, 1.0]);
        let found = of_posterior(&["a", "b"], &[0.5, 0.95], &correlations, &[]);
        let kinds: Vec<Weakness> = found.iter().map(|finding| finding.weakness).collect();
        assert_eq!(kinds, [Weakness::AsWideAsPrior, Weakness::Correlated]);
        assert_eq!(
            of_posterior(&["a", "b"], &[0.5, 0.5], &correlations, &found[1..]),
            []
        );
        assert_eq!(
            of_posterior(&["a"], &[0.1], &DMatrix::identity(1, 1), &[]),
            []
        );
    }
}
