//! Options of the model `momentum_balance`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::defaults::defaults;
use crate::{
    check::{Check, limits},
    problem::Target,
    units::{Length, Pressure},
};

/// Options of the model `momentum_balance`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = momentum_balance_in_schema)]
#[non_exhaustive]
pub struct MomentumBalanceOptions {
    /// Flow stress of the projectile [Pa]; that at a plastic strain of 0.1 when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projectile_strength: Option<Pressure>,
    /// Flow stress of the target [Pa], not its resistance; that of the cavity pressure when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_strength: Option<Pressure>,
    /// Radius of the floor of the crater [m]; from the force of the rod at impact when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crater_radius: Option<Length>,
    /// Whether neighbouring rays of the flow shear; without it the static pressure is that of an expanding spherical cavity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear: Option<bool>,
}

defaults! { MomentumBalanceOptions, momentum_balance_in_schema {
    /// Whether neighbouring rays of the flow shear.
    shear: bool = true;
} }

impl MomentumBalanceOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        for (key, value) in [
            ("projectile_strength", self.projectile_strength),
            ("target_strength", self.target_strength),
        ] {
            check.quantity(key, value, limits::FLOW_STRESS);
        }
        check.quantity("crater_radius", self.crater_radius, limits::DIAMETER);
    }
}
