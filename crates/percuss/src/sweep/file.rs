//! The sweep file as types.

use std::path::PathBuf;

use serde::{Deserialize, Deserializer};

use super::entry::Entry;
use crate::units::{shorten, split_number};

/// A sweep as its TOML file holds it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SweepFile {
    /// One line that says what the sweep is.
    #[serde(default)]
    pub(super) title: String,
    /// The case that is varied, relative to the sweep file.
    pub(super) base: PathBuf,
    pub(super) model: String,
    pub(super) design: Design,
    /// Number of shots; a grid has as many as its lists make.
    pub(super) samples: Option<u64>,
    pub(super) seed: Option<u64>,
    /// Shots in one file of the result.
    pub(super) block_size: Option<u64>,
    #[serde(default)]
    pub(super) parameter: Vec<Parameter>,
}

/// How the shots are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Design {
    /// Every combination of the values; the first parameter varies slowest.
    Grid,
    /// One shot in each of as many equally likely intervals of every parameter as there are shots, matched at random.
    LatinHypercube,
    /// Sobol' points with Owen's scrambling.
    Sobol,
}

impl Design {
    /// Its name as the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::LatinHypercube => "latin-hypercube",
            Self::Sobol => "sobol",
        }
    }
}

/// A number or an option of the case and the values it takes: just one of the other keys.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Parameter {
    pub(super) key: String,
    pub(super) values: Option<Vec<Entry>>,
    pub(super) linear: Option<Steps>,
    pub(super) log: Option<Steps>,
    pub(super) normal: Option<Normal>,
    pub(super) lognormal: Option<Lognormal>,
    pub(super) uniform: Option<Uniform>,
    pub(super) triangular: Option<Triangular>,
}

/// Values at even steps, both ends included.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Steps {
    pub(super) from: Amount,
    pub(super) to: Amount,
    pub(super) count: u64,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Normal {
    pub(super) mean: Amount,
    pub(super) standard_deviation: Amount,
    pub(super) min: Option<Amount>,
    pub(super) max: Option<Amount>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Lognormal {
    pub(super) median: Amount,
    /// Standard deviation of the natural logarithm.
    pub(super) log_standard_deviation: f64,
    pub(super) min: Option<Amount>,
    pub(super) max: Option<Amount>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Uniform {
    pub(super) from: Amount,
    pub(super) to: Amount,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Triangular {
    pub(super) from: Amount,
    pub(super) mode: Amount,
    pub(super) to: Amount,
}

/// A number, or a number with a unit in quotes. Whether the unit fits is for the case to say.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Amount {
    pub(super) value: f64,
    pub(super) unit: String,
    /// Whether it is written as a whole number.
    pub(super) whole: bool,
}

impl<'de> Deserialize<'de> for Amount {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AmountVisitor)
    }
}

pub(super) struct AmountVisitor;

impl serde::de::Visitor<'_> for AmountVisitor {
    type Value = Amount;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a number, or one with a unit in quotes such as \"230 m/s\"")
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<Amount, E> {
        if !value.is_finite() {
            return Err(E::custom("the number is not finite\nwrite a finite number"));
        }
        Ok(Amount {
            value,
            unit: String::new(),
            whole: false,
        })
    }

    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<Amount, E> {
        Ok(Amount {
            value: value as f64,
            unit: String::new(),
            // Beyond, a float would stand for a neighbour as well.
            whole: value.unsigned_abs() <= 1 << 53,
        })
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Amount, E> {
        let bad = |what: &str| {
            let text = shorten(text);
            E::custom(format!(
                "`{text}` {what}\nwrite a number with a unit, such as \"230 m/s\", or without quotes one that has none"
            ))
        };
        match split_number(text.trim()) {
            Some((value, _)) if !value.is_finite() => Err(bad("is not a finite number")),
            Some((_, "")) => Err(bad("has no unit")),
            Some((value, unit)) => Ok(Amount {
                value,
                unit: unit.to_owned(),
                whole: false,
            }),
            None => Err(bad("is no number")),
        }
    }
}
