//! Entries of a list of values: amounts, or the words and switches that an option of the case can be. The key decides which one a
//! quoted text is: names of materials can be digits.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use toml::Value;

use super::quantity_literal::{QuantityLiteral, QuantityLiteralVisitor};
use crate::units::{is_unit, split_number};

/// One of the values of a list.
#[derive(Debug, Clone, PartialEq)]
pub enum ListValue {
    /// A number, which may have a unit.
    QuantityLiteral(QuantityLiteral),
    /// A text, which can be a number with a unit, or `true` or `false`.
    Option(Value),
}

impl<'de> Deserialize<'de> for ListValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ListValueVisitor)
    }
}

struct ListValueVisitor;

impl de::Visitor<'_> for ListValueVisitor {
    type Value = ListValue;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a number, one with a unit in quotes such as \"230 m/s\", a word in quotes, true or false")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<ListValue, E> {
        QuantityLiteralVisitor
            .visit_f64(value)
            .map(ListValue::QuantityLiteral)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<ListValue, E> {
        QuantityLiteralVisitor
            .visit_i64(value)
            .map(ListValue::QuantityLiteral)
    }

    fn visit_bool<E: de::Error>(self, value: bool) -> Result<ListValue, E> {
        Ok(ListValue::Option(Value::Boolean(value)))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<ListValue, E> {
        Ok(ListValue::Option(Value::String(text.to_owned())))
    }
}

impl ListValue {
    /// The value of a key: a text that is meant as a number with a unit is one, unless the key takes names. Otherwise what is wrong with
    /// it and what to do.
    pub(super) fn of_key(&self, key: &str) -> Result<Self, (String, &'static str)> {
        match self {
            Self::Option(Value::String(text)) if !takes_name(key) && is_amount(text.trim()) => {
                QuantityLiteral::read(text).map(Self::QuantityLiteral)
            }
            other => Ok(other.clone()),
        }
    }
}

/// Whether a key of a case takes the name of a material, which can look like a number: `304`, `4340`.
fn takes_name(key: &str) -> bool {
    key == "projectile.material" || key.starts_with("target.") && key.ends_with(".material")
}

impl Serialize for ListValue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::QuantityLiteral(amount) => amount.serialize(serializer),
            Self::Option(value) => value.serialize(serializer),
        }
    }
}

impl JsonSchema for ListValue {
    fn schema_name() -> Cow<'static, str> {
        "ListValue".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                generator.subschema_for::<QuantityLiteral>(),
                { "type": "string" },
                { "type": "boolean" },
            ],
        })
    }
}

/// Whether a text is meant as a number with a unit: names of materials, such as `6061-t6-lesuer`, begin with digits too.
fn is_amount(text: &str) -> bool {
    split_number(text).is_some_and(|(_, unit)| {
        let apart = text
            .strip_suffix(unit)
            .is_some_and(|number| number.ends_with(char::is_whitespace));
        unit.is_empty() || apart || is_unit(unit)
    })
}
