//! The result of a run as text for people.

use percuss::{
    Scenario,
    outcome::{Numerics, RunResult},
    summary::ResultRecord,
    units::{Velocity, significant},
};

use crate::{
    fragment_table,
    terminal::{bold, width, wrap, yellow},
};

/// Least width of a column of labels.
const LABEL: usize = 28;
/// Least space between a label and its value.
const GAP: usize = 2;
/// Characters of a full bar.
const BAR: f64 = 30.0;
/// Part of the initial energy below which a line is rounding, not physics.
const NEGLIGIBLE: f64 = 1e-9;

/// Table, energy shares, books and warnings.
pub fn text(scenario: &Scenario, result: &RunResult, record: &ResultRecord) -> String {
    let mut text = String::new();
    head(scenario, result, record, &mut text);
    outcome(scenario, result, record, &mut text);
    details(result, &mut text);
    text += &fragment_table::text(&record.fragments);
    if let Some(numerics) = &result.numerics {
        energy(numerics, &mut text);
        books(numerics, result.end_time.unwrap_or(0.0), &mut text);
    }
    warnings(result, &mut text);
    text
}

fn head(scenario: &Scenario, result: &RunResult, record: &ResultRecord, text: &mut String) {
    let title = if scenario.title.is_empty() {
        &scenario.name
    } else {
        &scenario.title
    };
    *text += &format!("{}\n", bold(wrap(title, width(), 0)));
    let mut line = format!(
        "case {}, impact at {}, model {}",
        scenario.name,
        Velocity::new(scenario.impact_speed),
        result.model,
    );
    if !result.scheme.is_empty() {
        line += &format!(", scheme {}", result.scheme);
    }
    if let Some(closure) = record.target_closure {
        line += &format!(", target closure {closure}");
    }
    *text += &format!("{}\n\n", wrap(&line, width(), 0));
}

fn outcome(scenario: &Scenario, result: &RunResult, record: &ResultRecord, text: &mut String) {
    let mut rows = Rows::default();
    rows.add("outcome", bold(result.outcome.in_words()));
    if let Some(criterion) = &record.criterion {
        rows.add("told by", criterion.as_str());
    }
    rows.add("run ended because", result.termination.in_words());
    let mut present = |label: &str, value: Option<f64>, unit: &str| {
        if let Some(value) = value {
            rows.add(label, number(value, unit));
        }
    };
    present("depth of penetration", record.depth_of_penetration_mm, "mm");
    if let Some(expected) = &record.expected_error {
        let words = format!(
            "{} against the axisymmetric reference, over the {} most similar shots of the judgement",
            expected.in_words(),
            expected.shots
        );
        rows.add("its expected error", words);
    }
    let mut present = |label: &str, value: Option<f64>, unit: &str| {
        if let Some(value) = value {
            rows.add(label, number(value, unit));
        }
    };
    present("largest depth", record.largest_depth_mm, "mm");
    present("permanent depth", record.permanent_depth_mm, "mm");
    present("ballistic limit", record.ballistic_limit_m_s, "m/s");
    if let Some(band) = &record.band {
        let range = format!(
            "{} to {} ({})",
            significant(band.low, 4),
            number(band.high, band.quantity.unit()),
            band.basis
        );
        rows.add(&format!("range of {}", band.quantity.in_words()), range);
    }
    if let Some(time) = record.time_to_rest_us {
        rows.add("time to rest", number(time, "us"));
    } else if result.numerics.is_some() {
        rows.add("time to rest", "not reached");
    }
    if let Some(velocity) = record.residual_velocity_m_s {
        let direction = match velocity {
            v if v < 0.0 => " (backwards)",
            v if v > 0.0 => " (forward)",
            _ => "",
        };
        rows.add("residual velocity", number(velocity, "m/s") + direction);
    }
    if let (Some(mass), Some(velocity)) = (record.plug_mass_g, record.plug_velocity_m_s) {
        let flight = format!("{} at {}", number(mass, "g"), number(velocity, "m/s"));
        rows.add("plug", flight);
    }
    let rod = &scenario.projectile;
    let remains = [
        (
            "final projectile length",
            record.projectile_final_length_mm,
            rod.length * 1e3,
            "mm",
        ),
        (
            "final projectile diameter",
            record.projectile_final_diameter_mm,
            rod.diameter * 1e3,
            "mm",
        ),
        (
            "final projectile mass",
            record.projectile_final_mass_g,
            rod.mass * 1e3,
            "g",
        ),
    ];
    for (label, value, initial, unit) in remains {
        if let Some(value) = value {
            rows.add(label, of_initial(value, initial, unit));
        } else if result.numerics.is_some() {
            rows.add(label, "none");
        }
    }
    if let Some(force) = record.peak_force_kn {
        rows.add("peak force", number(force, "kN"));
    }
    if let Some(time) = record.contact_time_us {
        rows.add("contact time", number(time, "us"));
    }
    *text += &rows.text();
}

fn details(result: &RunResult, text: &mut String) {
    if result.details.is_empty() {
        return;
    }
    *text += &format!("\n{}\n", bold(format!("model {}", result.model)));
    let mut rows = Rows::default();
    for detail in &result.details {
        rows.add(detail.name, number(detail.value, detail.unit));
    }
    *text += &rows.text();
}

fn energy(numerics: &Numerics, text: &mut String) {
    let initial = numerics.energy.initial;
    if initial == 0.0 {
        return;
    }
    let heading = format!("energy at the end, in % of {}", number(initial, "J"));
    *text += &format!("\n{}\n", bold(heading));
    for (label, value) in numerics.energy.lines() {
        let share = value / initial;
        if share.abs() < NEGLIGIBLE {
            continue;
        }
        let bar = "█".repeat((share.max(0.0) * BAR).round().min(2.0 * BAR) as usize);
        let percent = percentage(share);
        *text += format!("  {label:<26}{percent:>7} %  {bar}").trim_end();
        text.push('\n');
    }
}

fn books(numerics: &Numerics, end_time: f64, text: &mut String) {
    *text += &format!("\n{}\n", bold("books and steps"));
    let off = |residual: f64, what: &str| match residual {
        0.0 => format!("0 of the initial {what}"),
        _ => format!("{residual:.1e} of the initial {what}"),
    };
    let mut rows = Rows::default();
    rows.add("energy residual", off(numerics.energy_residual, "energy"));
    rows.add(
        "momentum residual",
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
    *text += &rows.text();
}

fn warnings(result: &RunResult, text: &mut String) {
    for warning in &result.warnings {
        let wrapped = wrap(&format!("warning: {warning}"), width(), 9);
        let marked = wrapped.replacen("warning:", &yellow("warning:"), 1);
        *text += &format!("\n{marked}\n");
    }
}

/// Rows of a label and a value; the values of a block stand below each other.
#[derive(Default)]
struct Rows(Vec<(String, String)>);

impl Rows {
    fn add(&mut self, label: &str, value: impl Into<String>) {
        self.0.push((label.to_owned(), value.into()));
    }

    fn text(&self) -> String {
        let longest = self.0.iter().map(|(label, _)| label.chars().count()).max();
        let column = LABEL.max(longest.unwrap_or(0) + GAP);
        let line = |(label, value): &(String, String)| {
            let value = wrap(value, width().saturating_sub(column), 0);
            let value = value.replace('\n', &format!("\n{:column$}", ""));
            format!("{label:<column$}{value}\n")
        };
        self.0.iter().map(line).collect()
    }
}

fn number(value: f64, unit: &str) -> String {
    format!("{} {unit}", significant(value, 5))
        .trim_end()
        .to_owned()
}

fn of_initial(value: f64, initial: f64, unit: &str) -> String {
    format!(
        "{} ({} % of {})",
        number(value, unit),
        percentage(value / initial),
        number(initial, unit)
    )
}

/// Two decimals, and more for what would read as nothing.
fn percentage(share: f64) -> String {
    let percent = 100.0 * share;
    if percent != 0.0 && percent.abs() < 0.005 {
        format!("{percent:.0e}")
    } else {
        format!("{percent:.2}")
    }
}

#[cfg(test)]
mod tests {
    use super::{Rows, number};

    #[test]
    fn values_stand_behind_the_longest_label() {
        let mut rows = Rows::default();
        rows.add("factor a", number(0.9, ""));
        assert_eq!(rows.text(), format!("{:28}0.9\n", "factor a"));
        let long = "energy lost to the capture of the plug";
        rows.add(long, number(1157.8, "J"));
        let text = rows.text();
        assert_eq!(
            text,
            format!("{:40}0.9\n{long}  1157.8 J\n", "factor a"),
            "{text}"
        );
    }
}
