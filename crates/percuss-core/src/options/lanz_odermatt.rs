//! Options of the model `lanz_odermatt`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
};

/// Options of the model `lanz_odermatt`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct LanzOdermattOptions {
    /// Brinell hardness of the target; that of its material when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_hardness: Option<f64>,
}

impl LanzOdermattOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.number(
            "target_hardness",
            self.target_hardness,
            limits::BRINELL_HARDNESS,
        );
    }
}
