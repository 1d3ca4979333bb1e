//! Options of the model `energy_balance`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::defaults::defaults;
use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `energy_balance`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = energy_balance_in_schema)]
#[non_exhaustive]
pub struct EnergyBalanceOptions {
    /// Flow stress of the projectile [Pa]; its mean up to a strain of 1 at the rate V/D, heated by its own work, when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projectile_strength: Option<Pressure>,
    /// Flow stress of the target [Pa], not its resistance; that of the cavity pressure, at the rate V/D, when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_strength: Option<Pressure>,
    /// Whether the free surface around the entry lowers the resistance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entry: Option<bool>,
}

defaults! { EnergyBalanceOptions, energy_balance_in_schema {
    /// Whether the free surface around the entry lowers the resistance.
    entry: bool = true;
} }

impl EnergyBalanceOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        for (key, value) in [
            ("projectile_strength", self.projectile_strength),
            ("target_strength", self.target_strength),
        ] {
            check.quantity(key, value, limits::FLOW_STRESS);
        }
    }
}
