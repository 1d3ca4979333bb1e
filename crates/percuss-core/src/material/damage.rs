//! Damage: how plastic strain uses a material up until it fails.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Material, RateForm};
use crate::{
    check::{Check, limits},
    units::StrainRate,
};

/// Johnson–Cook damage \[johnson1985a\].
///
/// `D = Σ Δε_p / ε_f`, failed at 1, with `ε_f = (D₁ + D₂ exp(D₃ σ*))(1 + D₄ ln ε̇*)(1 + D₅ T*)`: σ* is the mean stress over the
/// equivalent stress, positive in tension; ε̇* and T* are those of the strength law of the same name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Damage {
    /// Failure strain D₁ that no tension takes away.
    pub d1: f64,
    /// Failure strain D₂ that shrinks with tension.
    pub d2: f64,
    /// Exponent D₃ of the stress triaxiality, negative: tension is positive.
    pub d3: f64,
    /// Rate coefficient D₄.
    #[serde(default)]
    pub d4: f64,
    /// Thermal coefficient D₅.
    #[serde(default)]
    pub d5: f64,
    /// Reference strain rate ε̇₀ [1/s].
    #[serde(default = "reference_rate")]
    pub reference_rate: StrainRate,
    /// Form of the rate factor.
    #[serde(default)]
    pub rate_form: RateForm,
    /// Bibliography keys.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<String>,
    /// Limitations.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

/// Beyond it, an exponential is no number any more.
const LARGEST_EXPONENT: f64 = 700.0;

fn reference_rate() -> StrainRate {
    StrainRate::new(1.0)
}

/// What a failure strain depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamageState {
    /// Mean stress over equivalent stress, positive in tension.
    pub triaxiality: f64,
    /// Plastic strain rate [1/s].
    pub strain_rate: f64,
    /// Temperature [K].
    pub temperature: f64,
}

impl DamageState {
    /// Rate of a plastic strain over a time step [s], as laws see it [1/s]: 0 where rates have no effect.
    pub fn rate(increment: f64, time_step: f64, rate_effects: bool) -> f64 {
        if rate_effects {
            increment / time_step
        } else {
            0.0
        }
    }
}

/// Damage made ready for one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PreparedDamage {
    d: [f64; 5],
    reference_rate: f64,
    rate_form: RateForm,
    room_temperature: f64,
    melting_range: f64,
}

impl Damage {
    /// Makes the law ready for the material that it belongs to.
    pub fn prepare(&self, material: &Material) -> PreparedDamage {
        let room = material.room_temperature.si();
        PreparedDamage {
            d: [self.d1, self.d2, self.d3, self.d4, self.d5],
            reference_rate: self.reference_rate.si(),
            rate_form: self.rate_form,
            room_temperature: room,
            melting_range: material
                .melting_temperature
                .map_or(f64::INFINITY, |melting| melting.si() - room),
        }
    }

    /// Constitutive equation as text.
    pub fn equation(&self) -> &'static str {
        match self.rate_form {
            RateForm::Logarithmic => "ε_f = (D₁ + D₂ exp(D₃ σ*))(1 + D₄ ln ε̇*)(1 + D₅ T*)",
            RateForm::Power => "ε_f = (D₁ + D₂ exp(D₃ σ*))(1 + ε̇*)^D₄ (1 + D₅ T*)",
        }
    }

    pub(super) fn check(&self, check: &mut Check<'_>, melts: bool) {
        check.number("d1", self.d1, limits::DAMAGE_STRAIN);
        check.number("d2", self.d2, limits::DAMAGE_STRAIN);
        if self.d3 > 0.0 {
            check.fail(
                "d3",
                format!(
                    "d3 = {} makes the material more ductile in tension",
                    self.d3
                ),
                format!("tension is positive here: is it {}?", -self.d3),
            );
        } else {
            check.number("d3", self.d3, limits::TRIAXIALITY_EXPONENT);
        }
        check.number("d4", self.d4, limits::DAMAGE_RATE_COEFFICIENT);
        check.number("d5", self.d5, limits::DAMAGE_THERMAL_COEFFICIENT);
        check.quantity("reference_rate", self.reference_rate, limits::STRAIN_RATE);
        let in_shear = self.d1 + self.d2;
        let allowed = limits::FAILURE_STRAIN;
        if !(allowed.min..=allowed.max).contains(&in_shear) {
            check.fail(
                "d1",
                format!("d1 + d2 = {in_shear} is the strain at which the material fails in shear"),
                format!(
                    "solids lie between {} and {}: is a sign wrong?",
                    allowed.min, allowed.max
                ),
            );
        }
        if self.d5 != 0.0 && !melts {
            check.fail(
                "d5",
                "`d5` needs the temperature at which the material melts",
                "give `melting_temperature`, or leave `d5` out",
            );
        }
    }
}

impl PreparedDamage {
    /// Plastic strain at which the material fails in a state that does not change; 0 where it bears none.
    pub fn failure_strain(&self, state: &DamageState) -> f64 {
        let [d1, d2, d3, d4, d5] = self.d;
        let ratio = state.strain_rate / self.reference_rate;
        let rate_factor = match self.rate_form {
            RateForm::Logarithmic => 1.0 + d4 * ratio.max(1.0).ln(),
            RateForm::Power => (1.0 + ratio).powf(d4),
        };
        let homologous =
            ((state.temperature - self.room_temperature) / self.melting_range).clamp(0.0, 1.0);
        // Without an equivalent stress the triaxiality has no bounds, or is no number: then nothing is used up.
        let strain = d1 + d2 * (d3 * state.triaxiality).min(LARGEST_EXPONENT).exp();
        strain.max(0.0) * rate_factor.max(0.0) * (1.0 + d5 * homologous).max(0.0)
    }

    /// Damage after a further plastic strain in a state: 0 sound, 1 failed.
    pub fn grow(&self, damage: f64, state: &DamageState, plastic_increment: f64) -> f64 {
        if plastic_increment <= 0.0 {
            return damage;
        }
        // A failure strain of 0 gives an infinite part: failed at once.
        (damage + plastic_increment / self.failure_strain(state)).min(1.0)
    }
}

#[cfg(test)]
#[path = "damage_tests.rs"]
mod tests;
