//! Ranges of ratios and of the speed that a validity sets.

use serde::Serialize;

use crate::{
    material::tensile_strength,
    regime::{STRENGTH_STRAIN, at_least},
    scenario::Scenario,
    units::significant,
};

/// A range of a ratio or of the speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Range {
    /// What is measured.
    pub measure: Measure,
    /// Smallest value, in the unit of the measure.
    pub min: f64,
    /// Largest value, in the unit of the measure; `null` in JSON when there is none.
    pub max: f64,
    /// What becomes of a case outside.
    pub outside: Outside,
    /// Why the range ends there.
    pub because: &'static str,
}

impl Range {
    /// A warning on thin plates, for models whose target is a column: it models neither plugging nor bending.
    pub const COLUMN: Self = Self {
        measure: Measure::ThicknessToDiameter,
        min: crate::regime::THIN,
        max: f64::INFINITY,
        outside: Outside::Warning,
        because: "a thin plate fails by plugging or bending, and a column includes neither: it does not predict perforation",
    };

    /// A warning on discs, for models of rods: `fdm.geometry = "planar"` computes them until release comes from the edge.
    pub const ROD: Self = Self {
        measure: Measure::FlatRodLengthToDiameter,
        min: 0.5,
        max: f64::INFINITY,
        outside: Outside::Warning,
        because: "a disc stays in uniaxial strain until release comes from its edge, and the model is of uniaxial stress: give \
                  `fdm.geometry = \"planar\"` to the model `fdm`",
    };

    /// A warning on targets that are not much thicker than the projectile, for models whose resistance is that of an infinite body.
    pub const INFINITE_BODY: Self = Self {
        measure: Measure::ThicknessToDiameter,
        min: 5.0,
        max: f64::INFINITY,
        outside: Outside::Warning,
        because: "the resistance is that of an infinite body: free surfaces within a few diameters weaken it",
    };

    /// A warning on targets that are not much thicker than the projectile, for models whose cavity expands in an infinite body.
    pub const INFINITE_CAVITY: Self = Self {
        because: "the cavity expands in an infinite body: free surfaces within a few diameters weaken it",
        ..Self::INFINITE_BODY
    };

    /// Rods that models of steady flow at the tip take.
    pub const STEADY_FLOW: Self = Self {
        measure: Measure::FlatRodLengthToDiameter,
        min: 3.0,
        max: f64::INFINITY,
        outside: Outside::NotApplicable,
        because: "its steady flow needs a rod that is long against the tip",
    };

    /// Projectiles that models of a rigid one take. The softest with published limits, fragment simulators on ultra-high-hardness
    /// armour, have 0.52.
    pub const RIGID_AGAINST_PLATE: Self = Self {
        measure: Measure::StrengthToPlate,
        min: 0.5,
        max: f64::INFINITY,
        outside: Outside::NotApplicable,
        because: "a softer projectile flattens against the plate, and the model takes it as rigid",
    };

    /// What is to be said of a case outside; `None` for a case inside, or without such a measure.
    pub fn diagnostic(&self, scenario: &Scenario) -> Option<String> {
        let value = self.measure.of(scenario)?;
        let is_inside = at_least(value, self.min) && at_least(self.max, value);
        (!is_inside).then(|| {
            format!(
                "{} is {}, and it takes {}: {}",
                self.measure.describe(),
                self.measure.with_unit(value),
                self.describe(),
                self.because
            )
        })
    }

    /// The range in words, with its unit.
    pub fn describe(&self) -> String {
        if self.max.is_infinite() {
            format!("{} or more", self.measure.with_unit(self.min))
        } else if self.min <= 0.0 {
            format!("up to {}", self.measure.with_unit(self.max))
        } else {
            format!(
                "{} to {}",
                significant(self.min, 4),
                self.measure.with_unit(self.max)
            )
        }
    }
}

/// What becomes of a case outside a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outside {
    /// No number.
    NotApplicable,
    /// A number and a warning.
    Warning,
}

/// What a range is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Length of the projectile over its diameter.
    LengthToDiameter,
    /// Length of the flat-ended rod of the same mass and diameter, over its diameter.
    FlatRodLengthToDiameter,
    /// Thickness of the target over the projectile's diameter.
    ThicknessToDiameter,
    /// Flow stress of the projectile over the tensile strength of the one plate.
    StrengthToPlate,
    /// Impact velocity [m/s].
    ImpactSpeed,
    /// Angle between the path and the normal of the struck face [deg].
    Obliquity,
}

impl Measure {
    /// Its value for a case; `None` where the case has none.
    pub fn of(self, scenario: &Scenario) -> Option<f64> {
        let rod = &scenario.projectile;
        match self {
            Self::LengthToDiameter => Some(rod.length / rod.diameter),
            Self::FlatRodLengthToDiameter => {
                let length = rod.mass / (rod.material.density.si() * rod.area());
                Some(length / rod.diameter)
            }
            Self::ThicknessToDiameter => Some(scenario.target_thickness()? / rod.diameter),
            Self::StrengthToPlate => {
                let strength = rod.material.flow_stress(STRENGTH_STRAIN)?;
                Some(strength / tensile_strength(&scenario.only_layer()?.material)?)
            }
            Self::ImpactSpeed => Some(scenario.impact_velocity),
            Self::Obliquity => Some(scenario.obliquity.to_degrees()),
        }
    }

    /// Its name in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::LengthToDiameter => "length to diameter",
            Self::FlatRodLengthToDiameter => "length to diameter, as a flat-ended rod of its mass,",
            Self::ThicknessToDiameter => "thickness to projectile diameter",
            Self::StrengthToPlate => {
                "flow stress of the projectile to tensile strength of the plate"
            }
            Self::ImpactSpeed => "impact velocity",
            Self::Obliquity => "angle to the normal",
        }
    }

    fn with_unit(self, value: f64) -> String {
        let unit = match self {
            Self::ImpactSpeed => " m/s",
            Self::Obliquity => " deg",
            _ => "",
        };
        format!("{}{unit}", significant(value, 4))
    }
}
