//! Published tests: what struck what, what was measured, and where that was read.
//!
//! The program's own tests are the files of `data/experiments/`, whose README describes every column; [`read`] takes a user's file of
//! the same columns.

mod columns;
mod materials;
mod read;
mod scenario;
#[cfg(test)]
mod tests;

use std::sync::LazyLock;

use serde::Serialize;

pub use columns::{COLUMNS, CsvColumn};
pub use read::{TestFile, read, read_str};

use crate::{case::Nose, material::Library, material::Trust, outcome::BandQuantity};

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../data/experiments/", $name)))),*]
    };
}

/// Built-in files of tests. Adding one is one file in `data/experiments/` and one line here.
const FILES: &[(&str, &str)] = files!["taylor.csv", "plates.csv", "experiments.csv"];

/// A published test or ballistic limit. SI units, but for the obliquity in degrees.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// Its id, unique among all tests.
    pub id: String,
    /// Bibliography key of the work that it comes from; of a user's test, any words.
    pub source: String,
    /// The public place where it was read.
    pub read_at: String,
    /// Under which licence it is passed on.
    pub licence: String,
    /// What was measured.
    pub kind: Kind,
    /// The projectile in a word or two: tests are grouped by it.
    pub projectile_class: String,
    /// Ids or families of the material records that stand for the projectile; the first one is the main one.
    pub projectile_materials: Vec<String>,
    /// Shape of the nose.
    pub nose: Nose,
    /// Length of the projectile [m]; this or the mass is given.
    pub length: Option<f64>,
    /// Diameter of the shank [m].
    pub diameter: Option<f64>,
    /// Mass [kg].
    pub mass: Option<f64>,
    /// Temperature of the projectile before the impact [K].
    pub temperature: Option<f64>,
    /// Impact velocity [m/s]; of a ballistic limit, the limit.
    pub impact_velocity: f64,
    /// Angle between the path and the normal of the struck face \[deg\].
    pub obliquity_deg: f64,
    /// What was struck.
    pub target: Struck,
    /// What was measured, in the SI unit of its kind.
    pub measured: f64,
    /// Standard deviation of the measured value, or what stands for it.
    pub uncertainty: Option<f64>,
    /// How far the row can be trusted.
    pub trust: Trust,
    /// Whether a constant that all models share was fitted to its source; what single models were fitted to stands in their validity.
    pub split: Split,
    /// Why the row is suspect: it is listed, and no statistic counts it.
    pub flag: Option<String>,
    /// Id of the test that it repeats: no statistic counts it.
    pub duplicate_of: Option<String>,
    /// Why no case can be made of it.
    pub unusable: Option<String>,
    /// Other remarks.
    pub note: String,
}

/// What was struck.
#[derive(Debug, Clone, PartialEq)]
pub enum Struck {
    /// A rigid wall.
    RigidWall,
    /// A plate or a semi-infinite body.
    Body {
        /// Name of its material: one of the library unless properties are given.
        material: String,
        /// Its thickness [m]; `None` for a semi-infinite body.
        thickness: Option<f64>,
        /// Properties that came with the test.
        properties: Option<Properties>,
    },
}

impl Struck {
    /// The target's material, or that it is a wall.
    pub fn name(&self) -> &str {
        match self {
            Self::RigidWall => columns::RIGID_WALL,
            Self::Body { material, .. } => material,
        }
    }

    /// Its thickness [m]; `None` for a wall or a semi-infinite body.
    pub fn thickness(&self) -> Option<f64> {
        match self {
            Self::RigidWall => None,
            Self::Body { thickness, .. } => *thickness,
        }
    }
}

/// Properties of a target that came with a test. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Properties {
    /// Density [kg/m3].
    pub density: f64,
    /// Young's modulus [Pa].
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Yield stress of a metal or compressive strength of a concrete [Pa].
    pub strength: Strength,
    /// Ultimate tensile strength [Pa].
    pub ultimate_strength: Option<f64>,
    /// Brinell hardness number.
    pub brinell_hardness: Option<f64>,
}

/// Strength of a target whose properties came with a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Strength {
    /// `σ = Y (E ε/Y)ⁿ` beyond the yield stress Y, which the elastic line meets there; perfectly plastic for n = 0.
    Metal {
        /// Yield stress Y [Pa].
        yield_stress: f64,
        /// Hardening exponent n.
        exponent: f64,
    },
    /// Concrete of this unconfined compressive strength [Pa].
    Concrete(f64),
}

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Final length of a rod that struck a rigid wall.
    Taylor,
    /// Impact velocity at which half of the tests perforate, or what stands for it.
    BallisticLimit,
    /// Depth of penetration.
    Depth,
    /// Velocity of the projectile behind the target; 0 when it was stopped.
    ResidualVelocity,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 4] = [
        Self::Taylor,
        Self::BallisticLimit,
        Self::Depth,
        Self::ResidualVelocity,
    ];

    /// Name as files and the command line have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Taylor => "taylor",
            Self::BallisticLimit => "ballistic_limit",
            Self::Depth => "depth",
            Self::ResidualVelocity => "residual_velocity",
        }
    }

    /// What tests of this kind are of.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Taylor => "final lengths of Taylor rods",
            Self::BallisticLimit => "ballistic limits of plates",
            Self::Depth => "depths of penetration",
            Self::ResidualVelocity => "residual velocities",
        }
    }

    /// The kind of this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// What a model has to predict.
    pub fn quantity(self) -> BandQuantity {
        match self {
            Self::Taylor => BandQuantity::ProjectileFinalLength,
            Self::BallisticLimit => BandQuantity::BallisticLimit,
            Self::Depth => BandQuantity::DepthOfPenetration,
            Self::ResidualVelocity => BandQuantity::ResidualVelocity,
        }
    }

    /// SI units in the unit in which files and reports show the quantity.
    pub fn shown(self, si: f64) -> f64 {
        match self {
            Self::Taylor | Self::Depth => si * 1e3,
            Self::BallisticLimit | Self::ResidualVelocity => si,
        }
    }

    /// The unit in which files and reports show the quantity.
    pub fn unit(self) -> &'static str {
        self.quantity().unit()
    }
}

/// Whether a constant or the form of a model was fitted to the source of a test or chosen on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Split {
    /// Neither was.
    Blind,
    /// One was, or may have been.
    Calibration,
}

impl Split {
    /// Name as files have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Blind => "blind",
            Self::Calibration => "calibration",
        }
    }
}

/// The tests that the program ships.
///
/// # Panics
/// When a shipped file is not valid, which the library's own tests rule out.
pub fn built_in() -> &'static [Experiment] {
    static TESTS: LazyLock<Vec<Experiment>> = LazyLock::new(|| {
        FILES
            .iter()
            .flat_map(
                |(name, text)| match read_str(name, text, Library::built_in()) {
                    Ok(tests) => tests,
                    Err(error) => panic!("built-in tests: {error}"),
                },
            )
            .collect()
    });
    &TESTS
}
