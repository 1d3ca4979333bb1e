//! The first line of a file of tests.

use super::{
    columns::COLUMNS,
    row::{CsvTable, field_span},
};
use crate::{
    document::Renamed,
    error::{InputError, nearest},
    units::shorten,
};

/// Makes sure that the columns are known, each once, and that none is missing.
pub(super) fn check(table: &CsvTable<'_>) -> Result<(), Box<InputError>> {
    let names = || COLUMNS.iter().map(|column| column.name);
    let missing: Vec<&str> = COLUMNS
        .iter()
        .filter(|column| column.required && !table.header.iter().any(|name| name == column.name))
        .map(|column| column.name)
        .collect();
    let unknown = |name: &str| !names().any(|known| known == name);
    // A misspelt name tells more than the name that is missing for it.
    for (i, name) in table.header.iter().enumerate() {
        let span = field_span(table.text, 0, i);
        if table.header[..i].contains(name) {
            return Err(table.error(
                span,
                name,
                format!("two columns are named `{}`", shorten(name)),
                "remove one",
            ));
        }
        if unknown(name) && !(missing.len() > 2 && table.header.len() == 1) {
            if let Some(renamed) = Renamed::of(name) {
                return Err(table.error(span, name, renamed.message(), renamed.help()));
            }
            let near = nearest(name, names())
                .map_or_else(String::new, |near| format!("did you mean `{near}`? "));
            return Err(table.error(
                span,
                name,
                format!("no column is named `{}`", shorten(name)),
                format!("{near}the README of the tests lists all columns; remove the others"),
            ));
        }
    }
    if missing.is_empty() {
        return Ok(());
    }
    let separator = if table.header.len() == 1 {
        "; columns are separated by commas"
    } else {
        ""
    };
    Err(table.error(
        0..0,
        "",
        format!("the first line lacks {}", in_ticks(&missing)),
        format!(
            "the first line names the columns; required are {}{separator}",
            in_ticks(
                &COLUMNS
                    .iter()
                    .filter(|c| c.required)
                    .map(|c| c.name)
                    .collect::<Vec<_>>()
            )
        ),
    ))
}

fn in_ticks(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}
