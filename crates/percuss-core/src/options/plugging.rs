//! Options of the model `plugging`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `plugging`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct PluggingOptions {
    /// Shear strength of the plate [Pa]; its tensile strength over √3 when not given.
    pub shear_strength: Option<Pressure>,
}

impl PluggingOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.quantity("shear_strength", self.shear_strength, limits::FLOW_STRESS);
    }
}
