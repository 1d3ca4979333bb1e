//! Shock equation of state.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    units::Velocity,
};

/// Mie–Grüneisen equation of state about a linear shock Hugoniot `U_s = c₀ + s u_p`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EquationOfState {
    /// Bulk sound speed c₀ [m/s].
    pub sound_speed: Velocity,
    /// Slope s of shock speed against particle speed.
    pub slope: f64,
    /// Grüneisen's parameter Γ₀ at rest; `Γ ρ` is taken to be constant.
    pub gruneisen: f64,
    /// Bibliography keys.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<String>,
    /// Limitations.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

impl EquationOfState {
    pub(super) fn check(&self, check: &mut Check<'_>) {
        check.quantity("sound_speed", self.sound_speed, limits::SOUND_SPEED);
        check.number("slope", self.slope, limits::HUGONIOT_SLOPE);
        check.number("gruneisen", self.gruneisen, limits::GRUNEISEN);
    }
}
