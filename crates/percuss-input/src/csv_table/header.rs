//! The first line of a table.

use super::{CsvTable, SEPARATORS_HELP};
use crate::{
    document::Renamed,
    error::{InputError, nearest},
    units::{ColumnName, ResultUnit, shorten},
};

/// Makes sure that columns are there once and that none is missing; returns those that nothing reads.
///
/// A name near that of a known column is taken as misspelt, and so is the only name of a line.
pub fn check(
    table: &CsvTable<'_>,
    known: &[&str],
    required: &[&str],
) -> Result<Vec<String>, Box<InputError>> {
    let missing: Vec<&str> = required
        .iter()
        .copied()
        .filter(|column| !table.header.iter().any(|name| name == column))
        .collect();
    let separator = match table.header.len() {
        1 => SEPARATORS_HELP,
        _ => "",
    };
    let mut unread = Vec::new();
    // A misspelt name tells more than the name that is missing for it.
    for (i, name) in table.header.iter().enumerate() {
        let span = table.field_span(0, i);
        if table.header[..i].contains(name) {
            let message = format!("two columns are named `{}`", shorten(name));
            return Err(table.error(span, name, message, "remove one"));
        }
        if known.contains(&name.as_str()) {
            continue;
        }
        if let Some(renamed) = Renamed::of(name) {
            return Err(table.error(span, name, renamed.message(), renamed.help()));
        }
        let near = nearest(name, known.iter().copied());
        let in_other_unit = |known: &&&str| {
            let (quantity, unit) = ResultUnit::split(known);
            let of_name = ColumnName::of(name, quantity, unit);
            unit != ResultUnit::NONE && matches!(of_name, ColumnName::InUnit(_))
        };
        if let Some(other) = known.iter().find(in_other_unit) {
            // Its numbers under the other name would be wrong by the ratio of the units.
            let (_, unit) = ResultUnit::split(other);
            let message = format!("the unit of `{}` is not read here", shorten(name));
            let help = format!(
                "convert its numbers to {}, and name it `{other}`",
                unit.symbol
            );
            return Err(table.error(span, name, message, help));
        }
        if let Some(near) = near {
            let message = format!("no column is named `{}`", shorten(name));
            let rest: Vec<&str> = missing
                .iter()
                .copied()
                .filter(|column| *column != near)
                .collect();
            let rest = match rest.as_slice() {
                [] => String::new(),
                rest => format!("; the first line also lacks {}", in_ticks(rest)),
            };
            let help =
                format!("did you mean `{near}`? rename a column of another kind{separator}{rest}");
            return Err(table.error(span, name, message, help));
        }
        unread.push(shorten(name));
    }
    if missing.is_empty() {
        return Ok(unread);
    }
    let message = format!("the first line lacks {}", in_ticks(&missing));
    let help = format!(
        "the first line names the columns; required are {}{separator}",
        in_ticks(required)
    );
    Err(table.error(0..0, "", message, help))
}

fn in_ticks(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}
