//! Options of the model `plate_cavity`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::defaults::defaults;
use crate::{
    check::{Check, limits},
    problem::Target,
};

/// Options of the model `plate_cavity`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = plate_in_schema)]
#[non_exhaustive]
pub struct PlateCavityOptions {
    /// Cavity whose quasi-static pressure resists.
    pub cavity: CavityShape,
    /// Coefficient B of the inertial pressure `B ρ (V sin θ)²` on the nose; 0 leaves inertia out.
    pub inertia: Option<f64>,
}

/// Cavity whose quasi-static pressure resists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CavityShape {
    /// A long cylinder in plane strain: a hole through a plate.
    #[default]
    Cylinder,
    /// A sphere: a tip deep inside.
    Sphere,
}

defaults! { PlateCavityOptions, plate_in_schema {
    /// Coefficient of the inertial pressure.
    inertia: f64 = PlateCavityOptions::INERTIA;
} }

impl PlateCavityOptions {
    /// Inertial coefficient of a spherical cavity that grows at constant speed in an incompressible body: exact.
    pub const INERTIA: f64 = 1.5;

    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, _: &Target) {
        check.number("inertia", self.inertia, limits::INERTIA_COEFFICIENT);
    }
}
