//! Fracture of brittle solids: what opens a crack.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    units::{EnergyPerArea, Pressure},
};

/// Fracture energy and tensile strength of a brittle solid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Brittle {
    /// Energy that opens a crack, per area of the crack [J/m2].
    pub energy: EnergyPerArea,
    /// Tensile stress at which the solid fails [Pa].
    pub tensile_strength: Pressure,
    /// Bibliography keys.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<String>,
    /// Limitations.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

impl Brittle {
    /// Length `E G_f/f_t²` of the zone in which a crack fails [m], of a solid of Young's modulus [Pa].
    pub fn characteristic_length(&self, youngs_modulus: f64) -> f64 {
        let strength = self.tensile_strength.si();
        youngs_modulus * self.energy.si() / (strength * strength)
    }

    pub(super) fn check(&self, check: &mut Check<'_>, youngs_modulus: Pressure) {
        check.quantity("energy", self.energy, limits::BRITTLE_ENERGY);
        check.quantity(
            "tensile_strength",
            self.tensile_strength,
            limits::TENSILE_STRENGTH,
        );
        // Even bonds between atoms break at about a tenth of the modulus.
        let (strength, most) = (
            self.tensile_strength,
            limits::STRENGTH_OVER_MODULUS * youngs_modulus.si(),
        );
        if strength.si() > most {
            check.fail(
                "tensile_strength",
                format!("tensile_strength = {strength} is more than a tenth of youngs_modulus = {youngs_modulus}"),
                "no solid is as strong: is one of them in another unit?",
            );
        }
        let length = self.characteristic_length(youngs_modulus.si());
        let allowed = limits::CHARACTERISTIC_LENGTH;
        if !(allowed.min..=allowed.max).contains(&length) {
            check.fail(
                "energy",
                format!("energy and tensile_strength give a length E G/f² of {length:.1e} m"),
                format!(
                    "solids lie between {:e} and {:e} m: is one of them in another unit?",
                    allowed.min, allowed.max
                ),
            );
        }
    }
}
