//! One parameter of a sweep: the values that it takes, checked.

use toml::Value;

use super::{amount::Amount, copula::Copula, distribution::Distribution};

/// A number of the case with the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Dotted key in the case.
    pub key: String,
    /// Unit of the values; empty for plain numbers.
    pub unit: String,
    pub(super) values: Values,
    /// Whether the values are whole numbers.
    pub(super) whole: bool,
    /// Values that have to be possible by themselves, each with the key that it is written under.
    pub(super) samples: Vec<(String, f64)>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Values {
    List(Vec<f64>),
    Distribution(Distribution),
}

/// The values of all axes that numbers drawn evenly between 0 and 1 stand for.
pub(crate) fn values(axes: &[Axis], copula: Option<&Copula>, u: &[f64]) -> Vec<f64> {
    let mut values: Vec<f64> = axes.iter().zip(u).map(|(axis, u)| axis.at(*u)).collect();
    if let Some(copula) = copula {
        copula.join(axes, u, &mut values);
    }
    values
}

impl Axis {
    /// Name of its column: the key, and the unit in the manner of the other columns.
    pub fn column(&self) -> String {
        let mut name = self.key.clone();
        let unit = self.unit.to_lowercase();
        let words = unit.split(|c: char| !c.is_alphanumeric());
        for word in words.filter(|word| !word.is_empty()) {
            name.push('_');
            name += word;
        }
        name
    }

    /// Its values in words, such as `normal, 230 ± 3 m/s`.
    pub fn in_words(&self) -> String {
        match &self.values {
            Values::List(values) => format!("one of {} values", values.len()),
            Values::Distribution(distribution) => distribution.in_words(&self.unit),
        }
    }

    /// Number of values of a list.
    pub(super) fn count(&self) -> Option<u64> {
        match &self.values {
            Values::List(values) => Some(values.len() as u64),
            Values::Distribution(_) => None,
        }
    }

    /// Its distribution, unless it takes the values of a list.
    pub(super) fn distribution(&self) -> Option<&Distribution> {
        match &self.values {
            Values::List(_) => None,
            Values::Distribution(distribution) => Some(distribution),
        }
    }

    /// The value that a number drawn evenly between 0 and 1 stands for: of a list all are equally likely.
    pub(crate) fn at(&self, u: f64) -> f64 {
        match &self.values {
            Values::List(values) => {
                values[((u * values.len() as f64) as usize).min(values.len() - 1)]
            }
            Values::Distribution(distribution) => distribution.quantile(u),
        }
    }

    /// A value as the case file would have it.
    pub(super) fn written(&self, value: f64) -> Value {
        Amount::written(value, &self.unit, self.whole)
    }
}
