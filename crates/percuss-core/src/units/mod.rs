//! Quantities with units: `"850 m/s"` in a file, `f64` in SI units inside.
//!
//! A [`Quantity`] carries its dimension in its type, so a mass cannot be read where a length is due.
//!
//! ```
//! use percuss::units::{Length, Velocity};
//! let diameter: Length = "4.8 mm".parse().unwrap();
//! assert!((diameter.si() - 4.8e-3).abs() < 1e-18);
//! let error = "4.8 kg".parse::<Length>().unwrap_err();
//! assert!(error.to_string().contains("`kg` is a unit of mass"));
//! assert_eq!(Velocity::new(230.0).to_string(), "230 m/s");
//! ```

mod column_name;
mod dimension;
mod result_unit;
mod system;
#[cfg(test)]
mod tests;

use std::{borrow::Cow, fmt, marker::PhantomData, str::FromStr};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

pub use column_name::{ColumnName, ColumnUnit, column_symbols, plain_name};
pub use dimension::*;
pub use result_unit::ResultUnit;
pub use system::UnitSystem;

use crate::error::nearest;

/// A number with a physical dimension, held in SI units.
pub struct Quantity<D> {
    si: f64,
    dimension: PhantomData<fn() -> D>,
}

impl<D: Dimension> Quantity<D> {
    /// Wraps a value given in SI units.
    pub const fn new(si: f64) -> Self {
        Self {
            si,
            dimension: PhantomData,
        }
    }

    /// The value in SI units.
    pub const fn si(self) -> f64 {
        self.si
    }
}

impl<D> Clone for Quantity<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Quantity<D> {}

impl<D> PartialEq for Quantity<D> {
    fn eq(&self, other: &Self) -> bool {
        self.si == other.si
    }
}

/// Writes the value in SI units with all its digits.
impl<D: Dimension> fmt::Debug for Quantity<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.si, f)
    }
}

/// Writes the value in the unit of its dimension that reads best, to six significant digits.
impl<D: Dimension> fmt::Display for Quantity<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&display::<D>(self.si))
    }
}

/// Writes an SI value in the unit of its dimension that reads best, to six significant digits.
pub fn display<D: Dimension>(si: f64) -> String {
    let unit = D::DISPLAY
        .iter()
        .filter_map(|symbol| D::UNITS.iter().find(|unit| unit.symbol == *symbol))
        .find(|unit| (si / unit.factor).abs() >= 1.0)
        .or_else(|| {
            let smallest = if si == 0.0 {
                D::DISPLAY.first()
            } else {
                D::DISPLAY.last()
            };
            D::UNITS.iter().find(|unit| Some(&unit.symbol) == smallest)
        });
    match unit {
        Some(unit) => format!(
            "{} {}",
            significant((si - unit.offset) / unit.factor, 6),
            unit.symbol
        ),
        None => significant(si, 6),
    }
}

/// Writes an SI value so that it reads back unchanged except for rounding, with six significant digits where they suffice.
pub(crate) fn written<D: Dimension>(si: f64) -> String {
    let short = display::<D>(si);
    let same = |text: &str| {
        text.parse::<Quantity<D>>()
            .is_ok_and(|read| (read.si - si).abs() <= 4.0 * f64::EPSILON * si.abs())
    };
    if same(&short) {
        return short;
    }
    let unit = short.split_once(' ').and_then(|(_, symbol)| {
        let mut units = D::UNITS.iter();
        units.find(|unit| unit.symbol == symbol)
    });
    unit.map_or(short, |unit| {
        format!("{:?} {}", (si - unit.offset) / unit.factor, unit.symbol)
    })
}

/// Writes a number with at most `digits` significant digits and no trailing zeros.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{}", value + 0.0);
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-4..9).contains(&magnitude) {
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return if mantissa.contains('.') {
            format!(
                "{}e{exponent}",
                mantissa.trim_end_matches('0').trim_end_matches('.')
            )
        } else {
            text.clone()
        };
    }
    let decimals = (digits as i32 - 1 - magnitude).max(0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// A quantity of one unit of every dimension, as a file would have it.
pub(crate) fn one_of_each() -> impl Iterator<Item = String> {
    let symbols = ALL_DIMENSIONS.iter().filter_map(|of| of.units.first());
    symbols.map(|unit| format!("1 {}", unit.symbol))
}

/// Why a text is no quantity of the dimension that was due.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum QuantityError {
    /// The text does not start with a number.
    #[error("`{text}` is not a number with a unit\n{expected}")]
    NoNumber {
        /// The text found.
        text: String,
        /// What is due, with an example and the units allowed.
        expected: String,
    },
    /// The number is infinite, or too large or too small for a 64-bit float.
    #[error("`{text}` is beyond the range of 64-bit floats\n{expected}")]
    NotFinite {
        /// The text found.
        text: String,
        /// What is due, with an example and the units allowed.
        expected: String,
    },
    /// A comma instead of the decimal point, or between thousands.
    #[error(
        "the number of `{text}` has a comma\nwrite a decimal point, and nothing between thousands; {expected}"
    )]
    Comma {
        /// The text found.
        text: String,
        /// What is due, with an example and the units allowed.
        expected: String,
    },
    /// A number without its unit.
    #[error("the unit is missing after `{text}`\n{expected}")]
    NoUnit {
        /// The text found.
        text: String,
        /// What is due, with an example and the units allowed.
        expected: String,
    },
    /// A unit that belongs to another dimension.
    #[error("`{unit}` is a unit of {found}, but {due} is due here\n{expected}")]
    WrongDimension {
        /// The unit found.
        unit: String,
        /// The dimension it belongs to.
        found: &'static str,
        /// The dimension that is due.
        due: &'static str,
        /// What is due, with an example and the units allowed.
        expected: String,
    },
    /// An unknown unit.
    #[error("`{unit}` is not a known unit\n{expected}")]
    UnknownUnit {
        /// The unit found.
        unit: String,
        /// What is due, with an example and the units allowed.
        expected: String,
    },
}

fn expected<D: Dimension>() -> String {
    let units: Vec<&str> = D::UNITS.iter().map(|unit| unit.symbol).collect();
    format!(
        "write {} as a quoted number with a unit, for example \"{}\"; units: {}",
        D::ARTICLE_NAME,
        D::EXAMPLE,
        units.join(", ")
    )
}

/// Splits `"4.8 mm"` into its number and its unit.
pub fn split_number(text: &str) -> Option<(f64, &str)> {
    let end = text
        .find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)))
        .unwrap_or(text.len());
    // Shorten until it reads as a number, so that the `e` of an unknown unit such as `3 ells` is not taken for an exponent.
    (1..=end)
        .rev()
        .filter(|&cut| text.is_char_boundary(cut))
        .find_map(|cut| {
            let number = text[..cut].parse::<f64>().ok()?;
            Some((number, text[cut..].trim()))
        })
}

/// Whether a number that is written with digits other than 0 is too small for a 64-bit float.
fn is_lost(written: &str, number: f64) -> bool {
    let mut digits = written.chars().take_while(|c| !"eE".contains(*c));
    number == 0.0 && digits.any(|c| ('1'..='9').contains(&c))
}

/// The units of the dimension whose definition has this name in the schema of case files, such as `Length`.
pub fn units_of(type_name: &str) -> Option<&'static [Unit]> {
    let mut dimensions = ALL_DIMENSIONS.iter();
    let found = dimensions.find(|dimension| dimension.type_name == type_name);
    found.map(|dimension| dimension.units)
}

/// Brings the many ways to write a unit to one: `kg/m³` and `kg/m^3` to `kg/m3`, `μs` to `us`.
fn normalise(unit: &str) -> String {
    unit.chars()
        .filter_map(|c| match c {
            '³' => Some('3'),
            '²' => Some('2'),
            '^' => None,
            'µ' | 'μ' => Some('u'),
            '·' | '*' => Some(' '),
            other => Some(other),
        })
        .collect::<String>()
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

/// Whether a text is a unit of any dimension.
pub fn is_unit(text: &str) -> bool {
    let name = normalise(text);
    ALL_DIMENSIONS
        .iter()
        .any(|dimension| find_unit(dimension.units, &name).is_some())
}

fn find_unit(units: &'static [Unit], name: &str) -> Option<&'static Unit> {
    units
        .iter()
        .find(|unit| unit.symbol == name || unit.aliases.contains(&name))
}

/// Asks whether a unit that differs in case only, or a little, is meant.
fn nearest_unit(units: &'static [Unit], name: &str) -> String {
    let symbols = || units.iter().map(|unit| unit.symbol);
    symbols()
        .find(|symbol| symbol.eq_ignore_ascii_case(name))
        .map(str::to_owned)
        // Of a unit of one or two letters everything is a neighbour.
        .or_else(|| {
            (name.chars().count() > 2)
                .then(|| nearest(name, symbols()))
                .flatten()
        })
        .map_or_else(String::new, |symbol| format!("did you mean `{symbol}`? "))
}

impl<D: Dimension> FromStr for Quantity<D> {
    type Err = QuantityError;

    fn from_str(text: &str) -> Result<Self, QuantityError> {
        let text = text.trim();
        let Some((number, unit)) = split_number(text) else {
            return Err(QuantityError::NoNumber {
                text: shorten(text),
                expected: expected::<D>(),
            });
        };
        let written = text.strip_suffix(unit).unwrap_or(text);
        if unit.is_empty() {
            return Err(QuantityError::NoUnit {
                text: shorten(text),
                expected: expected::<D>(),
            });
        }
        if unit.starts_with(',') {
            return Err(QuantityError::Comma {
                text: shorten(text),
                expected: expected::<D>(),
            });
        }
        let name = normalise(unit);
        let Some(unit) = find_unit(D::UNITS, &name) else {
            let other = ALL_DIMENSIONS
                .iter()
                .find(|dimension| find_unit(dimension.units, &name).is_some());
            return Err(match other {
                Some(other) => QuantityError::WrongDimension {
                    unit: shorten(unit),
                    found: other.name,
                    due: D::ARTICLE_NAME,
                    expected: expected::<D>(),
                },
                None => QuantityError::UnknownUnit {
                    unit: shorten(unit),
                    expected: nearest_unit(D::UNITS, &name) + &expected::<D>(),
                },
            });
        };
        let si = number * unit.factor + unit.offset;
        if !si.is_finite() || is_lost(written, number) {
            return Err(QuantityError::NotFinite {
                text: shorten(text),
                expected: expected::<D>(),
            });
        }
        Ok(Self::new(si))
    }
}

/// Cuts a text that is quoted in a message to 40 characters.
pub fn shorten(text: &str) -> String {
    if text.chars().count() <= 40 {
        text.to_owned()
    } else {
        text.chars().take(39).chain(['…']).collect()
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Quantity<D> {
    fn deserialize<De: Deserializer<'de>>(deserializer: De) -> Result<Self, De::Error> {
        struct Visitor<D>(PhantomData<D>);

        impl<D: Dimension> serde::de::Visitor<'_> for Visitor<D> {
            type Value = Quantity<D>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{} such as \"{}\"", D::ARTICLE_NAME, D::EXAMPLE)
            }

            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Self::Value, E> {
                text.parse().map_err(E::custom)
            }

            fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<Self::Value, E> {
                Err(E::custom(QuantityError::NoUnit {
                    text: format!("{value}"),
                    expected: expected::<D>(),
                }))
            }

            fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<Self::Value, E> {
                Err(E::custom(QuantityError::NoUnit {
                    text: format!("{value}"),
                    expected: expected::<D>(),
                }))
            }
        }

        deserializer.deserialize_any(Visitor(PhantomData))
    }
}

impl<D: Dimension> Serialize for Quantity<D> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&written::<D>(self.si))
    }
}

impl<D: Dimension> JsonSchema for Quantity<D> {
    fn schema_name() -> Cow<'static, str> {
        D::TYPE_NAME.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let units: Vec<String> = D::UNITS
            .iter()
            .flat_map(|unit| std::iter::once(&unit.symbol).chain(unit.aliases))
            .map(|symbol| {
                symbol
                    .replace('.', "\\.")
                    .replace('(', "\\(")
                    .replace(')', "\\)")
                    .replace('2', "(\\^?2|²)")
                    .replace('3', "(\\^?3|³)")
                    .replace("us", "[uµμ]s")
                    .replace("um", "[uµμ]m")
            })
            .collect();
        let pattern = format!(
            r"^\s*[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?\s*({})\s*$",
            units.join("|")
        );
        let description = format!(
            "{} as a number with a unit; units: {}",
            D::ARTICLE_NAME,
            D::UNITS
                .iter()
                .map(|unit| unit.symbol)
                .collect::<Vec<_>>()
                .join(", ")
        );
        json_schema!({
            "type": "string",
            "description": description,
            "pattern": pattern,
            "examples": [D::EXAMPLE],
        })
    }
}
