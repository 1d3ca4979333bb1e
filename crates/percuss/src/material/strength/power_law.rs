use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, PreparedStrength, StrengthLaw};
use crate::{
    check::{Check, limits},
    material::Material,
    units::Pressure,
};

/// Power-law hardening of the total strain, `σ = σ₀ εⁿ` \[woodward1982, paper eq. 8\], met by the elastic line.
///
/// Below the strain `ε_y` at which `E ε = σ₀ εⁿ` the material is elastic; beyond it the flow stress is
/// `σ₀ (ε_y + ε_p)ⁿ`. The bare law would be infinitely stiff at zero strain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PowerLaw {
    /// Strength coefficient σ₀ [Pa]: the flow stress at unit strain.
    pub coefficient: Pressure,
    /// Hardening exponent n.
    pub exponent: f64,
}

impl PowerLaw {
    /// Strain at which the elastic line of slope `youngs_modulus` [Pa] meets the law, its stress multiplied by `factor`.
    pub fn yield_strain(&self, youngs_modulus: f64, factor: f64) -> f64 {
        (factor * self.coefficient.si() / youngs_modulus).powf(1.0 / (1.0 - self.exponent))
    }
}

#[derive(Debug)]
struct Prepared {
    coefficient: f64,
    exponent: f64,
    yield_strain: f64,
}

impl PreparedStrength for Prepared {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        let strain = self.yield_strain + state.plastic_strain;
        let stress = self.coefficient * strain.powf(self.exponent);
        FlowStress {
            stress,
            strain_slope: self.exponent * stress / strain,
            rate_slope: 0.0,
        }
    }

    fn depends_on_strain_only(&self) -> bool {
        true
    }
}

impl StrengthLaw for PowerLaw {
    fn prepare(&self, material: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        Box::new(Prepared {
            coefficient: factor * self.coefficient.si(),
            exponent: self.exponent,
            yield_strain: self.yield_strain(material.youngs_modulus.si(), factor),
        })
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        Some(self.coefficient.si())
    }

    fn initial_yield_stress(&self, material: &Material) -> Option<f64> {
        let modulus = material.youngs_modulus.si();
        Some(modulus * self.yield_strain(modulus, 1.0))
    }

    fn equation(&self) -> &'static str {
        "σ = σ₀ (ε_y + ε_p)ⁿ,  E ε_y = σ₀ ε_yⁿ"
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        vec![
            ("σ₀ (coefficient)", self.coefficient.to_string()),
            ("n (exponent)", self.exponent.to_string()),
        ]
    }

    fn check(&self, check: &mut Check<'_>) {
        check.quantity("coefficient", self.coefficient, limits::FLOW_STRESS);
        check.number("exponent", self.exponent, limits::HARDENING_EXPONENT);
    }
}
