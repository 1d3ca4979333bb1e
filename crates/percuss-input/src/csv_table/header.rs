//! The first line of a table whose names are read as they stand.

use super::{CsvTable, KnownColumn, recognise};
use crate::{error::InputError, units::shorten};

/// Makes sure that columns are there once and that none is missing; returns those that nothing reads.
pub fn check(
    table: &CsvTable<'_>,
    known: &[&str],
    required: &[&str],
) -> Result<Vec<String>, Box<InputError>> {
    let known: Vec<KnownColumn<'_>> = known
        .iter()
        .map(|name| KnownColumn::of_words(name))
        .collect();
    let recognised = recognise(table, &known, required)?;
    for (i, found) in recognised.columns.iter().enumerate() {
        let (name, Some((column, _))) = (&table.header[i], found) else {
            continue;
        };
        let meant = known[*column].name;
        if name != meant {
            let message = format!("no column is named `{}`", shorten(name));
            let help = format!("did you mean `{meant}`?");
            return Err(table.error(table.name_span(i), name, message, help));
        }
    }
    Ok(recognised.unread)
}
