use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, Hardening, LaneLaw, PreparedStrength, StrengthLaw};
use crate::{
    check::{Check, limits},
    material::Material,
    units::Pressure,
};

/// Elastic, then flow at a constant stress.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PerfectlyPlastic {
    /// Flow stress [Pa].
    pub flow_stress: Pressure,
}

#[derive(Debug)]
struct Prepared {
    flow_stress: f64,
}

impl PreparedStrength for Prepared {
    fn flow_stress(&self, _: &FlowState) -> FlowStress {
        FlowStress {
            stress: self.flow_stress,
            strain_slope: 0.0,
            rate_slope: 0.0,
        }
    }

    fn depends_on_strain_only(&self) -> bool {
        true
    }

    fn in_lanes(&self) -> Option<LaneLaw> {
        Some(LaneLaw::Hardening(Hardening::none(self.flow_stress)))
    }
}

/// A law of one flow stress [Pa].
pub fn perfectly_plastic(flow_stress: f64) -> Box<dyn PreparedStrength> {
    Box::new(Prepared { flow_stress })
}

impl StrengthLaw for PerfectlyPlastic {
    fn prepare(&self, _: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        perfectly_plastic(factor * self.flow_stress.si())
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        Some(self.flow_stress.si())
    }

    fn initial_yield_stress(&self, _: &Material) -> Option<f64> {
        Some(self.flow_stress.si())
    }

    fn equation(&self) -> &'static str {
        "σ = Y"
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        vec![("Y (flow_stress)", self.flow_stress.to_string())]
    }

    fn check(&self, check: &mut Check<'_>) {
        check.quantity("flow_stress", self.flow_stress, limits::FLOW_STRESS);
    }
}
