//! Keys that take a number or one word.

use std::{borrow::Cow, fmt};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Factor on a target's flow stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ConstraintFactor {
    /// A number.
    Value(f64),
    /// Quasi-static spherical cavity expansion pressure over the yield stress, from the target's own strength law.
    CavityExpansion,
}

/// Strain at which an element erodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ErosionStrain {
    /// Magnitude of strain.
    At(f64),
    /// No erosion.
    Never,
}

/// A key that takes a number or one word.
pub(crate) trait NumberOrName: Sized {
    const WORD: &'static str;
    const EXPECTING: &'static str;
    fn from_number(number: f64) -> Self;
    fn from_word() -> Self;
    fn number(&self) -> Option<f64>;
}

impl NumberOrName for ConstraintFactor {
    const WORD: &'static str = "cavity-expansion";
    const EXPECTING: &'static str = "a number such as 2.7, or \"cavity-expansion\"";

    fn from_number(number: f64) -> Self {
        Self::Value(number)
    }

    fn from_word() -> Self {
        Self::CavityExpansion
    }

    fn number(&self) -> Option<f64> {
        match self {
            Self::Value(number) => Some(*number),
            Self::CavityExpansion => None,
        }
    }
}

impl NumberOrName for ErosionStrain {
    const WORD: &'static str = "never";
    const EXPECTING: &'static str = "a number such as 2.0, or \"never\"";

    fn from_number(number: f64) -> Self {
        Self::At(number)
    }

    fn from_word() -> Self {
        Self::Never
    }

    fn number(&self) -> Option<f64> {
        match self {
            Self::At(number) => Some(*number),
            Self::Never => None,
        }
    }
}

struct NumberOrNameVisitor<T>(std::marker::PhantomData<T>);

impl<T: NumberOrName> serde::de::Visitor<'_> for NumberOrNameVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(T::EXPECTING)
    }

    fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<T, E> {
        Ok(T::from_number(number))
    }

    fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<T, E> {
        Ok(T::from_number(number as f64))
    }

    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<T, E> {
        if word == T::WORD {
            Ok(T::from_word())
        } else {
            Err(E::custom(format!(
                "`{word}` is not understood here\nallowed: {}",
                T::EXPECTING
            )))
        }
    }
}

macro_rules! number_or_name {
    ($($name:ident),*) => {$(
        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(NumberOrNameVisitor(std::marker::PhantomData))
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                match self.number() {
                    Some(number) => serializer.serialize_f64(number),
                    None => serializer.serialize_str(Self::WORD),
                }
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({ "anyOf": [{ "type": "number" }, { "const": Self::WORD }] })
            }
        }
    )*};
}

number_or_name!(ConstraintFactor, ErosionStrain);
