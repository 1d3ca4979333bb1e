//! Measured values of a test of the case, for comparison with results; models do not read them.

use std::{borrow::Cow, fmt};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::Target;
use crate::{
    check::{Check, Limits, limits},
    outcome::BandQuantity,
    units::{Length, Velocity},
};

/// One measured quantity of one test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Experiment {
    /// Impact velocity [m/s]; a ballistic limit needs none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impact_velocity: Option<Velocity>,
    /// Measured depth of penetration [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_of_penetration: Option<Length>,
    /// Measured residual velocity [m/s]; 0 when it was stopped.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub residual_velocity: Option<Velocity>,
    /// Measured ballistic limit [m/s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ballistic_limit: Option<Velocity>,
    /// Measured length of the recovered projectile [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub projectile_final_length: Option<Length>,
    /// How far the measured value may be off, either way, in a unit of the same kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<Uncertainty>,
    /// Bibliography key, or a list of keys, of where the value was read.
    pub source: SourceKeys,
    /// Remarks on the value.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

/// How far a length or a speed may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Uncertainty {
    /// Of a length [m].
    Length(Length),
    /// Of a speed [m/s].
    Velocity(Velocity),
}

/// One bibliography key or several.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceKeys(pub Vec<String>);

/// Smallest and largest length that a measurement may have [m]: a crater can have no depth.
const MEASURED_LENGTH: Limits = Limits {
    min: 0.0,
    max: limits::LENGTH.max,
};

impl Experiment {
    /// What was measured, its key and its value in SI units; nothing unless just one quantity is given.
    pub fn measured(&self) -> Option<(BandQuantity, f64)> {
        match self.given().as_slice() {
            [(_, quantity, value)] => Some((*quantity, *value)),
            _ => None,
        }
    }

    fn given(&self) -> Vec<(&'static str, BandQuantity, f64)> {
        [
            (
                "depth_of_penetration",
                BandQuantity::DepthOfPenetration,
                self.depth_of_penetration.map(Length::si),
            ),
            (
                "residual_velocity",
                BandQuantity::ResidualVelocity,
                self.residual_velocity.map(Velocity::si),
            ),
            (
                "ballistic_limit",
                BandQuantity::BallisticLimit,
                self.ballistic_limit.map(Velocity::si),
            ),
            (
                "projectile_final_length",
                BandQuantity::ProjectileFinalLength,
                self.projectile_final_length.map(Length::si),
            ),
        ]
        .into_iter()
        .filter_map(|(key, quantity, value)| Some((key, quantity, value?)))
        .collect()
    }

    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, target: &Target) {
        let given = self.given();
        match given.as_slice() {
            [(key, quantity, value)] => self.check_quantity(check, target, key, *quantity, *value),
            [] => check.fail(
                "",
                "the experiment has no measured quantity",
                "give one of `depth_of_penetration`, `residual_velocity`, `ballistic_limit` and `projectile_final_length`",
            ),
            [_, (key, ..), ..] => check.fail(
                key,
                "the experiment has more than one measured quantity",
                "give every quantity an `[[experiments]]` entry of its own",
            ),
        }
        check.quantity(
            "impact_velocity",
            self.impact_velocity,
            limits::IMPACT_VELOCITY,
        );
        if self.source.0.iter().all(|key| key.trim().is_empty()) {
            check.fail(
                "source",
                "the experiment has no source",
                "name where the value was read, for example source = \"wilkins1973\"",
            );
        }
    }

    fn check_quantity(
        &self,
        check: &mut Check<'_>,
        target: &Target,
        key: &str,
        quantity: BandQuantity,
        value: f64,
    ) {
        let is_length = matches!(
            quantity,
            BandQuantity::DepthOfPenetration | BandQuantity::ProjectileFinalLength
        );
        if is_length {
            check.quantity(key, Length::new(value), MEASURED_LENGTH);
        } else {
            check.quantity(key, Velocity::new(value), limits::IMPACT_VELOCITY);
        }
        if self.impact_velocity.is_none() && quantity != BandQuantity::BallisticLimit {
            check.fail(
                key,
                format!(
                    "the measured {} has no impact velocity",
                    quantity.describe()
                ),
                "add `impact_velocity`, for example impact_velocity = \"230 m/s\"",
            );
        }
        if let Some(velocity) = self.impact_velocity
            && quantity == BandQuantity::ResidualVelocity
            && value > velocity.si()
        {
            check.fail(
                key,
                "the residual velocity is larger than the impact velocity",
                format!("the impact velocity is {velocity}"),
            );
        }
        let without = match quantity {
            BandQuantity::DepthOfPenetration => target.rigid_wall.then_some("a rigid wall"),
            BandQuantity::ResidualVelocity | BandQuantity::BallisticLimit => {
                target.without_back_in_words()
            }
            BandQuantity::ProjectileFinalLength => None,
        };
        if let Some(target) = without {
            check.fail(
                key,
                format!("{target} has no {}", quantity.describe()),
                "remove the entry, or describe the target that was struck",
            );
        }
        let fits = match self.uncertainty {
            None => true,
            Some(Uncertainty::Length(_)) => is_length,
            Some(Uncertainty::Velocity(_)) => !is_length,
        };
        if !fits {
            let (due, example) = match is_length {
                true => ("a length", "0.1 mm"),
                false => ("a speed", "10 m/s"),
            };
            check.fail(
                "uncertainty",
                format!(
                    "the uncertainty of a {} is {due}, not {}",
                    quantity.describe(),
                    if is_length { "a speed" } else { "a length" }
                ),
                format!("write it as {due}, for example uncertainty = \"{example}\""),
            );
        }
        match self.uncertainty {
            Some(Uncertainty::Length(length)) => {
                check.quantity("uncertainty", length, MEASURED_LENGTH);
            }
            Some(Uncertainty::Velocity(velocity)) => {
                check.quantity("uncertainty", velocity, limits::IMPACT_VELOCITY);
            }
            None => {}
        }
    }
}

impl Uncertainty {
    /// Its value in SI units.
    pub fn si(self) -> f64 {
        match self {
            Self::Length(length) => length.si(),
            Self::Velocity(velocity) => velocity.si(),
        }
    }
}

impl<'de> Deserialize<'de> for Uncertainty {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;

        impl de::Visitor<'_> for Visitor {
            type Value = Uncertainty;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a length such as \"0.1 mm\" or a speed such as \"10 m/s\"")
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Uncertainty, E> {
                if let Ok(velocity) = text.parse() {
                    return Ok(Uncertainty::Velocity(velocity));
                }
                text.parse().map(Uncertainty::Length).map_err(|error| {
                    E::custom(format!("{error}; or a speed, for example \"10 m/s\""))
                })
            }

            // A number without its unit is answered as it is everywhere else.
            fn visit_i64<E: de::Error>(self, number: i64) -> Result<Uncertainty, E> {
                self.visit_str(&number.to_string())
            }

            fn visit_f64<E: de::Error>(self, number: f64) -> Result<Uncertainty, E> {
                self.visit_str(&number.to_string())
            }
        }

        deserializer.deserialize_any(Visitor)
    }
}

impl Serialize for Uncertainty {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Length(length) => length.serialize(serializer),
            Self::Velocity(velocity) => velocity.serialize(serializer),
        }
    }
}

impl JsonSchema for Uncertainty {
    fn schema_name() -> Cow<'static, str> {
        "Uncertainty".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [generator.subschema_for::<Length>(), generator.subschema_for::<Velocity>()],
        })
    }
}

impl<'de> Deserialize<'de> for SourceKeys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;

        impl<'de> de::Visitor<'de> for Visitor {
            type Value = SourceKeys;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a bibliography key in quotes, or a list of keys")
            }

            fn visit_str<E: de::Error>(self, key: &str) -> Result<SourceKeys, E> {
                Ok(SourceKeys(vec![key.to_owned()]))
            }

            fn visit_seq<A: de::SeqAccess<'de>>(self, mut keys: A) -> Result<SourceKeys, A::Error> {
                let mut all = Vec::new();
                while let Some(key) = keys.next_element()? {
                    all.push(key);
                }
                Ok(SourceKeys(all))
            }
        }

        deserializer.deserialize_any(Visitor)
    }
}

impl Serialize for SourceKeys {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0.as_slice() {
            [key] => serializer.serialize_str(key),
            keys => keys.serialize(serializer),
        }
    }
}

impl JsonSchema for SourceKeys {
    fn schema_name() -> Cow<'static, str> {
        "SourceKeys".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [{ "type": "string" }, { "type": "array", "items": { "type": "string" }, "minItems": 1 }],
        })
    }
}
