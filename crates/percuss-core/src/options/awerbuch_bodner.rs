//! Options of the model `awerbuch_bodner`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `awerbuch_bodner`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct AwerbuchBodnerOptions {
    /// Stress that crushes the plate in front of the flat face [Pa]; 2.7 tensile strengths when not given.
    pub crushing_stress: Option<Pressure>,
    /// Shear strength of the plate [Pa]; its tensile strength over √3 when not given.
    pub shear_strength: Option<Pressure>,
}

impl AwerbuchBodnerOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        for (key, stress) in [
            ("crushing_stress", self.crushing_stress),
            ("shear_strength", self.shear_strength),
        ] {
            check.quantity(key, stress, limits::FLOW_STRESS);
        }
    }
}
