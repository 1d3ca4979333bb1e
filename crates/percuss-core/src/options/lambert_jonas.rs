//! Options of the model `lambert_jonas`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::Velocity,
};

/// Options of the model `lambert_jonas`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct LambertJonasOptions {
    /// Ballistic limit [m/s]; that of `plugging` (flat noses) or `plate_cavity` (sharp ones) when not given.
    pub ballistic_limit: Option<Velocity>,
    /// Factor a; `m/(m + m_p/3)` with the mass m_p of plate in line with the shank when not given.
    pub a: Option<f64>,
    /// Exponent p; `2 + h/(3D)` when not given.
    pub p: Option<f64>,
}

impl LambertJonasOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.quantity(
            "ballistic_limit",
            self.ballistic_limit,
            limits::IMPACT_VELOCITY,
        );
        check.number("a", self.a, limits::RESIDUAL_FACTOR);
        check.number("p", self.p, limits::RESIDUAL_EXPONENT);
    }
}
