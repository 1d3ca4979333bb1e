//! Entries of a list of values: amounts, or the words and switches that an option of the case can be.

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
    /// A text or `true` or `false`, for the case to say whether it can be that.
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
        match is_amount(text.trim()) {
            true => QuantityLiteralVisitor
                .visit_str(text)
                .map(ListValue::QuantityLiteral),
            false => Ok(ListValue::Option(Value::String(text.to_owned()))),
        }
    }
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
