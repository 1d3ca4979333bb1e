//! Values of the options `--velocity`, `--tolerance`, `--span` and `--points`.

use std::str::FromStr;

use percuss::{
    check::limits::IMPACT_VELOCITY,
    limit::{Range, Tolerance},
    units::{QuantityError, Velocity, significant},
};

const RANGE: &str =
    "allowed: FROM..TO such as 100..400 or \"0.1..0.4 km/s\", in m/s unless a unit follows";
const TOLERANCE: &str =
    "allowed: a speed such as \"0.5 m/s\", or a percentage of the limit such as \"0.2 %\"";
/// Largest number of residual velocities.
const MOST_POINTS: u16 = 200;

/// Error in a value of the command line.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ValueError {
    #[error("`{0}` is not a range\n{RANGE}")]
    NoRange(String),
    #[error("{0}\n{RANGE}")]
    Speed(QuantityError),
    #[error("the range ends at {to}, which is not above its start at {from}\n{RANGE}")]
    NotRising { from: String, to: String },
    #[error("{0} is out of range: allowed are {min} to {max} m/s", min = IMPACT_VELOCITY.min, max = IMPACT_VELOCITY.max)]
    OutOfRange(Velocity),
    #[error("{0}\n{TOLERANCE}")]
    Tolerance(QuantityError),
    #[error("`{0}` is not a percentage\n{TOLERANCE}")]
    Part(String),
    #[error("{0}\nallowed: a speed such as \"38 m/s\"")]
    Span(QuantityError),
    #[error("{0} is out of range: allowed are 1e-6 to 1000 m/s")]
    LongSpan(String),
    #[error("`{0}` is not a number of points\nallowed: a whole number from 0 to {MOST_POINTS}")]
    Points(String),
    #[error("{0} is out of range: allowed are 1e-6 to 1000 m/s, or 1e-6 to 50 %")]
    Width(String),
}

/// Reads `FROM..TO`; a unit at the end applies to both where the first has none of its own.
pub fn range(text: &str) -> Result<Range, ValueError> {
    let ends = text.split_once("..").filter(|(_, to)| !to.starts_with('.'));
    let (from, to) = ends.ok_or_else(|| ValueError::NoRange(text.to_owned()))?;
    let (from, to) = (from.trim(), to.trim());
    let unit = match unit_of(to) {
        "" => "m/s",
        unit => unit,
    };
    let speed = |end: &str| -> Result<f64, ValueError> {
        let speed = match unit_of(end) {
            "" => Velocity::from_str(&format!("{end} {unit}")),
            _ => Velocity::from_str(end),
        };
        let speed = speed.map_err(ValueError::Speed)?;
        match IMPACT_VELOCITY.allow(speed.si()) {
            true => Ok(speed.si()),
            false => Err(ValueError::OutOfRange(speed)),
        }
    };
    let range = Range {
        from: speed(from)?,
        to: speed(to)?,
    };
    match range.from < range.to {
        true => Ok(range),
        false => Err(ValueError::NotRising {
            from: from.to_owned(),
            to: to.to_owned(),
        }),
    }
}

/// Text after the last digit of a number.
fn unit_of(text: &str) -> &str {
    let end = text.rfind(|c: char| c.is_ascii_digit() || c == '.');
    end.map_or("", |at| text[at + 1..].trim())
}

/// Reads a velocity with its unit, or a percentage.
pub fn tolerance(text: &str) -> Result<Tolerance, ValueError> {
    let outside = || ValueError::Width(text.trim().to_owned());
    if let Some(number) = text.trim().strip_suffix('%') {
        let part = number.trim().parse::<f64>();
        let part = part.map_err(|_| ValueError::Part(text.to_owned()))? / 100.0;
        return match Tolerance::PARTS.contains(&part) {
            true => Ok(Tolerance::Relative(part)),
            false => Err(outside()),
        };
    }
    let width = Velocity::from_str(text)
        .map_err(ValueError::Tolerance)?
        .si();
    match Tolerance::WIDTHS.contains(&width) {
        true => Ok(Tolerance::Absolute(width)),
        false => Err(outside()),
    }
}

/// Reads a velocity span with its unit.
pub fn span(text: &str) -> Result<f64, ValueError> {
    let span = Velocity::from_str(text).map_err(ValueError::Span)?.si();
    match Tolerance::WIDTHS.contains(&span) {
        true => Ok(span),
        false => Err(ValueError::LongSpan(text.trim().to_owned())),
    }
}

/// Reads a number of residual velocities.
pub fn points(text: &str) -> Result<u16, ValueError> {
    let count = text.trim().parse().ok();
    count
        .filter(|count| *count <= MOST_POINTS)
        .ok_or_else(|| ValueError::Points(text.to_owned()))
}

/// Tolerance as text, as the option takes it.
pub fn describe(tolerance: Tolerance) -> String {
    match tolerance {
        Tolerance::Absolute(width) => format!("{} m/s", significant(width, 4)),
        Tolerance::Relative(part) => format!("{} %", significant(100.0 * part, 4)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_and_units_are_read() {
        let ends = |text| range(text).map(|range| (range.from, range.to)).unwrap();
        assert_eq!(ends("100..400"), (100.0, 400.0));
        assert_eq!(ends(" 0 .. 1.5 km/s"), (0.0, 1500.0));
        assert_eq!(ends("100 m/s..400 m/s"), (100.0, 400.0));
        assert_eq!(ends("1e2..4e2 m/s"), (100.0, 400.0));
        assert_eq!(ends("100 m/s..0.4 km/s"), (100.0, 400.0));
        for (text, words) in [
            ("400", "is not a range"),
            ("400..100", "not above"),
            ("a..100", "not a number"),
            ("0..100 knots", "knots"),
            ("0..20 km/s", "out of range"),
            ("-5..20", "out of range"),
            ("100 kg..300 m/s", "`kg` is a unit of mass"),
            ("100...300", "is not a range"),
        ] {
            let error = range(text).unwrap_err().to_string();
            assert!(error.contains(words), "{text}: {error}");
        }
    }

    #[test]
    fn tolerances_are_speeds_or_parts() {
        assert_eq!(tolerance("0.5 m/s"), Ok(Tolerance::Absolute(0.5)));
        assert_eq!(tolerance(" 0.2% "), Ok(Tolerance::Relative(0.002)));
        for (text, words) in [
            ("0.5", "0.5 m/s"),
            ("few %", "not a percentage"),
            ("0 m/s", "out of range"),
            ("-1 m/s", "out of range"),
            ("80 %", "out of range"),
            ("5 mm", "speed"),
        ] {
            let error = tolerance(text).unwrap_err().to_string();
            assert!(error.contains(words), "{text}: {error}");
        }
    }

    #[test]
    fn spans_are_speeds_and_points_are_counted() {
        assert_eq!(span("38 m/s"), Ok(38.0));
        for (text, words) in [
            ("5", "such as \"38 m/s\""),
            ("2 %", "such as \"38 m/s\""),
            ("-1 m/s", "out of range"),
        ] {
            let error = span(text).unwrap_err().to_string();
            assert!(error.contains(words), "{text}: {error}");
        }
        assert_eq!((points("0"), points("200")), (Ok(0), Ok(200)));
        for text in ["-1", "201", "1e9", "1.5", "few"] {
            let error = points(text).unwrap_err().to_string();
            assert!(error.contains("from 0 to 200"), "{text}: {error}");
        }
    }
}
