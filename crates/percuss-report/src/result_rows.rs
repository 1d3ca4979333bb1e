//! Result of a run as rows of a label and a value, for the terminal and the page.

use percuss::{
    Scenario,
    measured_curves::CurveComparison,
    outcome::{Detail, Numerics, Outcome, RunResult, Termination},
    summary::{RESULT_FIELDS, ResultNumber, ResultRecord},
    units::significant,
};

/// Digits of a number in the terminal.
pub const DIGITS: usize = 5;

/// Label, and value with its unit.
pub type Row = (String, String);

#[derive(Default)]
struct Rows(Vec<Row>);

impl Rows {
    fn add(&mut self, label: &str, value: impl Into<String>) {
        self.0.push((label.to_owned(), value.into()));
    }
}

/// Outcome and all result numbers of tables to so many digits, in the order of the record.
pub fn outcome_rows(
    scenario: &Scenario,
    result: &RunResult,
    record: &ResultRecord,
    digits: usize,
) -> Vec<Row> {
    let mut rows = Rows::default();
    rows.add("outcome", result.outcome.describe());
    if let Some(criterion) = &record.criterion {
        rows.add("termination criterion", criterion.as_str());
    }
    rows.add("termination", result.termination.describe());
    for field in RESULT_FIELDS {
        match (&field.number, field.name) {
            (Some(result_number), _) if result_number.role.is_result() => {
                if let Some(value) = in_table(result_number, scenario, result, record, digits) {
                    rows.add(result_number.label, value);
                }
            }
            (None, "expected_error") => rows.0.extend(expected_error(record)),
            (None, "band") => rows.0.extend(band(record)),
            _ => (),
        }
    }
    rows.0
}

/// A number as the table shows it; `None` where the model does not give it.
fn in_table(
    of: &ResultNumber,
    scenario: &Scenario,
    result: &RunResult,
    record: &ResultRecord,
    digits: usize,
) -> Option<String> {
    let rod = &scenario.projectile;
    let initial = match of.name {
        "projectile_final_length_mm" => Some(rod.length),
        "projectile_final_diameter_mm" => Some(rod.diameter),
        "projectile_final_mass_g" => Some(rod.mass),
        _ => None,
    };
    let Some(value) = of.of(record) else {
        // Only a model that steps through time has these rows.
        result.numerics.as_ref()?;
        return match of.name {
            "time_to_rest_us" => Some("not reached".to_owned()),
            _ => initial.map(|_| match result.termination {
                Termination::AtRest => "not known where a run ends at rest".to_owned(),
                _ => "none".to_owned(),
            }),
        };
    };
    let unit = of.unit.symbol;
    Some(match (initial, of.name) {
        (Some(initial), _) => of_initial(value, of.unit.of_si(initial), unit, digits),
        (None, "residual_velocity_m_s") if result.outcome == Outcome::AtRest && value != 0.0 => {
            format!(
                "{} (motion left at the end of the run, {:.1} % of the impact velocity)",
                to_digits(value, unit, digits),
                100.0 * value.abs() / scenario.impact_velocity
            )
        }
        (None, "residual_velocity_m_s") if value < 0.0 => {
            to_digits(value, unit, digits) + " (backwards)"
        }
        (None, "residual_velocity_m_s") if value > 0.0 => {
            to_digits(value, unit, digits) + " (forward)"
        }
        _ => to_digits(value, unit, digits),
    })
}

/// Estimated model error of a depth, if similar cases are in the benchmark.
pub fn expected_error(record: &ResultRecord) -> Option<Row> {
    let expected = record.expected_error.as_ref()?;
    let outside = match expected.outside {
        true => "; the case lies outside the benchmark, where it may be larger",
        false => "",
    };
    let words = format!(
        "{} against the axisymmetric reference, from the {} most similar benchmark cases{outside}",
        expected.describe(),
        expected.cases
    );
    Some(("estimated model error".to_owned(), words))
}

fn band(record: &ResultRecord) -> Option<Row> {
    let band = record.band.as_ref()?;
    let range = format!(
        "{} to {} ({})",
        significant(band.low, 4),
        number(band.high, band.quantity.unit()),
        band.basis
    );
    Some((format!("range of {}", band.quantity.describe()), range))
}

/// Differences from measured curves, and columns of their tables that nothing reads.
pub fn curve_rows(record: &ResultRecord) -> Vec<Row> {
    let row = |curve: &CurveComparison| (curve_label(curve), curve_words(curve));
    record.measured_curves.iter().map(row).collect()
}

/// Name, gauge and quantity of a measured curve.
pub fn curve_label(curve: &CurveComparison) -> String {
    let quantity = curve.quantity.replace('_', " ");
    match &curve.gauge {
        Some(gauge) => format!("{}: {quantity} at {gauge}", curve.name),
        None => format!("{}: {quantity}", curve.name),
    }
}

fn curve_words(curve: &CurveComparison) -> String {
    let mut words = match (curve.rms_difference, curve.largest_difference) {
        (Some(rms), Some(largest)) => {
            let part = curve.relative_rms_difference;
            let part = part.map_or_else(String::new, |part| {
                format!(" ({} %)", significant(100.0 * part, 3))
            });
            let rounded = |value: f64| format!("{} {}", significant(value, 3), curve.unit);
            let time = |time: Option<f64>| significant(time.unwrap_or_default(), 4);
            format!(
                "RMS difference {}{part}, largest {}, from {} to {} us without a shift of time",
                rounded(rms),
                rounded(largest),
                time(curve.from_us),
                time(curve.to_us),
            )
        }
        _ => format!(
            "not compared: {}",
            curve.reason.as_deref().unwrap_or_default()
        ),
    };
    if curve.has_opposite_sign {
        words += match curve.quantity {
            "stress" | "strain" => "; the curves have opposite signs: compression is positive here",
            _ => "; the curves have opposite signs",
        };
    }
    if !curve.read_as.is_empty() {
        words += &format!("; read {}", curve.read_as.join("; "));
    }
    if !curve.unread_columns.is_empty() {
        words += &format!("; columns not read: {}", curve.unread_columns.join(", "));
    }
    words
}

/// Numbers that are specific to the model.
pub fn detail_rows(result: &RunResult, digits: usize) -> Vec<Row> {
    let row = |detail: &Detail| {
        let value = to_digits(detail.value, detail.unit, digits);
        (detail.name.to_owned(), value)
    };
    result.details.iter().map(row).collect()
}

/// Errors of the energy and momentum balances, and the time steps.
pub fn balance_rows(numerics: &Numerics, end_time: f64, digits: usize) -> Vec<Row> {
    let number = |value: f64, unit: &str| to_digits(value, unit, digits);
    let off = |residual: f64, what: &str| match residual {
        0.0 => format!("0 of the initial {what}"),
        _ => format!("{residual:.1e} of the initial {what}"),
    };
    let mut rows = Rows::default();
    rows.add(
        "energy balance error",
        off(numerics.energy_residual, "energy"),
    );
    rows.add(
        "momentum balance error",
        off(numerics.momentum_residual, "momentum"),
    );
    let steps = format!("{}, up to {}", numerics.steps, number(end_time * 1e6, "us"));
    rows.add("steps", steps);
    let mut step = number(numerics.first_time_step * 1e9, "ns");
    if numerics.smallest_time_step < numerics.first_time_step {
        step += &format!(
            " at first, smallest {}",
            number(numerics.smallest_time_step * 1e9, "ns")
        );
    }
    rows.add("time step", step);
    rows.0
}

/// A number to five digits with its unit.
pub fn number(value: f64, unit: &str) -> String {
    to_digits(value, unit, DIGITS)
}

fn to_digits(value: f64, unit: &str, digits: usize) -> String {
    format!("{} {unit}", significant(value, digits))
        .trim_end()
        .to_owned()
}

/// A value to three digits with its uncertainty, rounded up to the last of them, and its unit.
pub fn with_uncertainty(value: f64, uncertainty: f64, unit: &str) -> String {
    let magnitude = value.abs().max(uncertainty).log10().floor();
    if !magnitude.is_finite() {
        return format!("{value} ± {uncertainty} {unit}");
    }
    let decimals = (2.0 - magnitude).max(0.0) as usize;
    let step = 10_f64.powi(-(decimals as i32));
    // A multiple of the step is not rounded up by the last bit of a division.
    let uncertainty = (uncertainty / step - 1e-9).ceil() * step;
    format!("{value:.decimals$} ± {uncertainty:.decimals$} {unit}")
}

fn of_initial(value: f64, initial: f64, unit: &str, digits: usize) -> String {
    let share = value / initial;
    let share = match digits {
        DIGITS.. => percentage(share),
        _ => significant(100.0 * share, digits),
    };
    format!(
        "{} ({share} % of {})",
        to_digits(value, unit, digits),
        to_digits(initial, unit, digits)
    )
}

/// Share in per cent: two decimals, one significant digit for smaller shares.
pub fn percentage(share: f64) -> String {
    let percent = 100.0 * share;
    if percent != 0.0 && percent.abs() < 0.005 {
        format!("{percent:.0e}")
    } else {
        format!("{percent:.2}")
    }
}

#[cfg(test)]
mod tests {
    use percuss::{
        case,
        outcome::{Outcome, RunResult, Termination},
        summary::ResultRecord,
    };

    use super::{DIGITS, outcome_rows, with_uncertainty};

    #[test]
    fn a_velocity_at_rest_is_said_to_be_what_is_left() {
        let text = "projectile = { material = 'copper', length = '12 mm', diameter = '5 mm', impact_velocity = '200 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = '50 mm' }\n";
        let scenario = case::load_str("case.toml", text).unwrap();
        for (outcome, velocity, words) in [
            (
                Outcome::AtRest,
                4.0,
                "4 m/s (motion left at the end of the run, 2.0 % of the impact velocity)",
            ),
            (Outcome::AtRest, 0.0, "0 m/s"),
            (Outcome::Rebounded, -4.0, "-4 m/s (backwards)"),
        ] {
            let mut result = RunResult::new("chain", "", outcome, Termination::Quiescent);
            result.residual_velocity = Some(velocity);
            let record = ResultRecord::new(&scenario, &result);
            let rows = outcome_rows(&scenario, &result, &record, DIGITS);
            let (_, shown) = rows
                .iter()
                .find(|(label, _)| label == "residual velocity")
                .unwrap();
            assert_eq!(shown, words);
        }
    }

    #[test]
    fn an_uncertainty_is_rounded_up_to_the_last_digit_of_the_value() {
        for (value, uncertainty, words) in [
            (0.21733, 0.01045, "0.217 ± 0.011 mm"),
            (2.2111, 0.0167, "2.21 ± 0.02 mm"),
            (12.34, 0.51, "12.3 ± 0.6 mm"),
            (0.0512, 0.001, "0.0512 ± 0.0010 mm"),
            (345.6, 3.2, "346 ± 4 mm"),
            (1.5, 0.03, "1.50 ± 0.03 mm"),
            // The uncertainty has the digits where it is the larger of the two.
            (0.001, 0.25, "0.001 ± 0.250 mm"),
            (-4.0, 0.5, "-4.00 ± 0.50 mm"),
            (0.0, 0.0, "0 ± 0 mm"),
        ] {
            assert_eq!(with_uncertainty(value, uncertainty, "mm"), words);
        }
    }
}
