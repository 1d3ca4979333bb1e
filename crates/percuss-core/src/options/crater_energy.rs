//! Options of the model `crater_energy`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `crater_energy`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct CraterEnergyOptions {
    /// Energy that a volume of crater costs [J/m3 = Pa]; the target's quasi-static cavity-expansion pressure when not given.
    pub resistance: Option<Pressure>,
    /// Diameter of the crater in projectile diameters; 1 for a rigid projectile, computed otherwise, when not given.
    pub crater_to_projectile_diameter: Option<f64>,
}

impl CraterEnergyOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.quantity("resistance", self.resistance, limits::CONTACT_PRESSURE);
        check.number(
            "crater_to_projectile_diameter",
            self.crater_to_projectile_diameter,
            limits::CRATER_DIAMETER,
        );
    }
}
