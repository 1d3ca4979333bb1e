//! Parameters of a file as types.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{list_value::ListValue, quantity_literal::QuantityLiteral};

/// How the runs are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Design {
    /// Every combination of the values; the first parameter varies slowest.
    Grid,
    /// One run in each of as many equally likely intervals of every parameter as there are runs, matched at random.
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Number of the case by the tables that it stands in, such as `projectile.impact_velocity`; entries of lists count from 0.
    pub key: String,
    /// A list.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub values: Option<Vec<ListValue>>,
    /// Values at even steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linear: Option<Steps>,
    /// Values at even ratios.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub log: Option<Steps>,
    /// Normal distribution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<Normal>,
    /// Distribution whose logarithm is normal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lognormal: Option<Lognormal>,
    /// Equally likely in between.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uniform: Option<Uniform>,
    /// Triangular distribution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub triangular: Option<Triangular>,
}

/// Values at even steps, both ends included.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Steps {
    /// Lower end.
    pub from: QuantityLiteral,
    /// Upper end.
    pub to: QuantityLiteral,
    /// Number of values.
    pub count: u64,
}

/// A normal distribution, which may be cut off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Normal {
    /// Mean.
    pub mean: QuantityLiteral,
    /// Standard deviation.
    pub standard_deviation: QuantityLiteral,
    /// Where it is cut off below.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<QuantityLiteral>,
    /// Where it is cut off above.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<QuantityLiteral>,
}

/// A lognormal distribution, which may be cut off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lognormal {
    /// Median.
    pub median: QuantityLiteral,
    /// Standard deviation of the natural logarithm.
    pub log_standard_deviation: f64,
    /// Where it is cut off below.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<QuantityLiteral>,
    /// Where it is cut off above.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<QuantityLiteral>,
}

/// A uniform distribution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Uniform {
    /// Lower end.
    pub from: QuantityLiteral,
    /// Upper end.
    pub to: QuantityLiteral,
}

/// A triangular distribution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Triangular {
    /// Lower end.
    pub from: QuantityLiteral,
    /// Likeliest value.
    pub mode: QuantityLiteral,
    /// Upper end.
    pub to: QuantityLiteral,
}
