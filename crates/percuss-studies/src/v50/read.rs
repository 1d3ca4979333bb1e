//! Files of partial and complete penetrations.

use std::path::Path;

use super::Test;
use crate::{
    check::limits::IMPACT_VELOCITY,
    document::{Renamed, read_text},
    error::{Error, InputError, nearest},
    experiments::row::{CsvRow, CsvTable, field_span},
    units::{Velocity, shorten},
};

const VELOCITY: &str = "impact_velocity_m_s";
const PERFORATED: &str = "perforated";

/// Columns of a file: the impact velocity [m/s], `yes` or `no`, and a note that nothing reads.
pub const COLUMNS: [&str; 3] = [VELOCITY, PERFORATED, "note"];

/// Reads a file of tests: comma-separated values with the columns [`COLUMNS`], of which the first two are required.
///
/// # Errors
/// [`Error::Read`] when it cannot be read, [`Error::Input`] with the place when its content is not valid.
pub fn read(path: impl AsRef<Path>) -> Result<Vec<Test>, Error> {
    let path = path.as_ref();
    read_str(&path.display().to_string(), &read_text(path)?)
}

/// Reads tests from a text; `name` stands for the file in messages.
///
/// # Errors
/// [`Error::Input`] with the place when the text is not valid.
pub fn read_str(name: &str, text: &str) -> Result<Vec<Test>, Error> {
    let (table, records) = CsvTable::read(name, text)?;
    check_header(&table)?;
    let mut tests = Vec::new();
    for record in records {
        tests.push(test(&CsvRow {
            table: &table,
            record,
        })?);
    }
    if tests.is_empty() {
        let help = "write one row per test below the header, such as 184.3,yes";
        let error = table.error(0..0, "", "the file holds no test", help);
        return Err(error.into());
    }
    Ok(tests)
}

fn check_header(table: &CsvTable<'_>) -> Result<(), Box<InputError>> {
    let known = || COLUMNS.iter().copied();
    let separated = match table.header.len() {
        1 => "; columns are separated by commas",
        _ => "",
    };
    for (i, name) in table.header.iter().enumerate() {
        let span = field_span(table.text, 0, i);
        if table.header[..i].contains(name) {
            let message = format!("two columns are named `{}`", shorten(name));
            return Err(table.error(span, name, message, "remove one"));
        }
        if !known().any(|column| column == name) {
            if let Some(renamed) = Renamed::of(name) {
                return Err(table.error(span, name, renamed.message(), renamed.help()));
            }
            let near = nearest(name, known())
                .map_or_else(String::new, |near| format!("did you mean `{near}`? "));
            return Err(table.error(
                span,
                name,
                format!("no column is named `{}`", shorten(name)),
                format!("{near}columns are {}{separated}", COLUMNS.join(", ")),
            ));
        }
    }
    for required in [VELOCITY, PERFORATED] {
        if !table.header.iter().any(|name| name == required) {
            return Err(table.error(
                0..0,
                "",
                format!("the first line lacks `{required}`"),
                format!("the first line names the columns: {VELOCITY},{PERFORATED}{separated}"),
            ));
        }
    }
    Ok(())
}

fn test(row: &CsvRow<'_>) -> Result<Test, Box<InputError>> {
    if row.record.len() != row.table.header.len() {
        return Err(row.error(
            VELOCITY,
            format!(
                "the row has {} fields, and the first line names {}",
                row.record.len(),
                row.table.header.len()
            ),
            "a field with a comma in it stands in double quotes",
        ));
    }
    let velocity = row.required_number(VELOCITY)?;
    if !(IMPACT_VELOCITY.min..=IMPACT_VELOCITY.max).contains(&velocity) {
        return Err(row.error(
            VELOCITY,
            format!("{} is out of range", Velocity::new(velocity)),
            format!(
                "allowed: {} to {} m/s",
                IMPACT_VELOCITY.min, IMPACT_VELOCITY.max
            ),
        ));
    }
    row.required(PERFORATED)?;
    let perforated = row.word(PERFORATED, &[("yes", true), ("no", false)])?;
    Ok(Test {
        impact_velocity: velocity,
        perforated: perforated.unwrap_or(false),
    })
}
