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
    /// Rate coefficient D₄; 0 when not given.
    #[serde(default)]
    pub d4: f64,
    /// Thermal coefficient D₅; 0 when not given.
    #[serde(default)]
    pub d5: f64,
    /// Reference strain rate ε̇₀ [1/s]; 1 when not given.
    #[serde(default = "reference_rate")]
    pub reference_rate: StrainRate,
    /// Form of the rate factor.
    #[serde(default)]
    pub rate_form: RateForm,
    /// Bibliography keys.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<String>,
    /// What a user should know before relying on it.
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
mod tests {
    use super::*;
    use crate::{check::Finding, material::Library};

    fn metal(damage: &str) -> Material {
        toml::from_str(&format!(
            "name = 'a'\ndensity = '7830 kg/m3'\nyoungs_modulus = '208 GPa'\npoissons_ratio = 0.3\n\
             melting_temperature = '1793 K'\nroom_temperature = '298 K'\n\
             strength.perfectly_plastic = {{ flow_stress = '800 MPa' }}\ndamage = {{ {damage} }}"
        ))
        .unwrap()
    }

    fn prepared(damage: &str) -> PreparedDamage {
        let metal = metal(damage);
        metal.damage.as_ref().unwrap().prepare(&metal)
    }

    fn slow(triaxiality: f64) -> DamageState {
        DamageState {
            triaxiality,
            strain_rate: 0.0,
            temperature: 298.0,
        }
    }

    fn assert_close(found: f64, expected: f64) {
        assert!(
            (found / expected - 1.0).abs() < 1e-12,
            "{found} instead of {expected}"
        );
    }

    #[test]
    fn the_failure_strain_is_that_of_the_formula() {
        let law = prepared("d1 = 0.05, d2 = 3.44, d3 = -2.12, d4 = 0.002, d5 = 0.61");
        // In shear, in tension of a bar, and in compression of one: σ* = 0, 1/3, −1/3.
        assert_close(law.failure_strain(&slow(0.0)), 3.49);
        let third = 1.0 / 3.0;
        assert_close(
            law.failure_strain(&slow(third)),
            0.05 + 3.44 * (-2.12_f64 / 3.0).exp(),
        );
        assert_close(
            law.failure_strain(&slow(-third)),
            0.05 + 3.44 * (2.12_f64 / 3.0).exp(),
        );
        // Fast and half way from room temperature to melting.
        let fast = DamageState {
            triaxiality: third,
            strain_rate: 1e4,
            temperature: 0.5 * (298.0 + 1793.0),
        };
        assert_close(
            law.failure_strain(&fast),
            (0.05 + 3.44 * (-2.12_f64 / 3.0).exp()) * (1.0 + 0.002 * 1e4_f64.ln()) * 1.305,
        );
        // Below the reference rate and below room temperature nothing changes; beyond melting nothing more does.
        let (cold, molten, beyond) = (200.0, 1793.0, 3000.0);
        let at = |temperature| {
            law.failure_strain(&DamageState {
                temperature,
                strain_rate: 0.5,
                ..slow(0.0)
            })
        };
        assert_close(at(cold), 3.49);
        assert_close(at(molten), 3.49 * 1.61);
        assert_close(at(beyond), at(molten));
    }

    #[test]
    fn the_rate_factor_can_be_a_power() {
        let law = prepared(
            "d1 = 0.0705, d2 = 1.732, d3 = -0.54, d4 = -0.015, reference_rate = '5e-4 1/s', rate_form = 'power'",
        );
        let state = DamageState {
            strain_rate: 1e4,
            ..slow(0.0)
        };
        assert_close(
            law.failure_strain(&state),
            1.8025 * (1.0 + 2e7_f64).powf(-0.015),
        );
    }

    #[test]
    fn damage_in_one_state_is_the_part_of_the_failure_strain_and_parts_add_up() {
        let law = prepared("d1 = 0.54, d2 = 4.89, d3 = -3.03");
        let (shear, tension) = (slow(0.0), slow(1.0));
        let mut damage = 0.0;
        for _ in 0..100 {
            damage = law.grow(damage, &shear, 0.01 * 0.25 * 5.43);
        }
        assert!((damage - 0.25).abs() < 1e-12);
        // The rest in another state: 3/4 of that failure strain leaves it just whole, a little more fails it.
        let rest = 0.75 * (0.54 + 4.89 * (-3.03_f64).exp());
        assert!(law.grow(damage, &tension, 0.999 * rest) < 1.0);
        assert_eq!(law.grow(damage, &tension, 1.001 * rest), 1.0);
        assert_eq!(law.grow(damage, &tension, 0.0), damage);
    }

    #[test]
    fn where_the_formula_leaves_no_strain_the_first_flow_fails() {
        let law = prepared("d1 = -0.77, d2 = 1.45, d3 = -0.47, d5 = 1.6");
        let triaxial = slow(1.4);
        assert_eq!(law.failure_strain(&triaxial), 0.0);
        assert_eq!(law.grow(0.0, &triaxial, 1e-12), 1.0);
        assert_eq!(law.grow(0.2, &triaxial, 0.0), 0.2);
        // Compression without end takes no part of it.
        assert_eq!(law.grow(0.2, &slow(-1e9), 0.1), 0.2);
        assert_eq!(law.grow(0.2, &slow(f64::NEG_INFINITY), 0.1), 0.2);
        assert_eq!(law.grow(0.2, &slow(f64::NAN), 0.1), 0.2);
        let constant = prepared("d1 = 0.3, d2 = 0.0, d3 = -1.0");
        assert_eq!(constant.failure_strain(&slow(f64::NEG_INFINITY)), 0.3);
    }

    fn keys(material: &Material) -> Vec<String> {
        let mut findings: Vec<Finding> = Vec::new();
        material.check(&mut Check::new(&mut findings));
        findings.into_iter().map(|finding| finding.key).collect()
    }

    #[test]
    fn wrong_signs_and_what_cannot_be_evaluated_are_findings() {
        let good = "d1 = 0.05, d2 = 3.44, d3 = -2.12";
        assert_eq!(keys(&metal(good)), [""; 0]);
        let of = |damage: &str| keys(&metal(damage));
        assert_eq!(of("d1 = 0.05, d2 = 3.44, d3 = 2.12"), ["damage.d3"]);
        assert_eq!(of("d1 = -0.5, d2 = 0.3, d3 = -1.0"), ["damage.d1"]);
        assert_eq!(of(&format!("{good}, d4 = 2.0")), ["damage.d4"]);
        assert_eq!(of(&format!("{good}, d5 = nan")), ["damage.d5"]);
        let mut unmelting = metal(&format!("{good}, d5 = 0.6"));
        unmelting.melting_temperature = None;
        assert_eq!(keys(&unmelting), ["damage.d5"]);
    }

    #[test]
    fn shipped_constants_are_sourced_and_fail_in_tension_before_they_fail_in_shear() {
        let mut count = 0;
        for entry in Library::built_in().iter() {
            let Some(damage) = &entry.material.damage else {
                continue;
            };
            count += 1;
            assert!(
                !damage.sources.is_empty() && !damage.note.is_empty(),
                "{}",
                entry.id
            );
            for source in &damage.sources {
                assert!(crate::material::references().contains_key(source));
            }
            let law = damage.prepare(&entry.material);
            let room = entry.material.room_temperature.si();
            let at = |triaxiality| {
                law.failure_strain(&DamageState {
                    temperature: room,
                    ..slow(triaxiality)
                })
            };
            assert!(
                at(1.0 / 3.0) < at(0.0) && at(0.0) < at(-1.0 / 3.0),
                "{}",
                entry.id
            );
            assert!((0.1..10.0).contains(&at(1.0 / 3.0)), "{}", entry.id);
        }
        assert_eq!(count, 6);
    }
}
