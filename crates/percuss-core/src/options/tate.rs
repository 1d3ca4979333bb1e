//! Options of the model `tate`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `tate`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct TateOptions {
    /// Strength Y of the projectile [Pa]; its flow stress at a plastic strain of 0.1 when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projectile_strength: Option<Pressure>,
    /// Resistance R of the target [Pa]; the pressure that slowly expands a spherical cavity in it when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_resistance: Option<Pressure>,
}

impl TateOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        for (key, value) in [
            ("projectile_strength", self.projectile_strength),
            ("target_resistance", self.target_resistance),
        ] {
            check.quantity(key, value, limits::FLOW_STRESS);
        }
    }
}
