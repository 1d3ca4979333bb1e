use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, LaneLaw, LaneStrength, PreparedStrength, StrengthLaw};
use crate::{
    check::{Check, limits},
    lanes::{Real, larger, smaller},
    material::Material,
    power::power_here,
    units::{InversePressure, InverseTemperature, Pressure},
};

/// Steinberg–Cochran–Guinan strength \[steinberg1996\].
///
/// `Y = min(Y₀ [1 + β(ε_i + ε_p)]ⁿ, Y_max) · G(P, T)/G₀`, with `G/G₀ = 1 + A P − B (T − 300 K)`, not less than 0.
/// Compression of the lattice (the factor `η^{1/3}`) is left out: at the pressures of a thin rod it is below 1 %.
/// The law has no rate dependence; it was made for strain rates above 1e5 1/s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SteinbergGuinan {
    /// Initial yield stress Y₀ [Pa].
    pub y0: Pressure,
    /// Largest work-hardened yield stress [Pa].
    pub y_max: Pressure,
    /// Hardening coefficient β.
    pub beta: f64,
    /// Hardening exponent n.
    pub n: f64,
    /// Plastic strain of the material before impact ε_i.
    #[serde(default)]
    pub initial_plastic_strain: f64,
    /// Pressure coefficient of the shear modulus A [1/Pa]; zero where the source gives none.
    #[serde(default = "no_pressure_effect")]
    pub pressure_coefficient: InversePressure,
    /// Temperature coefficient of the shear modulus B [1/K]; zero where the source gives none.
    #[serde(default = "no_temperature_effect")]
    pub temperature_coefficient: InverseTemperature,
}

fn no_pressure_effect() -> InversePressure {
    InversePressure::new(0.0)
}

fn no_temperature_effect() -> InverseTemperature {
    InverseTemperature::new(0.0)
}

const REFERENCE_TEMPERATURE: f64 = 300.0;

crate::per_lane! {
    /// A Steinberg–Cochran–Guinan law made ready for one constraint factor.
    #[derive(Debug, Clone, Copy, Default)]
    pub struct SteinbergGuinanLaw<R: Real = f64> {
        y0: R,
        y_max: R,
        beta: R,
        n: R,
        initial_plastic_strain: R,
        pressure_coefficient: R,
        temperature_coefficient: R,
        factor: R,
    }
}

impl LaneStrength for SteinbergGuinanLaw {
    #[inline(always)]
    fn thermal(&self, temperature: f64) -> f64 {
        self.temperature_coefficient * (temperature - REFERENCE_TEMPERATURE)
    }

    #[inline(always)]
    fn flow_stress(&self, thermal: f64, state: &FlowState) -> FlowStress {
        let stiffening = self.pressure_coefficient * larger(state.pressure, 0.0);
        let scale = self.factor * larger(1.0 + stiffening - thermal, 0.0);
        let strain = 1.0 + self.beta * (self.initial_plastic_strain + state.plastic_strain);
        let hardened = self.y0 * power_here(strain, self.n);
        let slope = self.n * self.beta * hardened / strain;
        let is_below = hardened < self.y_max;
        FlowStress {
            stress: smaller(hardened, self.y_max) * scale,
            strain_slope: if is_below { slope * scale } else { 0.0 },
            rate_slope: 0.0,
        }
    }

    #[inline(always)]
    fn depends_on_strain_only(&self) -> bool {
        false
    }
}

impl SteinbergGuinan {
    fn with_factor(&self, factor: f64) -> SteinbergGuinanLaw {
        SteinbergGuinanLaw {
            y0: self.y0.si(),
            y_max: self.y_max.si(),
            beta: self.beta,
            n: self.n,
            initial_plastic_strain: self.initial_plastic_strain,
            pressure_coefficient: self.pressure_coefficient.si(),
            temperature_coefficient: self.temperature_coefficient.si(),
            factor,
        }
    }

    /// Flow stress without pressure at 300 K, the room temperature of the law [Pa].
    fn work_hardened(&self, plastic_strain: f64) -> f64 {
        let state = FlowState {
            plastic_strain,
            strain_rate: 0.0,
            temperature: REFERENCE_TEMPERATURE,
            pressure: 0.0,
        };
        PreparedStrength::flow_stress(&self.with_factor(1.0), &state).stress
    }
}

impl PreparedStrength for SteinbergGuinanLaw {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        LaneLaw::SteinbergGuinan(*self).flow_stress(state)
    }

    fn in_lanes(&self) -> Option<LaneLaw> {
        Some(LaneLaw::SteinbergGuinan(*self))
    }

    fn depends_on_pressure(&self) -> bool {
        self.pressure_coefficient != 0.0
    }
}

impl StrengthLaw for SteinbergGuinan {
    fn prepare(&self, _: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        Box::new(self.with_factor(factor))
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        Some(self.work_hardened(1.0))
    }

    fn initial_yield_stress(&self, _: &Material) -> Option<f64> {
        Some(self.work_hardened(0.0))
    }

    fn depends_on_temperature(&self) -> bool {
        self.temperature_coefficient.si() != 0.0
    }

    fn equation(&self) -> &'static str {
        "σ = min(Y₀ [1 + β(ε_i + ε_p)]ⁿ, Y_max) · [1 + A P − B (T − 300 K)]"
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        vec![
            ("Y₀ (y0)", self.y0.to_string()),
            ("Y_max (y_max)", self.y_max.to_string()),
            ("β (beta)", self.beta.to_string()),
            ("n", self.n.to_string()),
            ("ε_i", self.initial_plastic_strain.to_string()),
            ("A", self.pressure_coefficient.to_string()),
            ("B", self.temperature_coefficient.to_string()),
        ]
    }

    fn check(&self, check: &mut Check<'_>) {
        check.quantity("y0", self.y0, limits::FLOW_STRESS);
        check.quantity("y_max", self.y_max, limits::FLOW_STRESS);
        check.number("beta", self.beta, limits::STEINBERG_BETA);
        check.number("n", self.n, limits::JOHNSON_COOK_EXPONENT);
        check.number(
            "initial_plastic_strain",
            self.initial_plastic_strain,
            limits::PLASTIC_STRAIN,
        );
        // Zero means that the source gives no coefficient.
        if self.pressure_coefficient.si() != 0.0 {
            check.quantity(
                "pressure_coefficient",
                self.pressure_coefficient,
                limits::PRESSURE_COEFFICIENT,
            );
        }
        if self.temperature_coefficient.si() != 0.0 {
            check.quantity(
                "temperature_coefficient",
                self.temperature_coefficient,
                limits::TEMPERATURE_COEFFICIENT,
            );
        }
        if self.y_max.si() < self.y0.si() {
            check.fail(
                "y_max",
                format!("y_max = {} is below y0 = {}", self.y_max, self.y0),
                "the work-hardened yield stress cannot be below the initial one",
            );
        }
    }
}
