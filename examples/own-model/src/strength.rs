//! Strength law `σ = Y + H ε`.

use percuss::{
    check::Check,
    material::{FlowState, FlowStress, Material, PreparedStrength, StrengthLaw},
};

/// Linear hardening.
#[derive(Debug, Clone, Copy)]
pub struct LinearHardening {
    /// Stress at which flow starts [Pa].
    pub yield_stress: f64,
    /// Slope with plastic strain [Pa].
    pub modulus: f64,
}

impl StrengthLaw for LinearHardening {
    fn prepare(&self, _: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        Box::new(Self {
            yield_stress: factor * self.yield_stress,
            modulus: factor * self.modulus,
        })
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        Some(self.yield_stress + self.modulus)
    }

    fn initial_yield_stress(&self, _: &Material) -> Option<f64> {
        Some(self.yield_stress)
    }

    fn equation(&self) -> &'static str {
        "σ = Y + H ε"
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        let mpa = |stress: f64| format!("{} MPa", 1e-6 * stress);
        vec![("Y", mpa(self.yield_stress)), ("H", mpa(self.modulus))]
    }

    fn check(&self, _: &mut Check<'_>) {}

    fn fingerprint(&self) -> Option<String> {
        Some(format!("{self:?}"))
    }
}

impl PreparedStrength for LinearHardening {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        FlowStress {
            stress: self.yield_stress + self.modulus * state.plastic_strain,
            strain_slope: self.modulus,
            ..FlowStress::default()
        }
    }

    fn depends_on_strain_only(&self) -> bool {
        true
    }
}
