//! Fitted parameter: a number of the cases by its dotted key, with its prior.

use std::path::Path;

use serde::Deserialize;
use toml::Value;

use super::least_squares::Bounds;
use crate::{
    case::{Document, Template},
    check::{Check, Diagnostic},
    error::{Error, InputError, Subject},
    sweep::{Axis, Design, Distribution, Parameter, QuantityLiteral, Uniform, Values},
    units::split_number,
};

const EXAMPLE: &str = "write KEY=LOW..HIGH with the unit behind it, such as \
                       materials.copper.strength.power_law.coefficient=100..900 MPa, or name a TOML file of [[parameter]] tables";

/// A number to fit with its prior distribution.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    pub(super) axis: Axis,
    pub(super) prior: Distribution,
    /// Where it is written, for errors that only a case can find.
    place: Place,
}

#[derive(Debug, Clone, PartialEq)]
struct Place {
    document: Document,
    /// Dotted key of the parameter in the file; empty when the text is the parameter.
    table: String,
}

/// A file of parameters.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FitFile {
    #[serde(default)]
    parameter: Vec<Parameter>,
}

impl Fitted {
    /// Reads `KEY=LOW..HIGH UNIT`, evenly likely in between, or a TOML file whose `[[parameter]]` tables have a `key` and one of
    /// `uniform`, `normal`, `lognormal` and `triangular` as those of a sweep.
    ///
    /// # Errors
    /// [`Error::Input`] with the place; [`Error::Read`].
    pub fn read(text: &str) -> Result<Vec<Self>, Error> {
        Self::read_with(text, Document::read)
    }

    /// The same with another way to come by the file.
    ///
    /// # Errors
    /// As [`Fitted::read`].
    pub fn read_with<'a>(
        text: &'a str,
        open: impl FnOnce(&'a Path) -> Result<Document, Error>,
    ) -> Result<Vec<Self>, Error> {
        if text.contains('=') {
            return Ok(vec![Self::inline(text)?]);
        }
        if !text.ends_with(".toml") {
            return Err(inline_error(text, text, "there is no `=` after the key", EXAMPLE).into());
        }
        Self::file(&open(Path::new(text))?)
    }

    fn inline(text: &str) -> Result<Self, Error> {
        let refuse = |part: &str, message: &str, help: &str| {
            Err(inline_error(text, part, message, help).into())
        };
        let Some((key, range)) = text.split_once('=') else {
            return refuse(text, "there is no `=` after the key", EXAMPLE);
        };
        let key = key.trim();
        if key.is_empty() {
            return refuse(text, "the key is missing", EXAMPLE);
        }
        let Some((low, high)) = range.split_once("..") else {
            return refuse(range, "it is no range", EXAMPLE);
        };
        let (Some((low, first)), Some((high, unit))) =
            (split_number(low.trim()), split_number(high.trim()))
        else {
            return refuse(range, "an end of the range is no number", EXAMPLE);
        };
        if !first.is_empty() && first != unit {
            return refuse(
                range,
                "the ends of the range have two units",
                "write it once, behind the range",
            );
        }
        if !(low.is_finite() && high.is_finite()) {
            return refuse(range, "an end of the range is not finite", EXAMPLE);
        }
        let amount = |value: f64| QuantityLiteral {
            value,
            unit: unit.to_owned(),
            whole: false,
        };
        let parameter = Parameter {
            key: key.to_owned(),
            uniform: Some(Uniform {
                from: amount(low),
                to: amount(high),
            }),
            values: None,
            linear: None,
            log: None,
            normal: None,
            lognormal: None,
            triangular: None,
        };
        let place = Place {
            document: Document::new("--fit", text),
            table: String::new(),
        };
        Self::of(&parameter, place)
    }

    fn file(document: &Document) -> Result<Vec<Self>, Error> {
        let file: FitFile = document.parse()?;
        if file.parameter.is_empty() {
            let help =
                "write a [[parameter]] table with key and uniform, normal, lognormal or triangular";
            let diagnostic = Diagnostic::whole("the file names nothing to fit", help);
            return Err(document.place(diagnostic).into());
        }
        let of = |(i, parameter): (usize, &Parameter)| {
            let place = Place {
                document: document.clone(),
                table: format!("parameter.{i}"),
            };
            Self::of(parameter, place)
        };
        file.parameter.iter().enumerate().map(of).collect()
    }

    fn of(parameter: &Parameter, place: Place) -> Result<Self, Error> {
        let mut diagnostics = Vec::new();
        let mut check = Check::new(&mut diagnostics);
        let axis = parameter.resolve(&mut check, Design::LatinHypercube);
        if let Some(Axis {
            values: Values::List(_),
            ..
        }) = &axis
        {
            check.fail(
                "",
                format!("`{}` has a list of values", parameter.key),
                "what is fitted has a prior: give uniform, normal, lognormal or triangular",
            );
        }
        let axis = match (diagnostics.into_iter().next(), axis) {
            (None, Some(axis)) => axis,
            (diagnostic, _) => return Err(place.error(diagnostic, &parameter.key).into()),
        };
        let Values::Distribution(prior) = axis.values.clone() else {
            return Err(place.error(None, &parameter.key).into());
        };
        Ok(Self { axis, prior, place })
    }

    /// Dotted key of the number.
    pub fn key(&self) -> &str {
        &self.axis.key
    }

    /// Unit of its values; empty for plain numbers.
    pub fn unit(&self) -> &str {
        &self.axis.unit
    }

    /// Value that the number is below with a probability of `u` before anything was measured.
    pub(super) fn quantile(&self, u: f64) -> f64 {
        self.prior.quantile(u)
    }

    /// Half of the range that holds 68 % beforehand: the standard deviation of a normal distribution.
    pub(super) fn prior_deviation(&self) -> f64 {
        half_of_68(|u| self.quantile(u))
    }

    pub(super) fn bounds(&self) -> Bounds {
        let (low, high) = self.prior.support();
        Bounds { low, high }
    }

    /// Id of the material whose constant it is, and the key within its record.
    pub(super) fn material(&self) -> Option<(&str, &str)> {
        self.axis.key.strip_prefix("materials.")?.split_once('.')
    }

    /// A value as a case has it.
    pub(super) fn change(&self, value: f64) -> (&str, Value) {
        (&self.axis.key, self.axis.written(value))
    }

    /// Makes sure that a case can have the ends of its range.
    pub(super) fn check(&self, template: &Template) -> Result<(), Error> {
        for (written_at, value) in &self.axis.samples {
            let (key, written) = self.change(*value);
            let Err(diagnostics) = template.scenario(&[(key, written.clone())]) else {
                continue;
            };
            let diagnostic = diagnostics.into_iter().next().map(|diagnostic| {
                let of = match diagnostic.key.as_str() {
                    "" => key,
                    found => found,
                };
                Diagnostic {
                    message: format!(
                        "with {key} = {written} the case `{}` is not valid: `{of}`: {}",
                        template.name(),
                        diagnostic.message
                    ),
                    key: written_at.clone(),
                    ..diagnostic
                }
            });
            return Err(self.place.error(diagnostic, key).into());
        }
        Ok(())
    }

    /// An error at the place where the number is written.
    pub(super) fn error(&self, message: &str, help: &str) -> Error {
        let diagnostic = Diagnostic::at("key", message, help);
        self.place.error(Some(diagnostic), self.key()).into()
    }

    /// An error at its key, which names a material that does not exist.
    pub(super) fn no_material(&self, message: &str, help: &str) -> Error {
        let diagnostic = Diagnostic::at("key", message, help).of_material();
        self.place.error(Some(diagnostic), self.key()).into()
    }
}

impl Place {
    fn error(&self, diagnostic: Option<Diagnostic>, key: &str) -> InputError {
        let diagnostic =
            diagnostic.unwrap_or_else(|| Diagnostic::whole("it cannot be fitted", EXAMPLE));
        if self.table.is_empty() {
            let text = self.document.text();
            let part = match diagnostic.key.as_str() {
                "key" | "" => key,
                _ => text.split_once('=').map_or("", |(_, range)| range),
            };
            return InputError {
                subject: diagnostic.subject,
                ..inline_error(text, part, &diagnostic.message, &diagnostic.help)
            };
        }
        let key = [self.table.as_str(), diagnostic.key.as_str()].join(".");
        self.document.place(Diagnostic {
            key: key.trim_end_matches('.').to_owned(),
            ..diagnostic
        })
    }
}

/// Half of the range that holds 68 %, given the quantiles: the standard deviation of a normal distribution.
pub(super) fn half_of_68(quantile: impl Fn(f64) -> f64) -> f64 {
    const ONE_BELOW: f64 = 0.158_655_253_931_457_05;
    0.5 * (quantile(1.0 - ONE_BELOW) - quantile(ONE_BELOW))
}

/// An error that points at a part of what was given on the command line.
fn inline_error(text: &str, part: &str, message: &str, help: &str) -> InputError {
    let start = text.find(part).unwrap_or(0);
    InputError {
        subject: Subject::Case,
        file: "--fit".to_owned(),
        text: text.to_owned(),
        span: start..start + part.len(),
        key: String::new(),
        message: message.to_owned(),
        help: help.to_owned(),
    }
}
