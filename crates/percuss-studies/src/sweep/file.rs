//! The sweep file as a type.

use std::path::PathBuf;

use serde::Deserialize;

use crate::{
    inputs::{Correlation, Design, Parameter},
    model::DEFAULT_MODEL,
};

/// A sweep as its TOML file holds it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SweepFile {
    /// One line that says what the sweep is.
    #[serde(default)]
    pub(super) title: String,
    /// The case that is varied, relative to the sweep file.
    pub(super) base: PathBuf,
    /// [`DEFAULT_MODEL`] by default, as in the other studies.
    #[serde(default = "default_model")]
    pub(super) model: String,
    pub(super) design: Design,
    /// Number of runs; a grid has as many as its lists make.
    pub(super) samples: Option<u64>,
    pub(super) seed: Option<u64>,
    /// Runs in one file of the result.
    pub(super) block_size: Option<u64>,
    #[serde(default)]
    pub(super) parameter: Vec<Parameter>,
    pub(super) correlation: Option<Correlation>,
}

fn default_model() -> String {
    DEFAULT_MODEL.to_owned()
}
