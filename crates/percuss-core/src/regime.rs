//! Regime of an impact: behaviour of the projectile, kind of target, and how certain that classification is.

use std::fmt::Write as _;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    material::{Material, Strength, cavity_expansion_pressure_at, strength_factor},
    problem::Nose,
    scenario::{Scenario, TargetBody},
    units::{Pressure, Velocity, significant},
};

/// What the projectile does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ProjectileRegime {
    /// It keeps its shape.
    Rigid,
    /// It shortens and thickens.
    Deforming,
    /// It is used up at its tip.
    Eroding,
}

impl ProjectileRegime {
    /// All of them.
    pub const ALL: &'static [Self] = &[Self::Rigid, Self::Deforming, Self::Eroding];

    /// The regime in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Deforming => "deforming",
            Self::Eroding => "eroding",
        }
    }
}

/// What is struck.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TargetKind {
    /// One material without a rear face.
    SemiInfinite,
    /// One plate, at least [`THICK`] projectile diameters thick.
    ThickPlate,
    /// One plate between thin and thick.
    Plate,
    /// One plate, less than [`THIN`] of a projectile diameter thick.
    ThinPlate,
    /// Several layers.
    Layered,
    /// A rigid wall.
    RigidWall,
    /// A constant pressure.
    ConstantPressure,
}

/// Thickness in projectile diameters from which on a plate is called thick.
pub const THICK: f64 = 5.0;
/// Thickness in projectile diameters below which a plate is called thin: below `√3/2`, plugging is favoured \[woodward1984\].
pub const THIN: f64 = 0.866;
/// Part by which rounding may move a ratio of two numbers that a case gives.
const ROUNDING: f64 = 1e-9;

/// Whether a positive number is at least another one, but for rounding: 50 mm are ten times 5 mm in any unit.
pub fn at_least(value: f64, bound: f64) -> bool {
    value >= bound * (1.0 - ROUNDING)
}

/// Whether a target is thinner than some diameters of the projectile, but for rounding.
pub fn is_thinner(thickness: f64, diameters: f64, scenario: &Scenario) -> bool {
    !at_least(thickness, diameters * scenario.projectile.diameter)
}

impl TargetKind {
    /// All of them.
    pub const ALL: &'static [Self] = &[
        Self::SemiInfinite,
        Self::ThickPlate,
        Self::Plate,
        Self::ThinPlate,
        Self::Layered,
        Self::RigidWall,
        Self::ConstantPressure,
    ];
    /// Targets that a projectile may stay in.
    pub const DEEP: &'static [Self] = &[Self::SemiInfinite, Self::ThickPlate, Self::Plate];
    /// Targets of one layer with a back.
    pub const PLATES: &'static [Self] = &[Self::ThickPlate, Self::Plate, Self::ThinPlate];

    /// The kind of target of a case.
    pub fn of(scenario: &Scenario) -> Self {
        match &scenario.target {
            TargetBody::RigidWall => Self::RigidWall,
            TargetBody::ConstantPressure(_) => Self::ConstantPressure,
            TargetBody::Layers { layers, .. } if layers.len() > 1 => Self::Layered,
            TargetBody::Layers { .. } => match scenario.target_thickness() {
                None => Self::SemiInfinite,
                Some(h) if !is_thinner(h, THICK, scenario) => Self::ThickPlate,
                Some(h) if is_thinner(h, THIN, scenario) => Self::ThinPlate,
                Some(_) => Self::Plate,
            },
        }
    }

    /// The kind in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::SemiInfinite => "semi-infinite targets",
            Self::ThickPlate => "thick plates",
            Self::Plate => "plates of medium thickness",
            Self::ThinPlate => "thin plates",
            Self::Layered => "layered targets",
            Self::RigidWall => "rigid walls",
            Self::ConstantPressure => "constant pressures",
        }
    }

    /// Whether it is made of a material: a rigid wall and a pressure are not.
    pub fn has_material(self) -> bool {
        !matches!(self, Self::RigidWall | Self::ConstantPressure)
    }
}

/// Regime of an impact.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Regime {
    /// What the projectile does.
    pub projectile: ProjectileRegime,
    /// Regime that it may also have, where the classification is uncertain.
    pub neighbour: Option<ProjectileRegime>,
    /// What is struck.
    pub target: TargetKind,
    /// The numbers behind the classification.
    pub because: String,
}

/// Plastic strain at which a strength is evaluated: reached early in any impact that yields.
pub const STRENGTH_STRAIN: f64 = 0.1;

/// Strain `1 − A₀/A` of the struck end of a perfectly plastic rod on a rigid wall, for `ρv²/Y` \[taylor1948\]: `e²/(1 − e) = ρv²/Y`.
pub fn struck_end_strain(number: f64) -> f64 {
    2.0 * number / ((number * number + 4.0 * number).sqrt() + number)
}

/// Factor on either side of a threshold stress within which the classification is uncertain.
const STRESS_EDGE: f64 = 1.5;
/// Factor on either side of a threshold speed within which the classification is uncertain.
const SPEED_EDGE: f64 = 1.25;

impl Regime {
    /// The regime of a case.
    ///
    /// The stress behind a rigid nose, `p = R + N ρ V²` with the quasi-static resistance R of the target and the
    /// nose's shape factor N, is compared with the projectile's flow stress Y at a plastic strain of 0.1. Below it the projectile
    /// stays rigid. Above, it erodes where Alekseevskii and Tate let it penetrate or erode: beyond `√(2(R − Y)/ρ_p)`, or beyond
    /// `√(2(Y − R)/ρ_t)` when it is stronger than the target; otherwise it deforms \[tate1967\].
    pub fn of(scenario: &Scenario) -> Self {
        let rod = &scenario.projectile;
        let target = TargetKind::of(scenario);
        let speed = scenario.impact_velocity;
        let Some(strength) = rod
            .material
            .flow_stress_at(STRENGTH_STRAIN, rod.start_temperature())
        else {
            return Self {
                projectile: ProjectileRegime::Rigid,
                neighbour: None,
                target,
                because: "its material never yields".to_owned(),
            };
        };
        let shown = |stress: f64| Pressure::new(rounded(stress));
        let mut because = String::new();
        let (pressure, resistance, density) = match &scenario.target {
            TargetBody::RigidWall => {
                let elastic = rod.material.density.si() * rod.material.bar_wave_speed() * speed;
                let _ = write!(
                    because,
                    "an elastic impact on the wall would stress it to {}",
                    shown(elastic)
                );
                (elastic, None, 0.0)
            }
            TargetBody::ConstantPressure(pressure) => {
                let _ = write!(because, "the pressure is {}", shown(*pressure));
                (*pressure, None, 0.0)
            }
            TargetBody::Layers { layers, .. } => {
                let front = layers.first();
                let resistance = front.and_then(|front| {
                    target_resistance(&front.material, front.start_temperature())
                });
                let density = front.map_or(0.0, |front| front.material.density.si());
                let pressure = resistance.map_or(f64::INFINITY, |resistance| {
                    resistance + nose_factor(rod.nose) * density * speed * speed
                });
                let _ = match resistance {
                    Some(_) => write!(
                        because,
                        "the pressure on a rigid nose would be {}",
                        shown(pressure)
                    ),
                    None => write!(because, "the target never yields"),
                };
                (pressure, resistance, density)
            }
        };
        let against = match pressure.is_finite() {
            true => " against its flow stress of",
            false => ", the projectile does, at a flow stress of",
        };
        let _ = write!(because, "{against} {}", shown(strength));
        let stays_rigid = pressure < strength;
        let stress_is_close =
            pressure < STRESS_EDGE * strength && pressure * STRESS_EDGE > strength;
        let Some(resistance) = resistance else {
            let (projectile, other) = match stays_rigid {
                true => (ProjectileRegime::Rigid, ProjectileRegime::Deforming),
                false => (ProjectileRegime::Deforming, ProjectileRegime::Rigid),
            };
            return Self {
                projectile,
                neighbour: stress_is_close.then_some(other),
                target,
                because,
            };
        };
        let threshold = if resistance > strength {
            (2.0 * (resistance - strength) / rod.material.density.si()).sqrt()
        } else {
            (2.0 * (strength - resistance) / density).sqrt()
        };
        let erodes = speed > threshold;
        let speed_is_close = speed < SPEED_EDGE * threshold && speed * SPEED_EDGE > threshold;
        if !stays_rigid {
            let _ = write!(
                because,
                "; it erodes above {} (target resistance {})",
                Velocity::new(rounded(threshold)),
                shown(resistance)
            );
        }
        let (projectile, neighbour) = match (stays_rigid, erodes) {
            (true, _) => (
                ProjectileRegime::Rigid,
                stress_is_close.then_some(if erodes {
                    ProjectileRegime::Eroding
                } else {
                    ProjectileRegime::Deforming
                }),
            ),
            (false, true) => (
                ProjectileRegime::Eroding,
                match (stress_is_close, speed_is_close) {
                    (true, _) => Some(ProjectileRegime::Rigid),
                    (false, true) => Some(ProjectileRegime::Deforming),
                    _ => None,
                },
            ),
            (false, false) => (
                ProjectileRegime::Deforming,
                match (stress_is_close, speed_is_close) {
                    (true, _) => Some(ProjectileRegime::Rigid),
                    (false, true) => Some(ProjectileRegime::Eroding),
                    _ => None,
                },
            ),
        };
        Self {
            projectile,
            neighbour,
            target,
            because,
        }
    }

    /// What is struck, in words, with its numbers.
    pub fn target_in_words(&self, scenario: &Scenario) -> String {
        let ratio = scenario.target_thickness().map_or_else(String::new, |h| {
            format!(
                " ({} projectile diameters)",
                significant(h / scenario.projectile.diameter, 3)
            )
        });
        let kind = match self.target {
            TargetKind::SemiInfinite => "a semi-infinite target",
            TargetKind::ThickPlate => "a thick plate",
            TargetKind::Plate => "a plate of medium thickness",
            TargetKind::ThinPlate => "a thin plate",
            TargetKind::Layered => "a layered target",
            TargetKind::RigidWall => "a rigid wall",
            TargetKind::ConstantPressure => "a constant pressure",
        };
        format!("{kind}{ratio}")
    }

    /// The regime in a few words, without the numbers behind the classification.
    pub fn kind_in_words(&self, scenario: &Scenario) -> String {
        let mut text = format!("{} projectile", self.projectile.describe());
        if let Some(neighbour) = self.neighbour {
            let _ = write!(text, " (or {})", neighbour.describe());
        }
        let _ = write!(text, ", {}", self.target_in_words(scenario));
        text
    }

    /// The regime in one sentence.
    pub fn describe(&self, scenario: &Scenario) -> String {
        format!("{}: {}", self.kind_in_words(scenario), self.because)
    }
}

/// A value to three digits: the classification is no more precise.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Pressure that a target opposes to slow penetration [Pa]: of concrete `S f_c` \[forrestal1994\], of a metal the expansion of a
/// spherical cavity at its temperature [K]; `None` for a law that never flows.
fn target_resistance(material: &Material, temperature: f64) -> Option<f64> {
    match &material.strength {
        Strength::Concrete(law) => {
            let strength = law.compressive_strength.si();
            Some(strength * strength_factor(strength))
        }
        _ => cavity_expansion_pressure_at(material, temperature),
    }
}

/// Shape factor N of the inertial pressure on a nose: `∫ cos²` over the projected area \[forrestal1988\].
pub fn nose_factor(nose: Nose) -> f64 {
    match nose {
        Nose::Flat => 1.0,
        Nose::Hemisphere => 0.5,
        Nose::Cone { length_to_diameter } => 1.0 / (1.0 + 4.0 * length_to_diameter.powi(2)),
        Nose::Ogive { crh } => (8.0 * crh - 1.0) / (24.0 * crh * crh),
    }
}
