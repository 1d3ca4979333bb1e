//! Terminal output of a run.

use percuss::{
    Scenario,
    outcome::{Numerics, RunResult},
    summary::ResultRecord,
    units::Velocity,
};
use percuss_report::result_rows::{self, Row, number, percentage};

use crate::{
    fragment_table,
    terminal::{self, bold, paragraph, title, width, wrap},
};

/// Least width of a column of labels.
const LABEL: usize = 28;
/// Least space between a label and its value.
const GAP: usize = 2;
/// Characters of a full bar.
const BAR: f64 = 30.0;
/// Fraction of the initial energy below which a line is rounding error.
const NEGLIGIBLE: f64 = 1e-9;

/// What is said where an axisymmetric answer is to follow.
const FIRST: &str = "a first answer; the number to use follows at the end: that of the axisymmetric model on several meshes";

/// Results, energy distribution, balances, results of other models, and warnings; `is_first` where an axisymmetric answer is to follow.
pub fn text(
    scenario: &Scenario,
    result: &RunResult,
    record: &ResultRecord,
    others: Option<(String, Vec<Row>)>,
    is_first: bool,
) -> String {
    let mut text = String::new();
    head(scenario, result, record, &mut text);
    if is_first {
        text += &paragraph(FIRST);
    }
    text.push('\n');
    let mut outcome = result_rows::outcome_rows(scenario, result, record, result_rows::DIGITS);
    if let Some((_, ended)) = outcome.first_mut() {
        *ended = bold(&ended);
    }
    text += &rows(&outcome);
    block(
        &format!("model {}", result.model),
        &result_rows::detail_rows(result, result_rows::DIGITS),
        &mut text,
    );
    block(
        "differences from measured curves",
        &result_rows::curve_rows(record),
        &mut text,
    );
    text += &fragment_table::text(&record.fragments);
    if let Some(numerics) = &result.numerics {
        energy(numerics, &mut text);
        let balance = result_rows::balance_rows(
            numerics,
            result.end_time.unwrap_or(0.0),
            result_rows::DIGITS,
        );
        block(
            "energy balance, momentum balance and time steps",
            &balance,
            &mut text,
        );
    }
    if let Some((heading, others)) = others {
        block(&wrap(&heading, width(), 0), &others, &mut text);
    }
    warnings(result, &mut text);
    text
}

fn head(scenario: &Scenario, result: &RunResult, record: &ResultRecord, text: &mut String) {
    *text += &title(scenario);
    let mut line = format!(
        "case {}, impact at {}, model {}",
        scenario.name,
        Velocity::new(scenario.impact_velocity),
        result.model,
    );
    if !result.scheme.is_empty() {
        line += &format!(", scheme {}", result.scheme);
    }
    if let Some(closure) = record.target_resistance {
        line += &format!(", target resistance model {closure}");
    }
    *text += &paragraph(&line);
    let choices = [&result.model_choice, &result.target_resistance_choice];
    for choice in choices.into_iter().flatten() {
        *text += &paragraph(choice);
    }
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

fn warnings(result: &RunResult, text: &mut String) {
    for warning in &result.warnings {
        *text += &format!("\n{}", terminal::warning(warning));
    }
}

/// Rows under a heading, if there are any.
fn block(heading: &str, lines: &[Row], text: &mut String) {
    if !lines.is_empty() {
        *text += &format!("\n{}\n{}", bold(heading), rows(lines));
    }
}

/// Rows of a label and a value; the values of a block are aligned.
pub fn rows(rows: &[Row]) -> String {
    let longest = rows.iter().map(|(label, _)| label.chars().count()).max();
    let column = LABEL.max(longest.unwrap_or(0) + GAP);
    let line = |(label, value): &Row| {
        let value = wrap(value, width().saturating_sub(column), 0);
        let value = value.replace('\n', &format!("\n{:column$}", ""));
        format!("{label:<column$}{value}\n")
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::{number, rows};

    #[test]
    fn values_stand_behind_the_longest_label() {
        let mut lines = vec![("factor a".to_owned(), number(0.9, ""))];
        assert_eq!(rows(&lines), format!("{:28}0.9\n", "factor a"));
        let long = "energy lost to the capture of the plug";
        lines.push((long.to_owned(), number(1157.8, "J")));
        let text = rows(&lines);
        assert_eq!(
            text,
            format!("{:40}0.9\n{long}  1157.8 J\n", "factor a"),
            "{text}"
        );
    }
}
