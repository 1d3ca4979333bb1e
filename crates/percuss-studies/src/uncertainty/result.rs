//! Result of an uncertainty analysis. The names are stable.

use serde::Serialize;

use super::{
    axisymmetric::AxisymmetricSpread,
    indices::SobolIndices,
    perforation::Perforation,
    quantity::{quantities, quantity},
    statistics::Statistics,
};
use crate::{
    model_error::ModelErrorEstimate, outcome::Outcome, summary::ResultNumber, sweep::SweepRow,
};

/// What the uncertainty of a case's numbers does to its results.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Uncertainty {
    /// Name of the case.
    pub case: String,
    /// Version of the program.
    pub percuss_version: &'static str,
    /// Name of the model.
    pub model: &'static str,
    /// Runs that the statistics rest on.
    pub samples: u64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// All runs that were computed.
    pub runs: u64,
    /// The uncertain numbers.
    pub inputs: Vec<Input>,
    /// Whether they depend on each other.
    pub correlated: bool,
    /// The run with every uncertain number at its median.
    pub nominal: Nominal,
    /// Runs of the sample without a result.
    pub failures: Failures,
    /// Probability of perforation; null when no run decides it.
    pub perforation: Option<Perforation>,
    /// Each quantity that was looked at.
    pub quantities: Vec<QuantityResult>,
    /// Why there are no Sobol' indices, if there are none at all.
    pub no_indices: Option<String>,
    /// Spread at each impact velocity, where velocities were asked for.
    pub bands: Vec<Band>,
    /// Mean and spread corrected by axisymmetric runs; null where none were asked for.
    pub axisymmetric: Option<AxisymmetricSpread>,
    /// Limitations of the numbers.
    pub warnings: Vec<String>,
    /// The runs of the sample; not in JSON.
    #[serde(skip)]
    pub draws: Vec<Draw>,
}

/// An uncertain number of the case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Input {
    /// Key in the case.
    pub key: String,
    /// Unit; empty for a plain number.
    pub unit: String,
    /// Its distribution in words.
    pub distribution: String,
    /// A twentieth lies below.
    pub low: f64,
    /// Median.
    pub median: f64,
    /// A twentieth lies above.
    pub high: f64,
    /// Its key, without the middle where that is long.
    #[serde(skip)]
    pub label: String,
    /// Name of its column in tables.
    #[serde(skip)]
    pub column: String,
    /// The words that its values stand for; none for numbers.
    #[serde(skip)]
    pub words: Option<Vec<String>>,
}

/// The run with every uncertain number at its median.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Nominal {
    /// How it ended.
    pub outcome: Outcome,
    /// Why it has no result, if it has none.
    pub reason: Option<String>,
    /// Error to expect of its depth, which comes on top of the spread.
    pub expected_error: Option<ModelErrorEstimate>,
    /// What the model warns of.
    pub warnings: Vec<String>,
}

/// Runs without a result: they are left out of all statistics.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Failures {
    /// How many.
    pub runs: usize,
    /// The first few reasons.
    pub reasons: Vec<String>,
}

/// What is said of a quantity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct QuantityResult {
    /// Its name in results, with the unit.
    pub quantity: &'static str,
    /// Its value in the nominal run.
    pub nominal: Option<f64>,
    /// Runs with a result that lack a value of it.
    pub without_value: usize,
    /// Its statistics.
    pub statistics: Statistics,
    /// Each parameter low and high, the longest bar first.
    pub tornado: Vec<TornadoBar>,
    /// Sobol' indices.
    pub indices: Option<SobolIndices>,
    /// Why this quantity has no indices where others may have some.
    pub no_indices: Option<String>,
}

impl Uncertainty {
    /// What tables and figures call a parameter.
    pub fn label<'a>(&'a self, key: &'a str) -> &'a str {
        let input = self.inputs.iter().find(|input| input.key == key);
        input.map_or(key, |input| &input.label)
    }

    /// What the spread leaves out.
    pub fn caution(&self) -> String {
        const SPREAD: &str = "The spread is that of the inputs. The model's own error comes on top";
        match &self.nominal.expected_error {
            Some(expected) => format!(
                "{SPREAD}: {} of the depth against the axisymmetric reference, over the {} most similar benchmark cases.",
                expected.describe(),
                expected.cases
            ),
            None => format!("{SPREAD}."),
        }
    }
}

impl QuantityResult {
    /// What it is.
    ///
    /// # Panics
    /// Never: results hold quantities of the list only.
    pub fn what(&self) -> &'static ResultNumber {
        quantity(self.quantity).expect("a quantity of the list")
    }
}

/// A quantity with one parameter low and high and all others at their medians.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TornadoBar {
    /// Key of the parameter.
    pub key: String,
    /// Value where the parameter is at its 5th percentile.
    pub at_low: Option<f64>,
    /// Value where the parameter is at its 95th percentile.
    pub at_high: Option<f64>,
}

impl TornadoBar {
    /// Difference of the two, 0 where one is missing.
    pub fn length(&self) -> f64 {
        match (self.at_low, self.at_high) {
            (Some(low), Some(high)) => (high - low).abs(),
            _ => 0.0,
        }
    }
}

/// Spread at one impact velocity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Band {
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Runs at this velocity.
    pub runs: usize,
    /// Runs without a result among them.
    pub failed: usize,
    /// Probability of perforation.
    pub perforation: Option<Perforation>,
    /// Each quantity that was looked at.
    pub quantities: Vec<QuantitySpread>,
}

/// Spread of a quantity at one impact velocity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct QuantitySpread {
    /// Its name in results, with the unit.
    pub quantity: &'static str,
    /// Its statistics; null where no run has a value.
    pub statistics: Option<Statistics>,
}

/// A run of the sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Draw {
    /// Values of the uncertain numbers.
    pub inputs: Vec<f64>,
    /// How it ended.
    pub outcome: Outcome,
    /// A value for each of [`quantities()`].
    pub values: Vec<Option<f64>>,
    /// Why there is no result; empty when there is one.
    pub error: String,
}

impl Draw {
    /// What is kept of a row.
    pub(super) fn of(row: SweepRow) -> Self {
        match row.record {
            Ok(record) => Self {
                inputs: row.inputs,
                outcome: record.outcome,
                values: quantities()
                    .map(|quantity| quantity.for_statistics(&record))
                    .collect(),
                error: record.reason.unwrap_or_default(),
            },
            Err(error) => Self {
                inputs: row.inputs,
                outcome: Outcome::Failed,
                values: vec![None; quantities().count()],
                error,
            },
        }
    }

    /// The value of a quantity.
    pub fn value(&self, quantity: &ResultNumber) -> Option<f64> {
        let place = quantities().position(|q| q.name == quantity.name)?;
        self.values[place]
    }

    /// Whether it has no result.
    pub fn is_failed(&self) -> bool {
        matches!(self.outcome, Outcome::Failed | Outcome::NotApplicable)
    }
}
