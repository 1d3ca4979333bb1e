//! Options of the model `wilkins_guinan`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::defaults::defaults;
use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `wilkins_guinan`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = wilkins_in_schema)]
#[non_exhaustive]
pub struct WilkinsGuinanOptions {
    /// Dynamic yield stress Y [Pa]; mean flow stress of the strength law over the strain and at the rate reached when not given.
    pub dynamic_yield_stress: Option<Pressure>,
    /// Distance of the plastic front from the wall over the initial length \[wilkins1973\].
    pub front_to_length: Option<f64>,
}

defaults! { WilkinsGuinanOptions, wilkins_in_schema {
    /// Distance of the plastic front from the wall over the initial length.
    front_to_length: f64 = 0.12;
} }

impl WilkinsGuinanOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.quantity(
            "dynamic_yield_stress",
            self.dynamic_yield_stress,
            limits::FLOW_STRESS,
        );
        check.number("front_to_length", self.front_to_length, limits::FRONT);
    }
}
