//! Files of partial and complete penetrations.

use std::path::Path;

use super::Test;
use crate::{
    check::limits::IMPACT_VELOCITY,
    csv_table::{CsvRow, CsvTable, KnownColumn, names, recognise},
    document::read_text,
    error::{Error, InputError},
    experiments::TestFile,
    units::{Velocity, plain_name, shorten},
};

const VELOCITY: &str = "impact_velocity_m_s";
const PERFORATED: &str = "perforated";
/// How a result of a test is written, by its letters in lower case.
const RESULTS: [(&str, bool); 14] = [
    ("yes", true),
    ("no", false),
    ("complete", true),
    ("partial", false),
    ("completepenetration", true),
    ("partialpenetration", false),
    ("y", true),
    ("n", false),
    ("cp", true),
    ("pp", false),
    ("true", true),
    ("false", false),
    ("1", true),
    ("0", false),
];

/// The same in a column that has both.
const LETTERS: [(&str, bool); 2] = [("c", true), ("p", false)];

/// Columns of a file: the impact velocity, also by another name and in another unit, whether the target was perforated, and a note that nothing
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
    let (mut table, records) = CsvTable::read(name, text)?;
    let known = [
        KnownColumn::of(VELOCITY, names::IMPACT_VELOCITY),
        KnownColumn {
            aliases: names::PERFORATED,
            ..KnownColumn::of_words(PERFORATED)
        },
        KnownColumn::of_words(COLUMNS[2]),
    ];
    let recognised = recognise(&table, &known, &[VELOCITY, PERFORATED])?;
    table.adopt(&recognised, &known);
    let mut tests = Vec::new();
    // Alone, P can be a perforation; beside C it is a partial penetration.
    let has_complete = records.iter().any(|record| {
        let row = CsvRow {
            table: &table,
            record: record.clone(),
        };
        plain_name(row.text(PERFORATED)) == "c"
    });
    for record in records {
        let row = CsvRow {
            table: &table,
            record,
        };
        tests.push(test(&row, has_complete)?);
    }
    if tests.is_empty() {
        let help = "write one row per test below the header, such as 184.3,yes";
        let error = table.error(0..0, "", "the file holds no test", help);
        return Err(error.into());
    }
    Ok(TestFile {
        tests,
        unread_columns: recognised.unread,
        read_as: recognised.read_as,
    })
}

fn test(row: &CsvRow<'_>, has_complete: bool) -> Result<Test, Box<InputError>> {
    if row.record.len() != row.table.header.len() {
        return Err(row.error(
            VELOCITY,
            format!(
                "the row has {} fields, and the first line names {}",
                row.record.len(),
                row.table.header.len()
            ),
            "a field with a separator of columns in it stands in double quotes",
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
    let result = plain_name(&row.required(PERFORATED)?);
    let letters: &[(&str, bool)] = if has_complete { &LETTERS } else { &[] };
    let mut all = RESULTS.iter().chain(letters);
    let known = all.find(|(word, _)| *word == result);
    let Some((_, perforated)) = known else {
        let message = format!("unknown value `{}`", shorten(row.text(PERFORATED)));
        let help = "allowed: yes or no, complete or partial, CP or PP, true or false, 1 or 0; C or P where both are in the column";
        return Err(row.error(PERFORATED, message, help));
    };
    Ok(Test {
        impact_velocity: velocity,
        perforated: *perforated,
    })
}
