use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    units::{Angle, Length, Mass, Quantity, Temperature, Velocity},
};

/// A straight rod with a nose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Projectile {
    /// Id or family of a material of the library, or id of one of the case's own.
    pub material: String,
    /// Length over all, nose included [m]. Give this or the mass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<Length>,
    /// Mass [kg]. Give this or the length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<Mass>,
    /// Diameter of the shank [m].
    pub diameter: Length,
    /// Shape of the nose.
    #[serde(default)]
    pub nose: Nose,
    /// Impact velocity [m/s].
    pub impact_velocity: Velocity,
    /// Angle between the path and the normal of the struck face [rad]; 0, normal impact, when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub obliquity: Option<Angle>,
    /// Temperature before the impact [K]; `room_temperature` of the material when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature: Option<Temperature>,
}

/// Shape of a projectile's nose.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
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

impl Projectile {
    /// A flat-ended rod of a length, at the temperature of its material's record, in normal impact.
    pub fn rod(
        material: impl Into<String>,
        length: Length,
        diameter: Length,
        impact_velocity: Velocity,
    ) -> Self {
        Self {
            length: Some(length),
            ..Self::blank(material, diameter, impact_velocity)
        }
    }

    /// The same of a mass instead of the length.
    pub fn of_mass(
        material: impl Into<String>,
        mass: Mass,
        diameter: Length,
        impact_velocity: Velocity,
    ) -> Self {
        Self {
            mass: Some(mass),
            ..Self::blank(material, diameter, impact_velocity)
        }
    }

    fn blank(material: impl Into<String>, diameter: Length, impact_velocity: Velocity) -> Self {
        Self {
            material: material.into(),
            length: None,
            mass: None,
            diameter,
            nose: Nose::Flat,
            impact_velocity,
            obliquity: None,
            temperature: None,
        }
    }

    /// The same with a nose.
    #[must_use]
    pub fn with_nose(self, nose: Nose) -> Self {
        Self { nose, ..self }
    }

    /// The same at an angle between its path and the normal of the struck face.
    #[must_use]
    pub fn with_obliquity(self, obliquity: Angle) -> Self {
        Self {
            obliquity: Some(obliquity),
            ..self
        }
    }

    /// The same at a temperature before the impact.
    #[must_use]
    pub fn with_temperature(self, temperature: Temperature) -> Self {
        Self {
            temperature: Some(temperature),
            ..self
        }
    }

    /// Angle between the path and the normal of the struck face [rad].
    pub fn obliquity(&self) -> f64 {
        self.obliquity.map_or(0.0, Quantity::si)
    }

    /// Length over all [m] and mass [kg], one from the other; `None` when not just one of them is given.
    pub fn length_and_mass(&self, density: f64) -> Option<(f64, f64)> {
        let diameter = self.diameter.si();
        let area = PI * diameter * diameter / 4.0;
        let (nose_length, nose_volume) = (self.nose.length(diameter), self.nose.volume(diameter));
        match (self.length, self.mass) {
            (Some(length), None) => {
                let volume = nose_volume + area * (length.si() - nose_length);
                Some((length.si(), density * volume))
            }
            (None, Some(mass)) => {
                let shank = (mass.si() / density - nose_volume) / area;
                Some((nose_length + shank, mass.si()))
            }
            _ => None,
        }
    }

    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>) {
        check.quantity("diameter", self.diameter, limits::DIAMETER);
        check_impact_velocity(self.impact_velocity, check);
        let allowed = limits::OBLIQUITY.min..=limits::OBLIQUITY.max;
        if let Some(obliquity) = self
            .obliquity
            .filter(|angle| !allowed.contains(&angle.si()))
        {
            check.fail(
                "obliquity",
                format!("{obliquity} is out of range"),
                format!(
                    "allowed: {} to {}, between the path and the normal of the struck face: 0 deg is normal impact",
                    Angle::new(limits::OBLIQUITY.min),
                    Angle::new(limits::OBLIQUITY.max)
                ),
            );
        }
        if let Some(temperature) = self.temperature {
            check.quantity("temperature", temperature, limits::TEMPERATURE);
        }
        match (self.length, self.mass) {
            (Some(length), None) => check.quantity("length", length, limits::LENGTH),
            (None, Some(mass)) => check.quantity("mass", mass, limits::MASS),
            (None, None) => check.fail(
                "",
                "the projectile has neither a length nor a mass",
                "add `length`, for example length = \"12.74 mm\", or `mass`",
            ),
            (Some(_), Some(_)) => check.fail(
                "mass",
                "the projectile has both a length and a mass",
                "with the material's density one follows from the other: remove one",
            ),
        }
        match self.nose {
            Nose::Cone { length_to_diameter } => check.number(
                "nose.cone.length_to_diameter",
                length_to_diameter,
                limits::CONE_RATIO,
            ),
            Nose::Ogive { crh } => {
                check.number("nose.ogive.crh", crh, limits::CALIBER_RADIUS_HEAD);
            }
            Nose::Flat | Nose::Hemisphere => {}
        }
    }
}

/// Reports a velocity out of range, or one other than zero that is too small.
fn check_impact_velocity(velocity: Velocity, check: &mut Check<'_>) {
    let [moving, all] = [limits::MOVING, limits::IMPACT_VELOCITY];
    if velocity.si() <= 0.0 || velocity.si() > moving.max || moving.allow(velocity.si()) {
        check.quantity("impact_velocity", velocity, all);
        return;
    }
    check.fail(
        "impact_velocity",
        format!("{velocity} is too slow to be computed"),
        format!(
            "allowed: {}, or {} to {}",
            Velocity::new(all.min),
            Velocity::new(moving.min),
            Velocity::new(moving.max)
        ),
    );
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
    fn the_volume_of_an_ogive_is_its_integral() {
        let (nose, diameter) = (Nose::Ogive { crh: 3.0 }, 0.02);
        let (s, length) = (3.0 * diameter, nose.length(diameter));
        let n = 20_000;
        let sum: f64 = (0..n)
            .map(|i| {
                let x = length * (i as f64 + 0.5) / n as f64;
                let r = (s * s - x * x).sqrt() - (s - diameter / 2.0);
                PI * r * r * length / n as f64
            })
            .sum();
        assert!((nose.volume(diameter) / sum - 1.0).abs() < 1e-7);
    }
}
