use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FlowState, FlowStress, LaneLaw, LaneStrength, PreparedStrength, StrengthLaw};
use crate::{
    check::{Check, limits},
    lanes::{Real, larger, smaller},
    material::Material,
    power::{ln_of_normal, power_here},
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

crate::per_lane! {
    /// A Johnson–Cook law made ready for one material and one constraint factor, with the logarithm of the strain rate.
    #[derive(Debug, Clone, Copy, Default)]
    pub struct JohnsonCookLaw<R: Real = f64> {
        a: R,
        b: R,
        n: R,
        c: R,
        m: R,
        /// One over the reference strain rate [s].
        per_rate: R,
        room_temperature: R,
        /// From there to the melting temperature [K]; infinite without one.
        melting_range: R,
    }
}

crate::per_lane! {
    /// The same with a power of the strain rate.
    #[derive(Debug, Clone, Copy, Default)]
    pub struct ModifiedJohnsonCookLaw<R: Real = f64> {
        law: JohnsonCookLaw<R>,
    }
}

/// Plastic strain below which the slope of `ε_pⁿ` is taken at this strain: the slope of the law is infinite at zero.
const SMALLEST_STRAIN: f64 = 1e-9;

impl JohnsonCookLaw {
    /// The thermal factor.
    #[inline(always)]
    fn softening(&self, temperature: f64) -> f64 {
        let homologous = (temperature - self.room_temperature) / self.melting_range;
        1.0 - power_here(smaller(larger(homologous, 0.0), 1.0), self.m)
    }

    /// Flow stress at a rate factor and its slope with the strain rate.
    #[inline(always)]
    fn at(&self, plastic_strain: f64, thermal: f64, [factor, slope]: [f64; 2]) -> FlowStress {
        let strain = larger(plastic_strain, SMALLEST_STRAIN);
        let hardened = self.b * power_here(strain, self.n);
        let stress = self.a + hardened;
        FlowStress {
            stress: stress * factor * thermal,
            strain_slope: self.n * hardened / strain * factor * thermal,
            rate_slope: stress * slope * thermal,
        }
    }
}

impl LaneStrength for JohnsonCookLaw {
    const LOGARITHMIC: bool = true;

    #[inline(always)]
    fn rate_exponent(&self, _: f64) -> f64 {
        0.0
    }

    #[inline(always)]
    fn thermal(&self, temperature: f64) -> f64 {
        self.softening(temperature)
    }

    #[inline(always)]
    fn flow_stress(&self, thermal: f64, state: &FlowState) -> FlowStress {
        let ratio = state.strain_rate * self.per_rate;
        let least = larger(ratio, 1.0);
        let slope = self.c * self.per_rate / least;
        let rate = [
            1.0 + self.c * ln_of_normal(least),
            if ratio > 1.0 { slope } else { 0.0 },
        ];
        self.at(state.plastic_strain, thermal, rate)
    }

    #[inline(always)]
    fn depends_on_strain_only(&self) -> bool {
        false
    }
}

impl LaneStrength for ModifiedJohnsonCookLaw {
    const LOGARITHMIC: bool = true;

    #[inline(always)]
    fn rate_exponent(&self, strain_rate: f64) -> f64 {
        let ratio = strain_rate * self.law.per_rate;
        (1.0 + self.law.c * ratio) / (1.0 + ratio)
    }

    #[inline(always)]
    fn thermal(&self, temperature: f64) -> f64 {
        self.law.softening(temperature)
    }

    #[inline(always)]
    fn flow_stress(&self, thermal: f64, state: &FlowState) -> FlowStress {
        let law = &self.law;
        let raised = 1.0 + state.strain_rate * law.per_rate;
        let factor = power_here(raised, law.c);
        let rate = [factor, law.c * law.per_rate * factor / raised];
        law.at(state.plastic_strain, thermal, rate)
    }

    #[inline(always)]
    fn depends_on_strain_only(&self) -> bool {
        false
    }
}

#[derive(Debug)]
struct Prepared(LaneLaw);

impl PreparedStrength for Prepared {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        self.0.flow_stress(state)
    }

    fn in_lanes(&self) -> Option<LaneLaw> {
        Some(self.0)
    }
}

impl StrengthLaw for JohnsonCook {
    fn prepare(&self, material: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        let room = material.room_temperature.si();
        let law = JohnsonCookLaw {
            a: factor * self.a.si(),
            b: factor * self.b.si(),
            n: self.n,
            c: self.c,
            m: self.m,
            per_rate: 1.0 / self.reference_rate.si(),
            room_temperature: room,
            melting_range: material
                .melting_temperature
                .map_or(f64::INFINITY, |melting| melting.si() - room),
        };
        Box::new(Prepared(match self.rate_form {
            RateForm::Logarithmic => LaneLaw::JohnsonCook(law),
            RateForm::Power => LaneLaw::ModifiedJohnsonCook(ModifiedJohnsonCookLaw { law }),
        }))
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
