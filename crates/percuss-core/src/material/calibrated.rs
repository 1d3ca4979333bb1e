//! Provenance of a calibrated material record.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where constants come from that a model was fitted with: on these sources the record is no test of anything.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Calibrated {
    /// Keys of the constants that were fitted.
    pub parameters: Vec<String>,
    /// The record that the other constants come from.
    pub from: String,
    /// The model that computed the tests: with another one the constants may be far off.
    pub model: String,
    /// Sources of the tests: validation does not count them as blind.
    pub sources: Vec<String>,
    /// The tests and cases.
    pub tests: Vec<String>,
    /// Version of the program.
    pub percuss_version: String,
    /// Seed of the random numbers.
    pub seed: u64,
}
