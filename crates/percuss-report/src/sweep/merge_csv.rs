//! Rows of a sweep as one CSV file.

use std::{fs::File, io::BufWriter, path::PathBuf};

use parquet::{
    errors::ParquetError,
    file::reader::{FileReader, SerializedFileReader},
    record::{Field, Row},
};
use percuss::{
    input_file::{self, MAX_OWN_BYTES},
    units::UnitSystem,
};

/// Writes the rows of all blocks below one header. A number has as many digits as it takes to read it back unchanged; a field without a
/// value is empty.
pub(super) fn write(
    files: &[PathBuf],
    units: Option<UnitSystem>,
    out: &mut File,
) -> Result<(), ParquetError> {
    let mut writer = csv::Writer::from_writer(BufWriter::new(out));
    let failure = |error: csv::Error| ParquetError::General(error.to_string());
    let mut has_header = false;
    for path in files {
        let source = input_file::open(path, MAX_OWN_BYTES)
            .map_err(|error| ParquetError::General(error.to_string()))?;
        for row in SerializedFileReader::new(source)?.get_row_iter(None)? {
            let (names, fields) = cells(&row?, units);
            if !has_header {
                writer.write_record(&names).map_err(failure)?;
                has_header = true;
            }
            writer.write_record(&fields).map_err(failure)?;
        }
    }
    writer.flush()?;
    Ok(())
}

/// Names and texts of the fields of a row, in a unit system.
fn cells(row: &Row, units: Option<UnitSystem>) -> (Vec<String>, Vec<String>) {
    let cell = |(name, field): (&String, &Field)| {
        // Optional numbers are numbers too, where there is none.
        let converted = match field {
            Field::Double(_) | Field::Null => units.and_then(|units| units.column(name)),
            _ => None,
        };
        let text = match (field, &converted) {
            (Field::Double(number), Some((_, factor))) => format!("{:?}", number * factor),
            (Field::Double(number), None) => format!("{number:?}"),
            (Field::Long(number), _) => number.to_string(),
            (Field::Str(text), _) => text.clone(),
            _ => String::new(),
        };
        let name = converted.map_or_else(|| name.clone(), |(name, _)| name);
        (name, text)
    };
    row.get_column_iter().map(cell).unzip()
}
