//! Entries of a list of values: amounts, or the words and switches that an option of the case can be.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use toml::Value;

use super::amount::{Amount, AmountVisitor};
use crate::units::{is_unit, split_number};

/// One of the values of a list.
#[derive(Debug, Clone, PartialEq)]
pub enum Entry {
    /// A number, which may have a unit.
    Amount(Amount),
    /// A text or `true` or `false`, for the case to say whether it can be that.
    Option(Value),
}

impl<'de> Deserialize<'de> for Entry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EntryVisitor)
    }
}

struct EntryVisitor;

impl de::Visitor<'_> for EntryVisitor {
    type Value = Entry;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a number, one with a unit in quotes such as \"230 m/s\", a word in quotes, true or false")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Entry, E> {
        AmountVisitor.visit_f64(value).map(Entry::Amount)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Entry, E> {
        AmountVisitor.visit_i64(value).map(Entry::Amount)
    }

    fn visit_bool<E: de::Error>(self, value: bool) -> Result<Entry, E> {
        Ok(Entry::Option(Value::Boolean(value)))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Entry, E> {
        match is_amount(text.trim()) {
            true => AmountVisitor.visit_str(text).map(Entry::Amount),
            false => Ok(Entry::Option(Value::String(text.to_owned()))),
        }
    }
}

impl Serialize for Entry {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Amount(amount) => amount.serialize(serializer),
            Self::Option(value) => value.serialize(serializer),
        }
    }
}

impl JsonSchema for Entry {
    fn schema_name() -> Cow<'static, str> {
        "Entry".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                generator.subschema_for::<Amount>(),
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
