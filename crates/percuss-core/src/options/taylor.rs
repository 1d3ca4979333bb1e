//! Options of the model `taylor`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `taylor`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct TaylorOptions {
    /// Dynamic yield stress Y [Pa]; mean flow stress of the strength law over the strain and at the rate reached when not given.
    pub dynamic_yield_stress: Option<Pressure>,
}

impl TaylorOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.quantity(
            "dynamic_yield_stress",
            self.dynamic_yield_stress,
            limits::FLOW_STRESS,
        );
    }
}
