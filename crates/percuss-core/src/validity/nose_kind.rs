//! Shapes of noses, as guards list them.

use schemars::JsonSchema;
use serde::Serialize;

use crate::problem::Nose;

/// Shape of a nose without its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NoseKind {
    /// Flat end.
    Flat,
    /// Hemisphere.
    Hemisphere,
    /// Cone.
    Cone,
    /// Tangent ogive.
    Ogive,
}

impl NoseKind {
    /// All shapes.
    pub const ALL: &'static [Self] = &[Self::Flat, Self::Hemisphere, Self::Cone, Self::Ogive];
    /// All shapes but the flat end.
    pub const SHARP: &'static [Self] = &[Self::Hemisphere, Self::Cone, Self::Ogive];

    /// The shape of a nose.
    pub fn of(nose: Nose) -> Self {
        match nose {
            Nose::Flat => Self::Flat,
            Nose::Hemisphere => Self::Hemisphere,
            Nose::Cone { .. } => Self::Cone,
            Nose::Ogive { .. } => Self::Ogive,
        }
    }

    /// Name as a case has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::Hemisphere => "hemisphere",
            Self::Cone => "cone",
            Self::Ogive => "ogive",
        }
    }
}
