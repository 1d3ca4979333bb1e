//! Materials as tables of other programs: JSON, and comma-separated values with a row for each material.
//!
//! ```
//! use percuss::{material::{Library, MaterialTable}, material_tables};
//!
//! let steel = Library::built_in().find("4340").unwrap();
//! let records = MaterialTable::from([(steel.id.clone(), (*steel.material).clone())]);
//! let text = material_tables::csv(&records).unwrap();
//! assert_eq!(material_tables::read_csv("steel.csv", &text)?.records, records);
//! # Ok::<(), percuss::Error>(())
//! ```

mod cells;
mod csv_file;
mod json_file;
mod keys;
#[cfg(test)]
mod tests;

use std::path::Path;

use crate::{document::read_text, error::Error, lsdyna::Imported};

pub use csv_file::{csv, read_csv};
pub use json_file::{json, read_json};

/// Format of a file of materials, by the ending of its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFormat {
    /// An object with a record for each id.
    Json,
    /// A row for each material.
    Csv,
}

impl TableFormat {
    /// The format of a file; `None` where it is of another kind.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_ascii_lowercase();
        match ending.to_str()? {
            "json" => Some(Self::Json),
            "csv" => Some(Self::Csv),
            _ => None,
        }
    }
}

/// Reads the materials of a file.
///
/// # Errors
/// [`Error::Read`] when it cannot be read, [`Error::Input`] with the place of what is not valid.
pub fn read_file(path: &Path, format: TableFormat) -> Result<Imported, Error> {
    let (name, text) = (path.display().to_string(), read_text(path)?);
    match format {
        TableFormat::Json => read_json(&name, &text),
        TableFormat::Csv => read_csv(&name, &text),
    }
}
