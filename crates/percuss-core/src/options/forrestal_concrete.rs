//! Options of the model `forrestal_concrete`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::defaults::defaults;
use crate::{
    check::{Check, limits},
    problem::Target,
};

/// Options of the model `forrestal_concrete`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = concrete_in_schema)]
#[non_exhaustive]
pub struct ForrestalConcreteOptions {
    /// Factor S on the compressive strength; `82.6 (f_c in MPa)^−0.544` \[forrestal1994\] when not given.
    pub s: Option<f64>,
    /// Depth k of the crater in projectile diameters.
    pub crater_depth_to_diameter: Option<f64>,
}

defaults! { ForrestalConcreteOptions, concrete_in_schema {
    /// Depth of the crater in projectile diameters.
    crater_depth_to_diameter: f64 = 2.0;
} }

impl ForrestalConcreteOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.number("s", self.s, limits::CONCRETE_FACTOR);
        check.number(
            "crater_depth_to_diameter",
            self.crater_depth_to_diameter,
            limits::CRATER_DEPTH,
        );
    }
}
