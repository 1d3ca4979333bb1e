//! Numbers of a sweep: plain ones, or with a unit.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::units::{shorten, split_number};

/// A number, or a number with a unit in quotes. Whether the unit fits is for the case to say.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantityLiteral {
    /// The number.
    pub value: f64,
    /// Its unit; empty when it has none.
    pub unit: String,
    /// Whether it is written as a whole number.
    pub whole: bool,
}

impl<'de> Deserialize<'de> for QuantityLiteral {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(QuantityLiteralVisitor)
    }
}

pub(crate) struct QuantityLiteralVisitor;

impl serde::de::Visitor<'_> for QuantityLiteralVisitor {
    type Value = QuantityLiteral;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a number, or one with a unit in quotes such as \"230 m/s\"")
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<QuantityLiteral, E> {
        if !value.is_finite() {
            return Err(E::custom("the number is not finite\nwrite a finite number"));
        }
        Ok(QuantityLiteral {
            value,
            unit: String::new(),
            whole: false,
        })
    }

    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<QuantityLiteral, E> {
        Ok(QuantityLiteral {
            value: value as f64,
            unit: String::new(),
            // Beyond, a float would stand for a neighbour as well.
            whole: value.unsigned_abs() <= 1 << 53,
        })
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<QuantityLiteral, E> {
        QuantityLiteral::read(text)
            .map_err(|(message, help)| E::custom(format!("{message}\n{help}")))
    }
}

impl QuantityLiteral {
    /// The number and the unit of a quoted text; otherwise what is wrong with it and what to do.
    pub(super) fn read(text: &str) -> Result<Self, (String, &'static str)> {
        let bad = |what: &str| {
            let help = "write a number with a unit, such as \"230 m/s\", or without quotes one that has none";
            Err((format!("`{}` {what}", shorten(text)), help))
        };
        match split_number(text.trim()) {
            Some((value, _)) if !value.is_finite() => bad("is not a finite number"),
            Some((_, "")) => bad("has no unit"),
            Some((value, unit)) => Ok(Self {
                value,
                unit: unit.to_owned(),
                whole: false,
            }),
            None => bad("is no number"),
        }
    }

    /// It as a case file has it; a float's text reads back as the same number.
    pub(crate) fn written(value: f64, unit: &str, whole: bool) -> toml::Value {
        if !unit.is_empty() {
            toml::Value::String(format!("{value:?} {unit}"))
        } else if whole {
            toml::Value::Integer(value as i64)
        } else {
            toml::Value::Float(value)
        }
    }
}

impl Serialize for QuantityLiteral {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Self::written(self.value, &self.unit, self.whole).serialize(serializer)
    }
}

impl JsonSchema for QuantityLiteral {
    fn schema_name() -> Cow<'static, str> {
        "QuantityLiteral".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "a number, or one with a unit in quotes such as \"230 m/s\"",
            "anyOf": [
                { "type": "number" },
                { "type": "string", "pattern": r"^\s*[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?\s*\S.*$" },
            ],
        })
    }
}
