//! Options of the model `forrestal`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::defaults::defaults;
use crate::{
    check::{Check, limits},
    problem::Target,
    units::Pressure,
};

/// Options of the model `forrestal`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = forrestal_in_schema)]
#[non_exhaustive]
pub struct ForrestalOptions {
    /// Cavity expansion that the resistance comes from.
    pub cavity: Option<Cavity>,
    /// Strength coefficient A of `σ_n = A Y + B ρ v_n²`, with `yield_stress` as Y; from the cavity expansion when not given.
    pub a: Option<f64>,
    /// Yield stress Y [Pa] that `a` multiplies; where the target's law starts to flow when not given.
    pub yield_stress: Option<Pressure>,
    /// Inertia coefficient B; from the cavity expansion when not given.
    pub b: Option<f64>,
    /// Coefficient of friction between nose and target.
    pub friction: Option<f64>,
    /// How the nose enters.
    pub entry: Option<Entry>,
}

/// Cavity expansion behind a resistance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Cavity {
    /// Quasi-static pressure of the target's strength law with its hardening, incompressible; B = 3/2.
    #[default]
    Incompressible,
    /// Similarity solution of a compressible, perfectly plastic body; B fitted over the speeds of the case.
    Compressible,
}

/// How a nose enters a target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Entry {
    /// The whole nose is loaded from first contact, as in the published closed forms.
    #[default]
    Embedded,
    /// That part of the nose is loaded which is below the original surface.
    Gradual,
}

defaults! { ForrestalOptions, forrestal_in_schema {
    /// Cavity expansion that the resistance comes from.
    cavity: Cavity = Cavity::Incompressible;
    /// Coefficient of friction between nose and target.
    friction: f64 = 0.0;
    /// How the nose enters.
    entry: Entry = Entry::Embedded;
} }

impl ForrestalOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        let numbers = [
            ("a", self.a, limits::CAVITY_STRENGTH),
            ("b", self.b, limits::CAVITY_INERTIA),
            ("friction", self.friction, limits::FRICTION),
        ];
        for (key, number, limits) in numbers {
            check.number(key, number, limits);
        }
        if let Some(stress) = self.yield_stress {
            check.quantity("yield_stress", stress, limits::FLOW_STRESS);
            if self.a.is_none() {
                check.fail(
                    "yield_stress",
                    "`yield_stress` has no effect without `a`",
                    "add `a`, or remove the key",
                );
            }
        }
        if self.cavity.is_some() && self.a.is_some() && self.b.is_some() {
            check.fail(
                "cavity",
                "`cavity` has no effect where both `a` and `b` are given",
                "remove one of the three keys",
            );
        }
    }
}
