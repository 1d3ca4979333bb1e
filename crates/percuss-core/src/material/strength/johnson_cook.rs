use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, PreparedStrength, StrengthLaw};
use crate::{
    check::{Check, limits},
    material::Material,
    units::{Pressure, StrainRate},
};

/// Johnson–Cook strength \[johnson1983\].
///
/// `σ = (A + B ε_pⁿ)(1 + C ln ε̇*)(1 − T*ᵐ)` with `ε̇* = ε̇ / ε̇₀`, not less than 1, and
/// `T* = (T − T_room)/(T_melt − T_room)`, held between 0 and 1: at the melting point the strength is gone.
/// The thermal factor is 1 for a material without a melting temperature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JohnsonCook {
    /// Yield stress A [Pa].
    pub a: Pressure,
    /// Hardening coefficient B [Pa].
    pub b: Pressure,
    /// Hardening exponent n.
    pub n: f64,
    /// Rate coefficient C.
    pub c: f64,
    /// Thermal softening exponent m.
    pub m: f64,
    /// Reference strain rate ε̇₀ [1/s].
    #[serde(default = "reference_rate")]
    pub reference_rate: StrainRate,
    /// Form of the rate factor.
    #[serde(default)]
    pub rate_form: RateForm,
}

/// Form of the rate factor of a Johnson–Cook law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RateForm {
    /// `1 + C ln ε̇*`, the original.
    #[default]
    Logarithmic,
    /// `(1 + ε̇*)^C`, the modified law \[borvik2001\].
    Power,
}

fn reference_rate() -> StrainRate {
    StrainRate::new(1.0)
}

#[derive(Debug)]
struct Prepared {
    a: f64,
    b: f64,
    n: f64,
    c: f64,
    m: f64,
    reference_rate: f64,
    rate_form: RateForm,
    room_temperature: f64,
    melting_range: f64,
}

/// Plastic strain below which the slope of `ε_pⁿ` is taken at this strain: the slope of the law is infinite at zero.
const SMALLEST_STRAIN: f64 = 1e-9;

/// `x^p` of a number that is not negative, for exponents of the order of 1: there it is exact to a few units in the last place,
/// and cheaper than `powf`.
fn power(x: f64, exponent: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else if exponent == 1.0 {
        x
    } else {
        (exponent * x.ln()).exp()
    }
}

impl PreparedStrength for Prepared {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        let strain = state.plastic_strain.max(SMALLEST_STRAIN);
        let hardened = self.b * power(strain, self.n);
        let ratio = state.strain_rate / self.reference_rate;
        let (rate_factor, rate_slope) = match self.rate_form {
            RateForm::Logarithmic if ratio > 1.0 => {
                (1.0 + self.c * ratio.ln(), self.c / state.strain_rate)
            }
            RateForm::Logarithmic => (1.0, 0.0),
            RateForm::Power => {
                let factor = power(1.0 + ratio, self.c);
                (
                    factor,
                    self.c * factor / (self.reference_rate * (1.0 + ratio)),
                )
            }
        };
        let homologous =
            ((state.temperature - self.room_temperature) / self.melting_range).clamp(0.0, 1.0);
        let thermal = 1.0 - power(homologous, self.m);
        FlowStress {
            stress: (self.a + hardened) * rate_factor * thermal,
            strain_slope: self.n * hardened / strain * rate_factor * thermal,
            rate_slope: (self.a + hardened) * rate_slope * thermal,
        }
    }
}

impl StrengthLaw for JohnsonCook {
    fn prepare(&self, material: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        let room = material.room_temperature.si();
        Box::new(Prepared {
            a: factor * self.a.si(),
            b: factor * self.b.si(),
            n: self.n,
            c: self.c,
            m: self.m,
            reference_rate: self.reference_rate.si(),
            rate_form: self.rate_form,
            room_temperature: room,
            melting_range: material
                .melting_temperature
                .map_or(f64::INFINITY, |melting| melting.si() - room),
        })
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        Some(self.a.si() + self.b.si())
    }

    fn initial_yield_stress(&self, _: &Material) -> Option<f64> {
        Some(self.a.si())
    }

    fn depends_on_temperature(&self) -> bool {
        true
    }

    fn equation(&self) -> &'static str {
        match self.rate_form {
            RateForm::Logarithmic => "σ = (A + B ε_pⁿ)(1 + C ln ε̇*)(1 − T*ᵐ)",
            RateForm::Power => "σ = (A + B ε_pⁿ)(1 + ε̇*)^C (1 − T*ᵐ)",
        }
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        vec![
            ("A (a)", self.a.to_string()),
            ("B (b)", self.b.to_string()),
            ("n", self.n.to_string()),
            ("C (c)", self.c.to_string()),
            ("m", self.m.to_string()),
            ("ε̇₀ (reference_rate)", self.reference_rate.to_string()),
        ]
    }

    fn check(&self, check: &mut Check<'_>) {
        check.quantity("a", self.a, limits::FLOW_STRESS);
        check.quantity("b", self.b, limits::HARDENING_COEFFICIENT);
        let ratio = self.b.si() / self.a.si();
        let allowed = limits::HARDENING_TO_YIELD;
        if self.b.si() > 0.0 && !(allowed.min..=allowed.max).contains(&ratio) {
            check.fail(
                "b",
                format!("b = {} is {ratio:.2e} of a = {}", self.b, self.a),
                format!(
                    "hardening solids lie between {} and {}: is one of them off by a factor of 1000? write 0 for no hardening",
                    allowed.min, allowed.max
                ),
            );
        }
        check.number("n", self.n, limits::JOHNSON_COOK_EXPONENT);
        check.number("c", self.c, limits::RATE_COEFFICIENT);
        check.number("m", self.m, limits::THERMAL_EXPONENT);
        check.quantity("reference_rate", self.reference_rate, limits::STRAIN_RATE);
    }
}
