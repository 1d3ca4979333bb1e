//! Options of the model `power_balance`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::defaults::{HEAT_FRACTION, defaults};
use crate::{
    check::{Check, limits},
    problem::Target,
};

/// Options of the model `power_balance`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = power_balance_in_schema)]
#[non_exhaustive]
pub struct PowerBalanceOptions {
    /// Whether a flat face sinks into the plate; without it, face and plug meet without bounce.
    pub indentation: Option<bool>,
    /// Whether the plate around the projectile bends and stretches.
    pub bulging: Option<bool>,
    /// Fraction of plastic work that becomes heat.
    pub heat_fraction: Option<f64>,
}

defaults! { PowerBalanceOptions, power_balance_in_schema {
    /// Whether a flat face sinks into the plate.
    indentation: bool = true;
    /// Whether the plate around the projectile bends and stretches.
    bulging: bool = true;
    /// Fraction of plastic work that becomes heat.
    heat_fraction: f64 = HEAT_FRACTION;
} }

impl PowerBalanceOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.number("heat_fraction", self.heat_fraction, limits::HEAT_FRACTION);
    }
}
