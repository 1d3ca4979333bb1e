//! Checks that every material passes on load: wide enough for any real solid, narrow enough to detect a unit error of 1000.

use super::Material;
use crate::{
    check::{Check, limits},
    units::Pressure,
};

/// Plastic strain at which a hardened flow stress is checked: every impact reaches it, and fits hold there.
const HARDENED_STRAIN: f64 = 0.1;

impl Material {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>) {
        let check = &mut check.of_material();
        for alias in &self.aliases {
            let form = super::library::alias_form(alias);
            if *alias != form || form.is_empty() {
                check.fail(
                    "aliases",
                    format!("`{alias}` is not in the form of aliases"),
                    format!("lower case, with hyphens for blanks and `_`: `{form}`"),
                );
            }
        }
        check.quantity("density", self.density, limits::DENSITY);
        check.quantity(
            "youngs_modulus",
            self.youngs_modulus,
            limits::YOUNGS_MODULUS,
        );
        check.number(
            "poissons_ratio",
            self.poissons_ratio,
            limits::POISSONS_RATIO,
        );
        check.quantity("specific_heat", self.specific_heat, limits::SPECIFIC_HEAT);
        if let Some(eos) = &self.equation_of_state {
            eos.check(&mut check.within("equation_of_state"));
        }
        if let Some(damage) = &self.damage {
            damage.check(
                &mut check.within("damage"),
                self.melting_temperature.is_some(),
            );
        }
        if let Some(fracture) = &self.fracture {
            fracture.check(&mut check.within("fracture"), self.youngs_modulus);
        }
        check.number(
            "brinell_hardness",
            self.brinell_hardness,
            limits::BRINELL_HARDNESS,
        );
        check.quantity(
            "room_temperature",
            self.room_temperature,
            limits::TEMPERATURE,
        );
        if let Some(melting) = self.melting_temperature {
            check.quantity("melting_temperature", melting, limits::TEMPERATURE);
            if melting.si() <= self.room_temperature.si() {
                check.fail(
                    "melting_temperature",
                    format!(
                        "it melts at {melting}, not above room_temperature = {}",
                        self.room_temperature
                    ),
                    "is one of them in another unit?",
                );
            }
        }
        let wave_speed = self.bar_wave_speed();
        if !(limits::BAR_WAVE_SPEED.min..=limits::BAR_WAVE_SPEED.max).contains(&wave_speed) {
            check.fail(
                "youngs_modulus",
                format!("density and modulus give a wave speed of {wave_speed:.0} m/s"),
                format!(
                    "solids lie between {:.0} and {:.0} m/s: is `density` or `youngs_modulus` off by a factor of 1000?",
                    limits::BAR_WAVE_SPEED.min,
                    limits::BAR_WAVE_SPEED.max
                ),
            );
        }
        let key = format!("strength.{}", self.strength.key());
        self.strength.law().check(&mut check.within(&key));
        let law = self.strength.law();
        let yields = self.check_ratio(
            check,
            &key,
            "initial yield stress",
            law.initial_yield_stress(self),
        );
        // One error, one diagnostic: a wrong yield stress is also in the hardened stress.
        if yields {
            self.check_ratio(
                check,
                &key,
                "flow stress at a plastic strain of 0.1",
                self.flow_stress(HARDENED_STRAIN),
            );
        }
        for (key, what, stress) in [
            ("yield_stress", "yield stress", self.yield_stress),
            (
                "ultimate_strength",
                "ultimate strength",
                self.ultimate_strength,
            ),
            ("spall_strength", "spall strength", self.spall_strength),
        ] {
            self.check_ratio(check, key, what, stress.map(Pressure::si));
        }
        if let Some(law) = &self.tuler_butcher {
            law.check_numbers(&mut check.within("tuler_butcher"));
        }
    }

    /// Whether the stress is a fraction of Young's modulus that a solid can have.
    fn check_ratio(
        &self,
        check: &mut Check<'_>,
        key: &str,
        what: &str,
        stress: Option<f64>,
    ) -> bool {
        let Some(stress) = stress else { return true };
        let ratio = stress / self.youngs_modulus.si();
        let possible =
            (limits::YIELD_TO_MODULUS.min..=limits::YIELD_TO_MODULUS.max).contains(&ratio);
        if !possible {
            check.fail(
                key,
                format!(
                    "{what} is {}, {ratio:.2e} of youngs_modulus = {}",
                    Pressure::new(stress),
                    self.youngs_modulus
                ),
                format!(
                    "solids lie between {:e} and {:e}: is a stress off by a factor of 1000?",
                    limits::YIELD_TO_MODULUS.min,
                    limits::YIELD_TO_MODULUS.max
                ),
            );
        }
        possible
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Diagnostic;

    fn diagnostics(text: &str) -> Vec<Diagnostic> {
        let material: Material = toml::from_str(text).unwrap();
        let mut diagnostics = Vec::new();
        material.check(&mut Check::new(&mut diagnostics));
        diagnostics
    }

    /// A solid like a stiff polymer: far from the metals of the library.
    fn polymer(hardening: &str) -> String {
        format!(
            "name = 'polymer'\ndensity = '1100 kg/m3'\nyoungs_modulus = '3 GPa'\npoissons_ratio = 0.4\n\
             strength.johnson_cook = {{ a = '50 MPa', b = '{hardening}', n = 0.3, c = 0.03, m = 1.0 }}"
        )
    }

    #[test]
    fn solids_that_are_no_metals_pass() {
        assert_eq!(diagnostics(&polymer("5 MPa")), []);
        assert_eq!(diagnostics(&polymer("0 MPa")), []);
        let foam = "name = 'foam'\ndensity = '30 kg/m3'\nyoungs_modulus = '20 MPa'\npoissons_ratio = 0.1\n\
                    strength.perfectly_plastic = { flow_stress = '400 kPa' }";
        assert_eq!(diagnostics(foam), []);
    }

    #[test]
    fn an_alias_that_no_lookup_could_find_is_a_finding() {
        let text = polymer("5 MPa").replacen("density", "aliases = ['my_PC', 'pc-2']\ndensity", 1);
        let found = diagnostics(&text);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].key, "aliases");
        assert!(found[0].help.contains("`my-pc`"), "{found:?}");
    }

    #[test]
    fn hardening_beyond_the_modulus_is_one_finding() {
        let found = diagnostics(&polymer("5 GPa"));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].key, "strength.johnson_cook");
        assert!(found[0].message.contains("plastic strain of 0.1"));
    }

    #[test]
    fn hardening_too_small_for_its_yield_stress_is_a_finding() {
        let found = diagnostics(&polymer("5 kPa"));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].key, "strength.johnson_cook.b");
    }
}
