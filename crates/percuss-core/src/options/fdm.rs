//! Options of the finite-difference model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    ArtificialViscosity, ChainOptions, ConstraintFactor,
    common::{check_end, check_viscosity, refuse_without_target},
    defaults::{MAX_STEPS, defaults},
    number_or_name::NumberOrName,
};
use crate::{
    check::{
        Check,
        limits::{self, MAX_ELEMENTS},
    },
    problem::Target,
    units::{Pressure, Time},
};

/// Options of the model `fdm`. In geometry `rod` the keys of mesh, target resistance and end have the values of `[chain]` when not given.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = fdm_in_schema)]
#[non_exhaustive]
pub struct FdmOptions {
    /// Geometry of the impact.
    pub geometry: Geometry,
    /// Cells along the projectile.
    pub projectile_elements: Option<u32>,
    /// Cells through the target, shared among its layers by thickness.
    pub target_elements: Option<u32>,
    /// Factor on the target's flow stress for the lateral constraint; geometry `rod` only.
    pub constraint_factor: Option<ConstraintFactor>,
    /// Border-shear coefficient C in `Fy = C π d h σ_f`; geometry `rod` only.
    pub border_shear: Option<f64>,
    /// Courant number on the current smallest transit time. At the default a run in geometry `rod` is repeated with half of it,
    /// down to 0.04375, until its energy balance closes, and warns; geometry `planar` conserves energy to rounding at any.
    pub courant: Option<f64>,
    /// Artificial viscosity in compression.
    pub artificial_viscosity: Option<ArtificialViscosity>,
    /// Tensile stress at which material spalls, instead of that of the materials' records; geometry `planar` only [Pa].
    pub spall_strength: Option<Pressure>,
    /// Time at which a run is ended [s]; when not given, that of `[chain]` in a rod, and three passages of a wave through
    /// both bodies in a planar impact.
    pub end_time: Option<Time>,
    /// Time steps after which a run is ended.
    pub max_steps: Option<u64>,
    /// Whether a run is ended when the projectile's momentum is used up, as soon as the depth of penetration is known; geometry `rod` only.
    pub end_at_rest: Option<bool>,
}

/// Options of the model `fdm` in geometry `rod`, as they hold.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RodOptions {
    /// Cells along the projectile.
    pub projectile_elements: u32,
    /// Cells through the target.
    pub target_elements: u32,
    /// Factor on the target's flow stress for the lateral constraint.
    pub constraint_factor: ConstraintFactor,
    /// Border-shear coefficient C.
    pub border_shear: f64,
    /// Courant number.
    pub courant: f64,
    /// Artificial viscosity in compression.
    pub artificial_viscosity: ArtificialViscosity,
    /// Time at which a run is ended [s]; `None` for that of the impact.
    pub end_time: Option<Time>,
    /// Time steps after which a run is ended.
    pub max_steps: u64,
    /// Whether a run is ended when the depth of penetration is known.
    pub end_at_rest: bool,
}

/// Geometry of the finite-difference model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Geometry {
    /// Uniaxial stress: a rod and the column of target in line with it, with a cross-section that changes.
    #[default]
    Rod,
    /// Uniaxial strain: a flyer plate, as thick as the projectile is long, strikes the layers of the target.
    Planar,
}

impl Geometry {
    /// Name as the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rod => "rod",
            Self::Planar => "planar",
        }
    }
}

/// A default that differs between the geometries.
fn by_geometry(planar: &str) -> String {
    format!("that of `[chain]` in geometry `rod`, {planar} in geometry `planar`")
}

fn planar_viscosity() -> String {
    let ArtificialViscosity { linear, quadratic } = FdmOptions::PLANAR_VISCOSITY;
    by_geometry(&format!("linear {linear} and quadratic {quadratic}"))
}

defaults! { FdmOptions, fdm_in_schema {
    /// Courant number.
    courant: f64 = 0.7;
    depending projectile_elements: by_geometry(&FdmOptions::PLANAR_ELEMENTS.to_string());
    depending target_elements: by_geometry("cells as long as the projectile's");
    depending constraint_factor: "that of `[chain]`";
    depending border_shear: "that of `[chain]`";
    depending artificial_viscosity: planar_viscosity();
    depending max_steps: by_geometry(&MAX_STEPS.to_string());
    depending end_at_rest: "that of `[chain]`";
} }

impl FdmOptions {
    /// Cells along the projectile in geometry `planar`.
    pub const PLANAR_ELEMENTS: u32 = 200;
    /// Artificial viscosity in geometry `planar`.
    pub const PLANAR_VISCOSITY: ArtificialViscosity = ArtificialViscosity {
        linear: 0.1,
        quadratic: 2.0,
    };
}

impl FdmOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, target: &Target) {
        let target_is_solid = target.is_solid();
        for (key, elements) in [
            ("projectile_elements", self.projectile_elements),
            ("target_elements", self.target_elements),
        ] {
            if let Some(elements) = elements.filter(|n| !(1..=MAX_ELEMENTS).contains(n)) {
                check.out_of_range(
                    key,
                    format!("{elements} cells"),
                    format!("allowed: 1 to {MAX_ELEMENTS}"),
                );
            }
        }
        let factor = self.constraint_factor.and_then(|factor| factor.number());
        for (key, number, limits) in [
            ("constraint_factor", factor, limits::CONSTRAINT_FACTOR),
            ("border_shear", self.border_shear, limits::BORDER_SHEAR),
            ("courant", self.courant, limits::COURANT),
        ] {
            check.number(key, number, limits);
        }
        check_viscosity(check, self.artificial_viscosity);
        check.quantity("spall_strength", self.spall_strength, limits::FLOW_STRESS);
        check_end(check, self.end_time, self.max_steps);
        self.check_effect(check, target_is_solid);
    }

    /// Reports keys that would have no effect.
    fn check_effect(&self, check: &mut Check<'_>, target_is_solid: bool) {
        let column = [
            ("constraint_factor", self.constraint_factor.is_some()),
            ("border_shear", self.border_shear.is_some()),
            ("end_at_rest", self.end_at_rest.is_some()),
        ];
        let spall = [("spall_strength", self.spall_strength.is_some())];
        let (ignored, geometry) = match self.geometry {
            Geometry::Rod => (&spall[..], Geometry::Rod),
            Geometry::Planar => (&column[..], Geometry::Planar),
        };
        let message = |key: &str| format!("geometry `{}` has no `{key}`", geometry.name());
        check.refuse(ignored, message, "remove the key, or change `geometry`");
        if !target_is_solid {
            let of_target = [("target_elements", self.target_elements.is_some())];
            refuse_without_target(check, &of_target);
            refuse_without_target(check, &column);
        }
    }

    /// Options of geometry `rod`: what is not given has the value of `[chain]`.
    pub fn of_rod(&self, chain: &ChainOptions) -> RodOptions {
        let elements = |own: Option<u32>, of_chain: usize| own.unwrap_or(of_chain as u32);
        let viscosity = self.artificial_viscosity;
        RodOptions {
            projectile_elements: elements(self.projectile_elements, chain.projectile_elements()),
            target_elements: elements(self.target_elements, chain.target_elements()),
            constraint_factor: (self.constraint_factor)
                .unwrap_or_else(|| chain.constraint_factor()),
            border_shear: self.border_shear.unwrap_or_else(|| chain.border_shear()),
            courant: self.courant(),
            artificial_viscosity: viscosity.unwrap_or_else(|| chain.artificial_viscosity()),
            end_time: self.end_time.or(chain.end_time),
            max_steps: self.max_steps.unwrap_or_else(|| chain.max_steps()),
            end_at_rest: self.end_at_rest.unwrap_or_else(|| chain.end_at_rest()),
        }
    }
}
