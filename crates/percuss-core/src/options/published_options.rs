//! Options of the published scheme: readings of the seed paper.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::Mass;

/// Readings of the paper where its text leaves a choice.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct PublishedOptions {
    /// How rod and target are joined.
    pub interface: Interface,
    /// Whether the factor 2 of equation (21) is in the time step.
    pub time_step: PublishedTimeStep,
    /// Which masses feel the border shear, and in which direction.
    pub border_shear: PublishedBorderShear,
    /// Stiffness of a spring below the strain at which the elastic line meets the power law.
    pub small_strain: SmallStrainStiffness,
    /// Lengths of rod and target that deform in the contact spring of the `chain` interface.
    pub contact_spring: ContactSpring,
    /// Mass of the target column [kg]; density times volume when not given.
    ///
    /// Table 1 prints 1.22 g, where its own density and size give 1.26 g.
    pub target_mass: Option<Mass>,
}

/// How rod and target are joined in the published scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Interface {
    /// Every mass has its own equation; a contact spring with both stiffnesses in series joins rod and target (eq. 22).
    #[default]
    Chain,
    /// The first masses of rod and target move as one from the impact velocity on (eq. 15 taken literally) and are stopped
    /// by the target's springs alone.
    Joined,
    /// As `joined`, and the rod's next spring pushes the joined mass from behind.
    JoinedPushed,
}

/// Contact spring of the `chain` interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContactSpring {
    /// Half an element of each: the masses stand in the middle of their elements.
    #[default]
    HalfElements,
    /// A whole element of each.
    WholeElements,
}

/// Time step of the published scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PublishedTimeStep {
    /// `Δt = 0.1 sqrt(m/K)`: what the numbers of Table 1 follow.
    #[default]
    #[serde(rename = "table-1")]
    Table1,
    /// `Δt = 0.1 · 2 sqrt(m/K)`: equation (21) as printed.
    #[serde(rename = "equation-21")]
    Equation21,
}

/// Border shear of the published scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PublishedBorderShear {
    /// Dry friction on every target mass: it opposes motion and can hold a mass still.
    #[default]
    Friction,
    /// Friction on the target masses, and on the penetrator masses that have passed the target's original face.
    FrictionAndPenetrator,
    /// A constant force against the direction of impact on every target mass that has started to move (eq. 23 as printed).
    Constant,
    /// None.
    None,
}

/// Stiffness of a spring of the published scheme at small strain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SmallStrainStiffness {
    /// The power law down to zero strain, where it is infinitely stiff (eqs 13 and 14 as printed).
    #[default]
    PowerLaw,
    /// The elastic stiffness `E A/l` is the largest.
    Elastic,
}
