//! Files of partial and complete penetrations.

use std::path::Path;

use super::Test;
use crate::{
    check::limits::IMPACT_VELOCITY,
    csv_table::{CsvRow, CsvTable, header},
    document::{Renamed, read_text},
    error::{Error, InputError},
    experiments::TestFile,
    units::{ColumnName, ColumnUnit, ResultUnit, Velocity, column_symbols, shorten},
};

const VELOCITY: &str = "impact_velocity_m_s";
const PERFORATED: &str = "perforated";
/// Other names of the column of results.
const RESULT_COLUMNS: [&str; 5] = [
    PERFORATED,
    "result",
    "outcome",
    "penetration",
    "perforation",
];
/// Names of the column of velocities without its unit.
const QUANTITIES: [&str; 2] = ["impact_velocity", "velocity"];
/// How a result of a test is written, in any case of letters.
const RESULTS: [(&str, bool); 10] = [
    ("yes", true),
    ("no", false),
    ("complete", true),
    ("partial", false),
    ("cp", true),
    ("pp", false),
    ("true", true),
    ("false", false),
    ("1", true),
    ("0", false),
];

/// Columns of a file: the impact velocity, also in another unit of its name, whether the target was perforated, and a note that nothing
/// reads.
pub const COLUMNS: [&str; 3] = [VELOCITY, PERFORATED, "note"];

/// Reads a file of tests: comma-separated values with the columns [`COLUMNS`], of which the first two are required. Others are not read.
///
/// # Errors
/// [`Error::Read`] when it cannot be read, [`Error::Input`] with the place when its content is not valid.
pub fn read(path: impl AsRef<Path>) -> Result<TestFile<Test>, Error> {
    let path = path.as_ref();
    file(&path.display().to_string(), &read_text(path)?)
}

/// Reads tests from a text; `name` stands for the file in messages.
///
/// # Errors
/// [`Error::Input`] with the place when the text is not valid.
pub fn read_str(name: &str, text: &str) -> Result<Vec<Test>, Error> {
    Ok(file(name, text)?.tests)
}

fn file(name: &str, text: &str) -> Result<TestFile<Test>, Error> {
    let (table, records) = CsvTable::read(name, text)?;
    let (velocity, unit) = velocity(&table)?;
    let result = result_column(&table);
    let known = [velocity.as_str(), &result, COLUMNS[2]];
    let unread_columns = header::check(&table, &known, &[&velocity, &result])?;
    let mut tests = Vec::new();
    for record in records {
        let row = CsvRow {
            table: &table,
            record,
        };
        tests.push(test(&row, &velocity, unit, &result)?);
    }
    if tests.is_empty() {
        let help = "write one row per test below the header, such as 184.3,yes";
        let error = table.error(0..0, "", "the file holds no test", help);
        return Err(error.into());
    }
    Ok(TestFile {
        tests,
        unread_columns,
    })
}

/// Name and unit of the column of velocities: the first that is one, in whatever unit. The usual name where there is none.
fn velocity(table: &CsvTable<'_>) -> Result<(String, Option<ColumnUnit>), Box<InputError>> {
    for (i, name) in table.header.iter().enumerate() {
        // A former name is refused with the new one.
        if Renamed::of(name).is_some() {
            continue;
        }
        for quantity in QUANTITIES {
            match ColumnName::of(name, quantity, ResultUnit::M_S) {
                ColumnName::InUnit(unit) => return Ok((name.clone(), Some(unit))),
                ColumnName::WithoutUnit => {
                    let message = format!("the unit of `{}` is missing", shorten(name));
                    let units = column_symbols(ResultUnit::M_S);
                    let help = format!("write `{VELOCITY}` or `{quantity} (m/s)`; units: {units}");
                    return Err(table.error(table.field_span(0, i), name, message, help));
                }
                _ => {}
            }
        }
    }
    Ok((VELOCITY.to_owned(), None))
}

/// Name of the column of results: the first that is one, in any case of letters. The usual name where there is none.
fn result_column(table: &CsvTable<'_>) -> String {
    let mut names = table.header.iter();
    let found = names.find(|name| RESULT_COLUMNS.contains(&name.to_lowercase().as_str()));
    found.map_or_else(|| PERFORATED.to_owned(), String::clone)
}

fn test(
    row: &CsvRow<'_>,
    column: &str,
    unit: Option<ColumnUnit>,
    result_column: &str,
) -> Result<Test, Box<InputError>> {
    if row.record.len() != row.table.header.len() {
        return Err(row.error(
            column,
            format!(
                "the row has {} fields, and the first line names {}",
                row.record.len(),
                row.table.header.len()
            ),
            "a field with a separator of columns in it stands in double quotes",
        ));
    }
    let number = row.required_number(column)?;
    let velocity = unit.map_or(number, |unit| unit.to_si(number));
    if !(IMPACT_VELOCITY.min..=IMPACT_VELOCITY.max).contains(&velocity) {
        return Err(row.error(
            column,
            format!("{} is out of range", Velocity::new(velocity)),
            format!(
                "allowed: {} to {} m/s",
                IMPACT_VELOCITY.min, IMPACT_VELOCITY.max
            ),
        ));
    }
    let result = row.required(result_column)?.to_lowercase();
    let known = RESULTS.iter().find(|(word, _)| *word == result);
    let Some((_, perforated)) = known else {
        let message = format!("unknown value `{}`", shorten(row.text(result_column)));
        let help = "allowed: yes or no, complete or partial, CP or PP, true or false, 1 or 0";
        return Err(row.error(result_column, message, help));
    };
    Ok(Test {
        impact_velocity: velocity,
        perforated: *perforated,
    })
}
