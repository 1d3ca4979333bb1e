//! Checks that every material passes on load: wide enough for any real solid, narrow enough to catch a slip of 1000.

use super::Material;
use crate::{
    check::{Check, limits},
    units::Pressure,
};

impl Material {
    pub(crate) fn check(&self, check: &mut Check<'_>) {
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
        if let Some(heat) = self.specific_heat {
            check.quantity("specific_heat", heat, limits::SPECIFIC_HEAT);
        }
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
        self.check_ratio(
            check,
            &key,
            "initial yield stress",
            self.strength.law().initial_yield_stress(self),
        );
        self.check_ratio(
            check,
            "yield_stress",
            "yield stress",
            self.yield_stress.map(Pressure::si),
        );
    }

    fn check_ratio(&self, check: &mut Check<'_>, key: &str, what: &str, stress: Option<f64>) {
        let Some(stress) = stress else { return };
        let ratio = stress / self.youngs_modulus.si();
        if !(limits::YIELD_TO_MODULUS.min..=limits::YIELD_TO_MODULUS.max).contains(&ratio) {
            check.fail(
                key,
                format!(
                    "{what} {} is {ratio:.2e} of youngs_modulus = {}",
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
    }
}
