//! Table of the differences from measured curves.

use percuss::{Scenario, compare::Comparison, measured_curves::CurveComparison, units::Velocity};
use percuss_report::{
    result_rows::curve_label,
    table::{Table, number},
};

use crate::{
    table::blocks,
    terminal::{bold, paragraph, width, wrap},
};

/// The table, for the velocity of the case, of models with histories; empty without measured curves.
pub fn text(scenario: &Scenario, comparison: &Comparison) -> String {
    let rows: Vec<(&str, &CurveComparison)> = comparison
        .results
        .iter()
        .filter(|record| record.is_result())
        .flat_map(|record| {
            let curves = record.measured_curves.iter();
            let drawn = curves.filter(|curve| !curve.computed.is_empty());
            drawn.map(|curve| (record.model, curve))
        })
        .collect();
    if rows.is_empty() {
        let own = scenario.impact_velocity;
        let is_own = matches!(&*comparison.regime, [only] if only.impact_velocity_m_s == own);
        return match scenario.measured_curves.is_empty() || is_own {
            true => String::new(),
            false => paragraph(&format!(
                "The curves of the case were measured at {}, and are compared at that velocity alone.",
                Velocity::new(own)
            )),
        };
    }
    let with_unit = |value: Option<f64>, unit: &str| match value {
        Some(_) => format!("{} {unit}", number(value, 3)),
        None => number(None, 3),
    };
    let table = Table::of(&rows)
        .words("model", |(model, _)| *model)
        .words("measured curve", |(_, curve)| curve_label(curve))
        .numbers("RMS\ndifference", "", |(_, curve)| {
            with_unit(curve.rms_difference, curve.unit)
        })
        .numbers("relative", "%", |(_, curve)| {
            number(curve.relative_rms_difference.map(|part| 100.0 * part), 3)
        })
        .numbers("largest\ndifference", "", |(_, curve)| {
            with_unit(curve.largest_difference, curve.unit)
        })
        .when(
            rows.iter().any(|(_, curve)| curve.reason.is_some()),
            |all| all.words("", |(_, curve)| curve.reason.clone().unwrap_or_default()),
        )
        .table();
    let heading = "differences from measured curves over the common time, of models with histories";
    format!("{}\n{}{}", bold(heading), blocks(&table), notes(&rows))
}

/// What the names of the columns of each table were read as, and which nothing reads.
fn notes(rows: &[(&str, &CurveComparison)]) -> String {
    let mut notes: Vec<String> = Vec::new();
    for (_, curve) in rows {
        let read_as = curve.read_as.iter().map(|words| format!("read {words}"));
        let unread = curve.unread_columns.iter();
        let unread = unread.map(|name| format!("column `{name}` not read"));
        let words: Vec<String> = read_as.chain(unread).collect();
        let note = format!("{}: {}", curve.name, words.join("; "));
        if !words.is_empty() && !notes.contains(&note) {
            notes.push(note);
        }
    }
    notes
        .iter()
        .map(|note| format!("{}\n", wrap(note, width(), 2)))
        .collect()
}
