use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, Limits, limits},
    units::{Angle, Length},
};

/// Shape of a projectile's nose, by the dimension that a case gives.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NoseGeometry {
    /// Flat end.
    #[default]
    Flat,
    /// Hemisphere.
    Hemisphere,
    /// Cone.
    Cone(ConeGeometry),
    /// Tangent ogive.
    Ogive(OgiveGeometry),
}

/// Shape of a conical nose, by one of its dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ConeGeometry {
    /// Length of the cone in shank diameters.
    LengthToDiameter(f64),
    /// Angle at the tip from side to side, twice the half angle [rad].
    Angle(Angle),
    /// Angle between axis and side [rad].
    HalfAngle(Angle),
}

/// Shape of an ogival nose, by one of its dimensions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OgiveGeometry {
    /// Caliber-radius-head: radius of the ogive's arc in shank diameters.
    Crh(f64),
    /// Radius of the ogive's arc [m].
    Radius(Length),
    /// Length of the nose [m].
    Length(Length),
}

impl NoseGeometry {
    /// The nose on a shank of this diameter [m].
    pub fn on_shank(self, diameter: f64) -> Nose {
        match self {
            Self::Flat => Nose::Flat,
            Self::Hemisphere => Nose::Hemisphere,
            Self::Cone(cone) => Nose::Cone {
                length_to_diameter: match cone {
                    ConeGeometry::LengthToDiameter(ratio) => ratio,
                    ConeGeometry::Angle(angle) => 0.5 / (0.5 * angle.si()).tan(),
                    ConeGeometry::HalfAngle(angle) => 0.5 / angle.si().tan(),
                },
            },
            Self::Ogive(ogive) => Nose::Ogive {
                crh: match ogive {
                    OgiveGeometry::Crh(crh) => crh,
                    OgiveGeometry::Radius(radius) => radius.si() / diameter,
                    // The arc meets the shank without a corner: L² = s² - (s - d/2)².
                    OgiveGeometry::Length(length) => (length.si() / diameter).powi(2) + 0.25,
                },
            },
        }
    }

    /// Reports a dimension that is not allowed on a shank of this diameter [m].
    pub(super) fn check(self, check: &mut Check<'_>, diameter: f64) {
        match self {
            Self::Flat | Self::Hemisphere => {}
            Self::Cone(ConeGeometry::LengthToDiameter(ratio)) => {
                check.number("cone.length_to_diameter", ratio, limits::CONE_RATIO);
            }
            Self::Cone(ConeGeometry::Angle(angle)) => {
                let half = limits::CONE_HALF_ANGLE;
                let full = Limits {
                    min: 2.0 * half.min,
                    max: 2.0 * half.max,
                };
                check_angle("angle", angle, full, "from side to side", check);
            }
            Self::Cone(ConeGeometry::HalfAngle(angle)) => {
                let place = "between axis and side";
                check_angle("half_angle", angle, limits::CONE_HALF_ANGLE, place, check);
            }
            Self::Ogive(OgiveGeometry::Crh(crh)) => {
                check.number("ogive.crh", crh, limits::CALIBER_RADIUS_HEAD);
            }
            Self::Ogive(OgiveGeometry::Radius(radius)) => {
                let limits = limits::CALIBER_RADIUS_HEAD;
                check_length("radius", radius, limits, diameter, check);
            }
            Self::Ogive(OgiveGeometry::Length(length)) => {
                check_length("length", length, limits::OGIVE_RATIO, diameter, check);
            }
        }
    }
}

/// Reports an angle of a cone out of range; `place` says between what it is.
fn check_angle(key: &str, angle: Angle, allowed: Limits, place: &str, check: &mut Check<'_>) {
    if !allowed.allow(angle.si()) {
        check.out_of_range(
            &format!("cone.{key}"),
            angle,
            format!(
                "allowed: {} to {} {place}; for a flat end write nose = \"flat\"",
                Angle::new(allowed.min),
                Angle::new(allowed.max)
            ),
        );
    }
}

/// Reports a length of an ogive out of a range in diameters of the shank [m].
fn check_length(
    key: &str,
    length: Length,
    diameters: Limits,
    diameter: f64,
    check: &mut Check<'_>,
) {
    let [min, max] = [diameters.min * diameter, diameters.max * diameter];
    if !(Limits { min, max }).allow(length.si()) {
        check.out_of_range(
            &format!("ogive.{key}"),
            length,
            format!(
                "allowed: {} to {}, that is {} to {} diameters of the shank; the least is a hemisphere",
                Length::new(min),
                Length::new(max),
                diameters.min,
                diameters.max
            ),
        );
    }
}

impl From<Nose> for NoseGeometry {
    fn from(nose: Nose) -> Self {
        match nose {
            Nose::Flat => Self::Flat,
            Nose::Hemisphere => Self::Hemisphere,
            Nose::Cone { length_to_diameter } => {
                Self::Cone(ConeGeometry::LengthToDiameter(length_to_diameter))
            }
            Nose::Ogive { crh } => Self::Ogive(OgiveGeometry::Crh(crh)),
        }
    }
}

impl From<ConeGeometry> for NoseGeometry {
    fn from(cone: ConeGeometry) -> Self {
        Self::Cone(cone)
    }
}

impl From<OgiveGeometry> for NoseGeometry {
    fn from(ogive: OgiveGeometry) -> Self {
        Self::Ogive(ogive)
    }
}

/// Shape of a projectile's nose, in diameters of the shank: what models read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Nose {
    /// Flat end.
    #[default]
    Flat,
    /// Hemisphere.
    Hemisphere,
    /// Cone.
    Cone {
        /// Length of the cone in shank diameters.
        length_to_diameter: f64,
    },
    /// Tangent ogive.
    Ogive {
        /// Caliber-radius-head: radius of the ogive's arc in shank diameters.
        crh: f64,
    },
}

impl Nose {
    /// Length of the nose [m] on a shank of this diameter [m].
    pub fn length(self, diameter: f64) -> f64 {
        match self {
            Self::Flat => 0.0,
            Self::Hemisphere => diameter / 2.0,
            Self::Cone { length_to_diameter } => length_to_diameter * diameter,
            Self::Ogive { crh } => diameter * (crh - 0.25).sqrt(),
        }
    }

    /// Radius at a distance behind the tip [m], on a shank of this diameter [m]; 0 ahead of the tip.
    pub fn radius(self, diameter: f64, behind: f64) -> f64 {
        let shank = 0.5 * diameter;
        let length = self.length(diameter);
        if behind >= length {
            return shank;
        }
        if behind <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Flat => shank,
            Self::Hemisphere => (shank * shank - (shank - behind).powi(2)).sqrt(),
            Self::Cone { .. } => shank * behind / length,
            Self::Ogive { crh } => {
                let arc = crh * diameter;
                let along = length - behind;
                (arc * arc - along * along).sqrt() - (arc - shank)
            }
        }
    }

    /// Volume of the nose [m3] on a shank of this diameter [m].
    pub fn volume(self, diameter: f64) -> f64 {
        let radius = diameter / 2.0;
        match self {
            Self::Flat => 0.0,
            Self::Hemisphere => 2.0 / 3.0 * PI * radius.powi(3),
            Self::Cone { .. } => PI / 3.0 * radius.powi(2) * self.length(diameter),
            Self::Ogive { crh } => {
                // r(x) = sqrt(s² − x²) − (s − a): solid of revolution of a circular arc of radius s = 2 a ψ.
                let s = crh * diameter;
                let length = self.length(diameter);
                let offset = s - radius;
                let arc = s * s * (length / s).asin() / 2.0
                    + length * (s * s - length * length).max(0.0).sqrt() / 2.0;
                PI * (s * s * length - length.powi(3) / 3.0 + offset * offset * length
                    - 2.0 * offset * arc)
            }
        }
    }

    /// Name as the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::Hemisphere => "hemisphere",
            Self::Cone { .. } => "cone",
            Self::Ogive { .. } => "ogive",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ogive_of_half_a_caliber_is_a_hemisphere() {
        let ogive = Nose::Ogive { crh: 0.5 };
        let diameter = 0.02;
        assert!((ogive.length(diameter) - Nose::Hemisphere.length(diameter)).abs() < 1e-12);
        let ratio = ogive.volume(diameter) / Nose::Hemisphere.volume(diameter);
        assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
    }

    #[test]
    fn the_volume_of_a_nose_is_the_integral_of_its_sections() {
        let diameter = 0.02;
        for nose in [
            Nose::Hemisphere,
            Nose::Cone {
                length_to_diameter: 0.98,
            },
            Nose::Ogive { crh: 0.5 },
            Nose::Ogive { crh: 3.0 },
        ] {
            let length = nose.length(diameter);
            let n = 20_000;
            let sum: f64 = (0..n)
                .map(|i| {
                    let r = nose.radius(diameter, length * (i as f64 + 0.5) / n as f64);
                    PI * r * r * length / n as f64
                })
                .sum();
            assert!((nose.volume(diameter) / sum - 1.0).abs() < 1e-7, "{nose:?}");
            assert_eq!(nose.radius(diameter, length), 0.5 * diameter);
            assert_eq!(nose.radius(diameter, -1e-9), 0.0);
        }
        assert_eq!(Nose::Flat.radius(diameter, 0.0), 0.5 * diameter);
    }

    #[test]
    fn every_dimension_gives_the_same_nose() {
        let (diameter, mm) = (0.02, |value: f64| Length::new(1e-3 * value));
        let deg = |text: &str| text.parse::<Angle>().unwrap();
        let half = 0.5 / (30.0_f64.to_radians()).tan();
        for cone in [
            ConeGeometry::LengthToDiameter(half),
            ConeGeometry::Angle(deg("60 deg")),
            ConeGeometry::HalfAngle(deg("30 deg")),
        ] {
            let nose = NoseGeometry::from(cone).on_shank(diameter);
            // A cone of 60 deg on 20 mm is 10 mm / tan 30 deg long.
            let length = 0.01 * 3.0_f64.sqrt();
            assert!(
                (nose.length(diameter) / length - 1.0).abs() < 1e-14,
                "{cone:?}"
            );
        }
        let arc = (60.0_f64.powi(2) - 50.0_f64.powi(2)).sqrt();
        for ogive in [
            OgiveGeometry::Crh(3.0),
            OgiveGeometry::Radius(mm(60.0)),
            OgiveGeometry::Length(mm(arc)),
        ] {
            let Nose::Ogive { crh } = NoseGeometry::from(ogive).on_shank(diameter) else {
                panic!("{ogive:?}");
            };
            assert!((crh / 3.0 - 1.0).abs() < 1e-14, "{ogive:?}: {crh}");
        }
        for nose in [Nose::Flat, Nose::Hemisphere, Nose::Ogive { crh: 2.5 }] {
            assert_eq!(NoseGeometry::from(nose).on_shank(diameter), nose);
        }
    }

    #[test]
    fn ranges_of_all_dimensions_are_those_of_the_shape() {
        for half in [limits::CONE_HALF_ANGLE.min, limits::CONE_HALF_ANGLE.max] {
            let ratio = 0.5 / half.tan();
            assert!(limits::CONE_RATIO.allow(ratio), "{ratio}");
            let end = [limits::CONE_RATIO.min, limits::CONE_RATIO.max];
            assert!(
                end.iter().any(|end| (ratio / end - 1.0).abs() < 1e-4),
                "{ratio}"
            );
        }
        let crh = |ratio: f64| ratio * ratio + 0.25;
        let [least, most] = [limits::OGIVE_RATIO.min, limits::OGIVE_RATIO.max].map(crh);
        assert_eq!(least, limits::CALIBER_RADIUS_HEAD.min);
        assert!(
            limits::CALIBER_RADIUS_HEAD.allow(most)
                && most > 0.999 * limits::CALIBER_RADIUS_HEAD.max
        );
    }

    #[test]
    fn a_dimension_out_of_range_is_refused_in_its_own_terms() {
        let said = |nose: NoseGeometry| {
            let mut diagnostics = Vec::new();
            nose.check(&mut Check::new(&mut diagnostics), 0.02);
            let only = diagnostics.into_iter().next();
            only.map(|said| format!("{}: {}; {}", said.key, said.message, said.help))
        };
        let deg = |text: &str| text.parse::<Angle>().unwrap();
        for (nose, expected) in [
            (
                ConeGeometry::Angle(deg("158 deg")).into(),
                "cone.angle: 158 deg is out of range; allowed: 2.8642 deg to 157.38 deg from side to side",
            ),
            (
                ConeGeometry::HalfAngle(deg("1 deg")).into(),
                "cone.half_angle: 1 deg is out of range; allowed: 1.4321 deg to 78.69 deg between axis and side",
            ),
            (
                OgiveGeometry::Radius(Length::new(0.009)).into(),
                "ogive.radius: 9 mm is out of range; allowed: 10 mm to 1 m, that is 0.5 to 50 diameters",
            ),
            (
                OgiveGeometry::Length(Length::new(0.142)).into(),
                "ogive.length: 142 mm is out of range; allowed: 10 mm to 141 mm, that is 0.5 to 7.05 diameters",
            ),
        ] {
            let said = said(nose).unwrap();
            assert!(said.starts_with(expected), "{said}");
        }
        for text in ["2.8642 deg", "157.38 deg"] {
            assert_eq!(said(ConeGeometry::Angle(deg(text)).into()), None, "{text}");
        }
    }
}
