//! One parameter of a sweep: its checked values. A value that is no number counts as its place in the list.

use toml::Value;

use super::{copula::Copula, distribution::Distribution, quantity_literal::QuantityLiteral};

/// A number or an option of the case with the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Dotted key in the case.
    pub key: String,
    /// Unit of the values; empty for plain numbers.
    pub unit: String,
    /// Key of the sweep file that gives the values, such as `linear` or `normal`.
    pub kind: &'static str,
    /// Values that it takes.
    pub values: Values,
    /// Whether the values are whole numbers.
    pub(crate) whole: bool,
    /// Values that have to be possible by themselves, each with the key that it is written under.
    pub samples: Vec<(String, f64)>,
}

/// Values of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers, in the unit of the parameter.
    List(Vec<f64>),
    /// Words and switches, which stand for their places in the list.
    Options(Vec<Value>),
    /// Numbers drawn from a distribution.
    Distribution(Distribution),
}

/// The values of all axes that numbers drawn evenly between 0 and 1 stand for.
pub fn values(axes: &[Axis], copula: Option<&Copula>, u: &[f64]) -> Vec<f64> {
    let mut values: Vec<f64> = axes.iter().zip(u).map(|(axis, u)| axis.at(*u)).collect();
    if let Some(copula) = copula {
        copula.join(axes, u, &mut values);
    }
    values
}

/// Name of the column of a key with values in a unit, in the manner of the other columns.
pub fn column_name(key: &str, unit: &str) -> String {
    let unit = unit.to_lowercase();
    let words = unit.split(|c: char| !c.is_alphanumeric());
    let words = words.filter(|word| !word.is_empty());
    words.fold(key.to_owned(), |name, word| format!("{name}_{word}"))
}

impl Axis {
    /// Name of its column: the key, and the unit in the manner of the other columns.
    pub fn column(&self) -> String {
        column_name(&self.key, &self.unit)
    }

    /// Its values in words, such as `normal, 230 ± 3 m/s`.
    pub fn describe(&self) -> String {
        match &self.values {
            Values::List(values) => format!("one of {} values", values.len()),
            Values::Options(options) => format!("one of {} options", options.len()),
            Values::Distribution(distribution) => distribution.describe(&self.unit),
        }
    }

    /// Number of values of a list; a distribution has none.
    pub fn count(&self) -> Option<u64> {
        match &self.values {
            Values::List(values) => Some(values.len() as u64),
            Values::Options(options) => Some(options.len() as u64),
            Values::Distribution(_) => None,
        }
    }

    /// Its distribution, unless it takes the values of a list.
    pub fn distribution(&self) -> Option<&Distribution> {
        match &self.values {
            Values::List(_) | Values::Options(_) => None,
            Values::Distribution(distribution) => Some(distribution),
        }
    }

    /// The words that its values stand for, where they are no numbers: value 0 for the first, and so on.
    pub fn words(&self) -> Option<Vec<String>> {
        let Values::Options(options) = &self.values else {
            return None;
        };
        let word = |option: &Value| match option {
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        Some(options.iter().map(word).collect())
    }

    /// The value that a number drawn evenly between 0 and 1 stands for: of a list all are equally likely.
    pub fn at(&self, u: f64) -> f64 {
        match &self.values {
            Values::List(values) => values[drawn(u, values.len())],
            Values::Options(options) => drawn(u, options.len()) as f64,
            Values::Distribution(distribution) => distribution.quantile(u),
        }
    }

    /// A value as the case file would have it.
    pub fn written(&self, value: f64) -> Value {
        match &self.values {
            Values::Options(options) => options[value as usize].clone(),
            _ => QuantityLiteral::written(value, &self.unit, self.whole),
        }
    }
}

/// Place in a list of equally likely values of a number drawn evenly between 0 and 1.
fn drawn(u: f64, count: usize) -> usize {
    ((u * count as f64) as usize).min(count - 1)
}
