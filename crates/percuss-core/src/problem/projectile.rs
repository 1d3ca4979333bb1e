use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Nose, NoseGeometry};
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
    pub nose: NoseGeometry,
    /// Impact velocity [m/s].
    pub impact_velocity: Velocity,
    /// Angle between the path and the normal of the struck face [rad]; 0, normal impact, when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub obliquity: Option<Angle>,
    /// Angle between the axis and the path [rad]; only 0, which is the default: no model computes yaw.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yaw: Option<Angle>,
    /// Temperature before the impact [K]; `room_temperature` of the material when not given. A difference of up to 5 K counts as none where the model or the strength law has no temperature.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature: Option<Temperature>,
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
            nose: NoseGeometry::Flat,
            impact_velocity,
            obliquity: None,
            yaw: None,
            temperature: None,
        }
    }

    /// The same with a nose.
    #[must_use]
    pub fn with_nose(self, nose: impl Into<NoseGeometry>) -> Self {
        let nose = nose.into();
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

    /// Shape of the nose in diameters of the shank.
    pub fn nose(&self) -> Nose {
        self.nose.on_shank(self.diameter.si())
    }

    /// Length over all [m] and mass [kg], one from the other; `None` when not just one of them is given.
    pub fn length_and_mass(&self, density: f64) -> Option<(f64, f64)> {
        let diameter = self.diameter.si();
        let area = PI * diameter * diameter / 4.0;
        let nose = self.nose();
        let (nose_length, nose_volume) = (nose.length(diameter), nose.volume(diameter));
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
            check.out_of_range(
                "obliquity",
                obliquity,
                format!(
                    "allowed: {} to {}, between the path and the normal of the struck face: 0 deg is normal impact",
                    Angle::new(limits::OBLIQUITY.min),
                    Angle::new(limits::OBLIQUITY.max)
                ),
            );
        }
        if let Some(yaw) = self.yaw.filter(|yaw| yaw.si() != 0.0) {
            check.fail(
                "yaw",
                format!("no model computes yaw, and this is {yaw}: every model takes a projectile that flies along its axis"),
                "allowed: 0 deg; an impact at an angle to the struck face is `obliquity`",
            );
        }
        check.quantity("temperature", self.temperature, limits::TEMPERATURE);
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
        self.nose
            .check(&mut check.within("nose"), self.diameter.si());
    }
}

/// Reports a velocity out of range, or one other than zero that is too small.
fn check_impact_velocity(velocity: Velocity, check: &mut Check<'_>) {
    let [moving, all] = [limits::MOVING, limits::IMPACT_VELOCITY];
    let is_slow = velocity.si() > 0.0 && velocity.si() < moving.min;
    if !is_slow || moving.allow(velocity.si()) {
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
