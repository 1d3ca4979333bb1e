//! Files of partial and complete penetrations.

use std::path::Path;

use super::Test;
use crate::{
    check::limits::IMPACT_VELOCITY,
    csv_table::{CsvRow, CsvTable, header},
    document::read_text,
    error::{Error, InputError},
    experiments::TestFile,
    units::Velocity,
};

const VELOCITY: &str = "impact_velocity_m_s";
const PERFORATED: &str = "perforated";

/// Columns of a file: the impact velocity [m/s], `yes` or `no`, and a note that nothing reads.
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
    let unread_columns = header::check(&table, &COLUMNS, &[VELOCITY, PERFORATED])?;
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
    Ok(TestFile {
        tests,
        unread_columns,
    })
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
