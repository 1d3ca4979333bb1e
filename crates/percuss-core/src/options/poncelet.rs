//! Options of the model `poncelet`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `poncelet`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct PonceletOptions {
    /// Resistance R of the target [Pa]; its quasi-static cavity-expansion pressure when not given.
    pub resistance: Option<Pressure>,
    /// Coefficient C of the drag `C ρ V²`, half the usual drag coefficient; the nose factor N when not given.
    pub drag: Option<f64>,
}

impl PonceletOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.quantity("resistance", self.resistance, limits::CONTACT_PRESSURE);
        check.number("drag", self.drag, limits::DRAG);
    }
}
