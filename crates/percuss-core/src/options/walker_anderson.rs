//! Options of the model `walker_anderson`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::{Length, Pressure},
};

/// Options of the model `walker_anderson`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct WalkerAndersonOptions {
    /// Flow stress of the projectile [Pa]; that at a plastic strain of 0.1 when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projectile_strength: Option<Pressure>,
    /// Flow stress of the target [Pa], not its resistance; that at a plastic strain of 0.1 when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target_strength: Option<Pressure>,
    /// Radius of the crater [m]; from the impact velocity when not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crater_radius: Option<Length>,
}

impl WalkerAndersonOptions {
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
