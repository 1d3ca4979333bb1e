use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, LaneLaw, LaneStrength, PreparedStrength, StrengthLaw};
use crate::{
    check::{Check, limits},
    lanes::Real,
    material::Material,
    power::power_here,
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

crate::per_lane! {
    /// `Y = K (ε_0 + ε_p)ⁿ`: a flow stress that is a power of the plastic strain, or constant where `n` is 0.
    #[derive(Debug, Clone, Copy, Default, PartialEq)]
    pub struct Hardening<R: Real = f64> {
        /// Stress at unit strain K, constraint factor included [Pa].
        pub coefficient: R,
        /// Exponent n.
        pub exponent: R,
        /// Strain where the plastic strain is 0, ε_0.
        pub first_strain: R,
    }
}

impl Hardening {
    /// A flow stress that stays what it is [Pa].
    pub fn none(flow_stress: f64) -> Self {
        Self {
            coefficient: flow_stress,
            exponent: 0.0,
            first_strain: 1.0,
        }
    }

    /// Flow stress and its slope with the plastic strain [Pa], for code that has been dispatched to an instruction set.
    #[inline(always)]
    pub(crate) fn at_here(&self, plastic_strain: f64) -> (f64, f64) {
        let strain = self.first_strain + plastic_strain;
        let stress = self.coefficient * power_here(strain, self.exponent);
        (stress, self.exponent * stress / strain)
    }
}

impl LaneStrength for Hardening {
    #[inline(always)]
    fn thermal(&self, _: f64) -> f64 {
        1.0
    }

    #[inline(always)]
    fn flow_stress(&self, _: f64, state: &FlowState) -> FlowStress {
        let (stress, strain_slope) = self.at_here(state.plastic_strain);
        FlowStress {
            stress,
            strain_slope,
            rate_slope: 0.0,
        }
    }

    #[inline(always)]
    fn depends_on_strain_only(&self) -> bool {
        true
    }
}

impl PreparedStrength for Hardening {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        LaneLaw::Hardening(*self).flow_stress(state)
    }

    fn depends_on_strain_only(&self) -> bool {
        true
    }

    fn in_lanes(&self) -> Option<LaneLaw> {
        Some(LaneLaw::Hardening(*self))
    }
}

impl StrengthLaw for PowerLaw {
    fn prepare(&self, material: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        Box::new(Hardening {
            coefficient: factor * self.coefficient.si(),
            exponent: self.exponent,
            first_strain: self.yield_strain(material.youngs_modulus.si(), factor),
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
