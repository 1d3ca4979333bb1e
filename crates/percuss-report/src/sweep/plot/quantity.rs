//! Which number of the rows is drawn, and what it is called.

use super::super::{manifest::Manifest, parts::Parts, rows::has_numbers};
use crate::ReportError;

/// Columns that say what was shot, or how it was computed: what comes of it is drawn unless they are asked for.
const SECOND: [&str; 7] = [
    "shot",
    "impact_velocity_m_s",
    "impact_energy_j",
    "band_low",
    "band_high",
    "steps",
    "time_step_ns",
];
/// Ends of the names of columns, and the units that they stand for.
const UNITS: [(&str, &str); 8] = [
    ("_m_s", "m/s"),
    ("_mm", "mm"),
    ("_us", "µs"),
    ("_ns", "ns"),
    ("_kn", "kN"),
    ("_g", "g"),
    ("_j", "J"),
    ("_k", "K"),
];

/// The column that was asked for, or the first result that the sweep has.
pub(super) fn choose(parts: &Parts<'_>, wanted: Option<&str>) -> Result<String, ReportError> {
    let manifest = &parts.manifest;
    let all = || {
        let columns = manifest.columns.iter().enumerate();
        columns.filter(|(_, column)| column.kind != "text" && !is_input(manifest, &column.name))
    };
    let fail = |reason: String| {
        let names: Vec<&str> = all().map(|(_, column)| column.name.as_str()).collect();
        ReportError::Sweep {
            path: parts.first().to_owned(),
            reason,
            remedy: format!("--quantity takes one of {}", names.join(", ")),
        }
    };
    if let Some(wanted) = wanted {
        let found = all().find(|(_, column)| column.name == wanted);
        let found = found.ok_or_else(|| fail(format!("no result of the sweep is `{wanted}`")));
        return found.map(|(_, column)| column.name.clone());
    }
    let mut first = None;
    for file in parts.files().flatten() {
        let mut results = all().filter(|(_, column)| is_result(manifest, &column.name));
        let found = results.find(|(place, _)| has_numbers(&file, *place));
        first = found.map(|(_, column)| column.name.clone());
        if first.is_some() {
            break;
        }
    }
    first.ok_or_else(|| {
        fail("no shot that was computed has a result; look at the column `error`".to_owned())
    })
}

fn is_input(manifest: &Manifest, column: &str) -> bool {
    manifest.parameters.iter().any(|p| p.column == column)
}

/// Whether a column says what comes of a shot.
pub(super) fn is_result(manifest: &Manifest, column: &str) -> bool {
    !is_input(manifest, column) && !SECOND.contains(&column)
}

/// A column's name in words, with its unit in brackets.
pub(super) fn label(column: &str) -> String {
    let unit = UNITS.iter().find(|(end, _)| column.ends_with(end));
    match unit {
        Some((end, unit)) => {
            let name = column.strip_suffix(end).unwrap_or(column);
            format!("{} [{unit}]", name.replace('_', " "))
        }
        None => column.replace('_', " "),
    }
}
