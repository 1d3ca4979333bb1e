//! Options of the model `recht_ipson`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::Velocity,
};

/// Options of the model `recht_ipson`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct RechtIpsonOptions {
    /// Ballistic limit [m/s]; that of `plugging` (flat noses) or `plate_cavity` (sharp ones) when not given.
    pub ballistic_limit: Option<Velocity>,
}

impl RechtIpsonOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.quantity(
            "ballistic_limit",
            self.ballistic_limit,
            limits::IMPACT_VELOCITY,
        );
    }
}
