use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, Hardening, LaneLaw, PreparedStrength, StrengthLaw};
use crate::{
    check::{Check, limits},
    material::Material,
    units::Pressure,
};

/// Concrete, known by its unconfined compressive strength alone \[forrestal1994\].
///
/// Models made for concrete use that strength; no model of this library follows its pressure-dependent flow.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Concrete {
    /// Unconfined compressive strength f_c [Pa].
    pub compressive_strength: Pressure,
}

#[derive(Debug)]
struct Prepared {
    stress: f64,
}

impl PreparedStrength for Prepared {
    fn flow_stress(&self, _: &FlowState) -> FlowStress {
        FlowStress {
            stress: self.stress,
            strain_slope: 0.0,
            rate_slope: 0.0,
        }
    }

    fn depends_on_strain_only(&self) -> bool {
        true
    }

    fn in_lanes(&self) -> Option<LaneLaw> {
        Some(LaneLaw::Hardening(Hardening::none(self.stress)))
    }
}

impl StrengthLaw for Concrete {
    fn prepare(&self, _: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        Box::new(Prepared {
            stress: factor * self.compressive_strength.si(),
        })
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        Some(self.compressive_strength.si())
    }

    fn initial_yield_stress(&self, _: &Material) -> Option<f64> {
        Some(self.compressive_strength.si())
    }

    fn equation(&self) -> &'static str {
        "σ = f_c"
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        vec![(
            "f_c (compressive_strength)",
            self.compressive_strength.to_string(),
        )]
    }

    fn check(&self, check: &mut Check<'_>) {
        check.quantity(
            "compressive_strength",
            self.compressive_strength,
            limits::CONCRETE_STRENGTH,
        );
    }
}

/// Factor S on the compressive strength [Pa] of concrete \[forrestal1994\].
pub fn strength_factor(compressive_strength: f64) -> f64 {
    82.6 * (compressive_strength * 1e-6).powf(-0.544)
}
