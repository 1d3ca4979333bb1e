use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, Hardening, LaneLaw, PreparedStrength, StrengthLaw};
use crate::{check::Check, material::Material};

/// Linear elastic behaviour without a limit.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elastic {}

impl PreparedStrength for Elastic {
    fn flow_stress(&self, _: &FlowState) -> FlowStress {
        FlowStress {
            stress: f64::INFINITY,
            strain_slope: 0.0,
            rate_slope: 0.0,
        }
    }

    fn depends_on_strain_only(&self) -> bool {
        true
    }

    fn in_lanes(&self) -> Option<LaneLaw> {
        Some(LaneLaw::Hardening(Hardening::none(f64::INFINITY)))
    }
}

impl StrengthLaw for Elastic {
    fn prepare(&self, _: &Material, _: f64) -> Box<dyn PreparedStrength> {
        Box::new(*self)
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        None
    }

    fn initial_yield_stress(&self, _: &Material) -> Option<f64> {
        None
    }

    fn equation(&self) -> &'static str {
        "σ = E ε"
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    fn check(&self, _: &mut Check<'_>) {}
}
