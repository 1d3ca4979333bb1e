//! Words that options of the 1-D discrete element model take.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Scheme of the 1-D discrete element model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// Large strain, plastic unloading, balanced energy; converges.
    #[default]
    Conservative,
    /// The equations of the paper as printed, with every ambiguous reading selectable.
    Published,
}

impl Scheme {
    /// Name as the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Conservative => "conservative",
            Self::Published => "published",
        }
    }
}

/// Strain measure of the conservative scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Kinematics {
    /// `ε = ln(l₀/l)` and an area that grows as the element shortens: `A = A₀ l₀/l`.
    #[default]
    Logarithmic,
    /// `ε = (l₀ − l)/l₀` and a constant area: for comparison with small-strain theory.
    SmallStrain,
}

/// What stands for the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TargetResistanceModel {
    /// The column in line with the projectile, with a constraint factor and border shear.
    #[default]
    Column,
    /// A truncated cone that is as stiff as a half-space under the projectile, with neither.
    Diverging,
    /// The same cone, into which the tip penetrates where the load would exceed the resistance to steady penetration.
    DivergingPenetrable,
    /// A crater floor that advances against the pressure of an expanding cavity, carried by an elastic cone, under a projectile that
    /// takes time to widen.
    ExpandingCavity,
}

impl TargetResistanceModel {
    /// Name as the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Column => "column",
            Self::Diverging => "diverging",
            Self::DivergingPenetrable => "diverging-penetrable",
            Self::ExpandingCavity => "expanding-cavity",
        }
    }
}

/// How what erodes leaves the tip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ErosionCriterion {
    /// Elements mushroom and leave at `erosion_strain`.
    #[default]
    Strain,
    /// Elements keep their area until their length is used up, a mass of target moves with the tip, and the target ahead of it is
    /// held: the steady flow is that of Alekseevskii and Tate.
    Tate,
}

/// Artificial viscosity `q = ρ l |ε̇| (c_l c + c_q l |ε̇|)` in compression.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ArtificialViscosity {
    /// Linear coefficient c_l.
    pub linear: f64,
    /// Quadratic coefficient c_q.
    pub quadratic: f64,
}

impl ArtificialViscosity {
    /// Whether there is none.
    #[inline]
    pub fn is_none(self) -> bool {
        self.linear == 0.0 && self.quadratic == 0.0
    }
}
