//! Values of the option `--velocity`: one velocity, a list, an evenly spaced range, or the velocities of the experiments.

use std::str::FromStr;

use percuss::{
    Scenario,
    check::limits::IMPACT_VELOCITY,
    statistics::{evenly, sorted},
    units::{Dimension, OfVelocity, significant},
};

use crate::failure::Failure;

/// Impact velocities to compute.
#[derive(Debug, Clone, PartialEq)]
pub enum Speeds {
    /// Given velocities [m/s], in rising order.
    Given(Vec<f64>),
    /// Velocities of the experiments of the case.
    OfExperiments,
}

/// Largest number of velocities.
const MOST: usize = 1000;
const EXPERIMENTS: &str = "experiments";

/// Error in a list of velocities.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpeedsError {
    #[error("`{0}` is not a number\n{ALLOWED}")]
    NotANumber(String),
    #[error(
        "`{unit}` is not a unit of velocity: units are {}; one unit at the end applies to all numbers\n{ALLOWED}",
        units()
    )]
    UnknownUnit { unit: String },
    #[error("{} m/s is out of range: allowed are {} to {} m/s", significant(*.0, 6), IMPACT_VELOCITY.min, IMPACT_VELOCITY.max)]
    OutOfRange(f64),
    #[error("the range ends at {to}, which is not above its start at {from}\n{ALLOWED}")]
    NotRising { from: String, to: String },
    #[error("the range has no number of velocities\n{ALLOWED}")]
    NoCount,
    #[error("`{0}` is not a number of velocities: a range has 2 to {MOST}\n{ALLOWED}")]
    Count(String),
    #[error("{0} velocities are too many: at most {MOST}")]
    TooMany(usize),
}

const ALLOWED: &str = "allowed: FROM..TO:COUNT such as 200..1500:27 or \"0.2..1.5 km/s:27\", a list such as 200,300,400, \
                       one velocity, or the word experiments; in m/s unless a unit follows";

fn units() -> String {
    let symbols: Vec<&str> = OfVelocity::UNITS.iter().map(|unit| unit.symbol).collect();
    symbols.join(", ")
}

impl Speeds {
    /// Velocities for a case [m/s], in rising order.
    pub fn of(&self, scenario: &Scenario) -> Result<Vec<f64>, Failure> {
        let Self::Given(speeds) = self else {
            let measured = scenario.experiments.iter();
            let mut speeds = sorted(measured.filter_map(|m| m.impact_velocity));
            speeds.dedup();
            if speeds.is_empty() {
                return Err(Failure::Usage {
                    message: "the case has no experiments with a velocity".to_owned(),
                    help: "add `[[experiments]]` entries, or give velocities such as --velocity 200..1500:27"
                        .to_owned(),
                });
            }
            return Ok(speeds);
        };
        Ok(speeds.clone())
    }
}

impl FromStr for Speeds {
    type Err = SpeedsError;

    fn from_str(text: &str) -> Result<Self, SpeedsError> {
        let text = text.trim();
        if text == EXPERIMENTS {
            return Ok(Self::OfExperiments);
        }
        let mut speeds = match text.split_once("..") {
            Some((from, rest)) => range(from, rest)?,
            None => list(text)?,
        };
        if speeds.len() > MOST {
            return Err(SpeedsError::TooMany(speeds.len()));
        }
        let inside = IMPACT_VELOCITY.min..=IMPACT_VELOCITY.max;
        if let Some(&outside) = speeds.iter().find(|speed| !inside.contains(*speed)) {
            return Err(SpeedsError::OutOfRange(outside));
        }
        speeds.sort_by(f64::total_cmp);
        speeds.dedup();
        Ok(Self::Given(speeds))
    }
}

/// `FROM..TO:COUNT`, both ends included, evenly spaced.
fn range(from: &str, rest: &str) -> Result<Vec<f64>, SpeedsError> {
    let (to, count) = rest.split_once(':').ok_or(SpeedsError::NoCount)?;
    let (to, factor) = with_unit(to)?;
    let (first, last) = (number(from)? * factor, number(to)? * factor);
    if first >= last {
        return Err(SpeedsError::NotRising {
            from: from.trim().to_owned(),
            to: to.trim().to_owned(),
        });
    }
    let intervals = count
        .trim()
        .parse()
        .ok()
        .filter(|count| (2..=MOST as u32).contains(count))
        .map(|count| count - 1)
        .ok_or_else(|| SpeedsError::Count(count.trim().to_owned()))?;
    // The numbers of a sweep with `linear`: a column of velocities of one joins with that of the other.
    Ok(evenly(first, last, u64::from(intervals)).collect())
}

fn list(text: &str) -> Result<Vec<f64>, SpeedsError> {
    let (numbers, factor) = with_unit(text)?;
    numbers
        .split(',')
        .map(|text| Ok(number(text)? * factor))
        .collect()
}

/// Splits the unit from the end of a text; returns the rest and the factor of the unit.
fn with_unit(text: &str) -> Result<(&str, f64), SpeedsError> {
    let text = text.trim();
    // A unit starts with a letter after the last digit, comma or point; the `e` of an exponent has digits after it.
    let end = text
        .rfind(|c: char| c.is_ascii_digit() || ",.".contains(c))
        .map_or(0, |at| at + 1);
    let (numbers, unit) = (&text[..end], text[end..].trim());
    if unit.is_empty() {
        return Ok((numbers, 1.0));
    }
    if numbers.is_empty() {
        return Err(SpeedsError::NotANumber(text.to_owned()));
    }
    OfVelocity::UNITS
        .iter()
        .find(|known| known.symbol == unit || known.aliases.contains(&unit))
        .map(|known| (numbers, known.factor))
        .ok_or_else(|| SpeedsError::UnknownUnit {
            unit: unit.to_owned(),
        })
}

fn number(text: &str) -> Result<f64, SpeedsError> {
    let text = text.trim();
    text.parse()
        .ok()
        .filter(|number: &f64| number.is_finite())
        .ok_or_else(|| SpeedsError::NotANumber(text.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn speeds(text: &str) -> Vec<f64> {
        match text.parse() {
            Ok(Speeds::Given(speeds)) => speeds,
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn ranges_lists_and_units_are_read() {
        let range = speeds("200..1500:27");
        assert_eq!(
            (range.len(), range[0], range[1], range[26]),
            (27, 200.0, 250.0, 1500.0)
        );
        assert_eq!(speeds("230"), [230.0]);
        assert_eq!(speeds(" 400, 200,300 ,200"), [200.0, 300.0, 400.0]);
        assert_eq!(
            speeds("0.25..1.5 km/s:6"),
            [250.0, 500.0, 750.0, 1000.0, 1250.0, 1500.0]
        );
        assert_eq!(speeds("0.25,1 km/s"), [250.0, 1000.0]);
        assert_eq!(speeds("1e3 ft/s"), [304.8]);
        assert_eq!(speeds("2e2m/s"), [200.0]);
        assert_eq!(speeds("0..1:2"), [0.0, 1.0]);
        assert_eq!("experiments".parse(), Ok(Speeds::OfExperiments));
    }

    #[test]
    fn what_is_wrong_has_its_own_error() {
        let error = |text: &str| text.parse::<Speeds>().unwrap_err();
        let not_a_number = |text: &str| SpeedsError::NotANumber(text.to_owned());
        assert_eq!(error(""), not_a_number(""));
        assert_eq!(error("fast"), not_a_number("fast"));
        assert_eq!(error("200,,300"), not_a_number(""));
        assert_eq!(error("..300:3"), not_a_number(""));
        assert_eq!(error("200 m/s..300:3"), not_a_number("200 m/s"));
        assert_eq!(error("200..300"), SpeedsError::NoCount);
        assert_eq!(error("200..300:1"), SpeedsError::Count("1".to_owned()));
        assert_eq!(error("200..300:2.5"), SpeedsError::Count("2.5".to_owned()));
        assert_eq!(
            error("200..300:9999"),
            SpeedsError::Count("9999".to_owned())
        );
        assert!(matches!(error("300..200:3"), SpeedsError::NotRising { .. }));
        assert!(matches!(error("300..300:3"), SpeedsError::NotRising { .. }));
        assert_eq!(
            error("200 knots"),
            SpeedsError::UnknownUnit {
                unit: "knots".to_owned()
            }
        );
        assert_eq!(error("20 km/s"), SpeedsError::OutOfRange(20_000.0));
        assert_eq!(error("-5"), SpeedsError::OutOfRange(-5.0));
        assert_eq!(error("1e999"), not_a_number("1e999"));
        assert!(error("200..300").to_string().contains("200..1500:27"));
        assert!(
            error("200 knots")
                .to_string()
                .contains("m/s, km/s, km/h, ft/s")
        );
    }
}
