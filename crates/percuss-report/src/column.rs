//! Tables: columns that are defined once and written as CSV or as Parquet.

#[cfg(feature = "parquet")]
mod parquet_file;

use percuss::units::UnitSystem;
use serde::Serialize;

use crate::ReportError;

#[cfg(feature = "parquet")]
pub(crate) use parquet_file::parquet_with;

/// Name and content of a file.
pub type File = (&'static str, Vec<u8>);

/// Reader of a value of a row.
type Read<R, T> = Box<dyn Fn(&R) -> T>;

/// Value of a column.
pub(crate) enum Value<R> {
    Float(Read<R, f64>),
    Integer(Read<R, i64>),
    Optional(Read<R, Option<f64>>),
    Text(Read<R, String>),
}

/// A column of a table whose rows are made from `R`.
pub struct Column<R> {
    name: String,
    value: Value<R>,
}

impl<R> Column<R> {
    /// A number.
    pub fn float(name: impl Into<String>, value: impl Fn(&R) -> f64 + 'static) -> Self {
        Self {
            name: name.into(),
            value: Value::Float(Box::new(value)),
        }
    }

    /// A whole number.
    pub fn integer(name: impl Into<String>, value: impl Fn(&R) -> i64 + 'static) -> Self {
        Self {
            name: name.into(),
            value: Value::Integer(Box::new(value)),
        }
    }

    /// A number that some rows lack: empty in CSV, null in Parquet.
    pub fn optional(name: impl Into<String>, value: impl Fn(&R) -> Option<f64> + 'static) -> Self {
        Self {
            name: name.into(),
            value: Value::Optional(Box::new(value)),
        }
    }

    /// The same in the unit of a system, if there is one; texts and counts stay as they are.
    #[must_use]
    pub fn in_units(self, units: Option<UnitSystem>) -> Self
    where
        R: 'static,
    {
        let converted = units.and_then(|units| units.column(&self.name));
        match (converted, self.value) {
            (Some((name, factor)), Value::Float(read)) => {
                Self::float(name, move |row| factor * read(row))
            }
            (Some((name, factor)), Value::Optional(read)) => {
                Self::optional(name, move |row| read(row).map(|value| factor * value))
            }
            (_, value) => Self {
                name: self.name,
                value,
            },
        }
    }

    /// Its name.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// What its values are, in a word.
    pub(crate) fn kind(&self) -> &'static str {
        match self.value {
            Value::Float(_) | Value::Optional(_) => "number",
            Value::Integer(_) => "integer",
            Value::Text(_) => "text",
        }
    }

    /// Its number in a row; a text has none.
    pub(crate) fn number(&self, row: &R) -> Option<f64> {
        match &self.value {
            Value::Float(value) => Some(value(row)),
            Value::Integer(value) => Some(value(row) as f64),
            Value::Optional(value) => value(row),
            Value::Text(_) => None,
        }
    }

    /// A text.
    pub fn text(name: impl Into<String>, value: impl Fn(&R) -> String + 'static) -> Self {
        Self {
            name: name.into(),
            value: Value::Text(Box::new(value)),
        }
    }

    /// What a study varies: a number, or the word that it stands for.
    pub fn varied(
        name: impl Into<String>,
        words: Option<Vec<String>>,
        value: impl Fn(&R) -> f64 + 'static,
    ) -> Self {
        match words {
            None => Self::float(name, value),
            Some(words) => Self::text(name, move |row| words[value(row) as usize].clone()),
        }
    }
}

/// The name that a value has in JSON, which tables have too; empty when there is none.
pub fn word(value: &impl Serialize) -> String {
    // Words and numbers always make JSON.
    let json = serde_json::to_string(value).unwrap_or_default();
    json.trim_matches('"').replace("null", "")
}

/// The table as CSV with a header; numbers have as many digits as it takes to read them back unchanged.
///
/// # Errors
/// [`ReportError::Table`].
pub fn csv<R>(table: &str, columns: &[Column<R>], rows: &[R]) -> Result<Vec<u8>, ReportError> {
    let failure = |source: csv::Error| ReportError::Table {
        table: table.to_owned(),
        source: source.into(),
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record(columns.iter().map(|column| column.name.as_str()))
        .map_err(failure)?;
    for row in rows {
        let fields = columns.iter().map(|column| match &column.value {
            Value::Float(value) => format!("{:?}", value(row)),
            Value::Integer(value) => value(row).to_string(),
            Value::Optional(value) => {
                value(row).map_or_else(String::new, |number| format!("{number:?}"))
            }
            Value::Text(value) => value(row),
        });
        writer.write_record(fields).map_err(failure)?;
    }
    writer
        .into_inner()
        .map_err(|error| failure(error.into_error().into()))
}

/// The table as a Parquet file: one row group, null in optional columns only, Snappy compression. None in a build without Parquet.
///
/// # Errors
/// [`ReportError::Table`].
#[cfg_attr(not(feature = "parquet"), expect(unused_variables))]
pub fn parquet<R>(
    table: &'static str,
    columns: &[Column<R>],
    rows: &[R],
) -> Result<Option<File>, ReportError> {
    #[cfg(feature = "parquet")]
    return Ok(Some((table, parquet_with(table, columns, rows, &[])?)));
    #[cfg(not(feature = "parquet"))]
    Ok(None)
}

/// The table as CSV and, in a build that has it, as Parquet.
///
/// # Errors
/// [`ReportError::Table`].
pub fn files<R>(
    [csv, parquet]: [&'static str; 2],
    columns: &[Column<R>],
    rows: &[R],
) -> Result<Vec<File>, ReportError> {
    let mut files = vec![(csv, self::csv(csv, columns, rows)?)];
    files.extend(self::parquet(parquet, columns, rows)?);
    Ok(files)
}
