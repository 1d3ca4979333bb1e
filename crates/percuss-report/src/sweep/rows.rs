//! Reading a few columns of a sweep.

use std::path::Path;

use parquet::{
    column::reader::ColumnReader,
    data_type::{ByteArray, DataType},
    errors::ParquetError,
    file::reader::{FileReader, SerializedFileReader},
};
use percuss::{
    input_file::{self, MAX_OWN_BYTES},
    outcome::Outcome,
    sweep::{Sweep, SweepRow},
};

use super::{columns::columns, parts::Parts};
use crate::{ReportError, column::word};

/// Some columns of a sweep's rows, and what the rows without a value lack it for.
pub(super) struct Rows {
    /// The values of each parameter in turn; a word counts as its place in the list.
    pub(super) inputs: Vec<Vec<f64>>,
    /// The number that was asked for: not finite where there is none.
    pub(super) values: Vec<f64>,
    /// Whether the run failed: no case can be made of it, or the model gave an error.
    pub(super) failed: Vec<bool>,
    /// Runs that are not there: their blocks are missing or damaged.
    pub(super) missing: u64,
}

impl Rows {
    /// Reads what there is, block by block.
    ///
    /// # Errors
    /// [`ReportError::Read`].
    pub(super) fn read(parts: &Parts<'_>, quantity: &str) -> Result<Self, ReportError> {
        let manifest = &parts.manifest;
        let mut rows = Self {
            inputs: vec![Vec::new(); manifest.parameters.len()],
            values: Vec::new(),
            failed: Vec::new(),
            missing: 0,
        };
        for (block, file) in parts.files().enumerate() {
            match file {
                Some(path) => {
                    rows.add(parts, quantity, &path)
                        .map_err(|error| ReportError::Read {
                            path,
                            reason: error.to_string(),
                        })?;
                }
                None => rows.missing += manifest.runs_in(block as u64),
            }
        }
        Ok(rows)
    }

    /// Takes rows that are in memory.
    pub(super) fn of(sweep: &Sweep, rows: &[SweepRow], quantity: &str) -> Self {
        let columns = columns(sweep);
        let column = columns.iter().find(|column| column.name() == quantity);
        let value = |row: &SweepRow| column.and_then(|column| column.number(row));
        let failed = |row: &SweepRow| match &row.record {
            Ok(record) => record.outcome == Outcome::Failed,
            Err(_) => true,
        };
        Self {
            inputs: (0..sweep.axes.len())
                .map(|i| rows.iter().map(|row| row.inputs[i]).collect())
                .collect(),
            values: rows
                .iter()
                .map(|row| value(row).unwrap_or(f64::NAN))
                .collect(),
            failed: rows.iter().map(failed).collect(),
            missing: 0,
        }
    }

    fn add(&mut self, parts: &Parts<'_>, quantity: &str, path: &Path) -> Result<(), ParquetError> {
        let manifest = &parts.manifest;
        let reader = SerializedFileReader::new(input_file::open(path, MAX_OWN_BYTES)?)?;
        let group = reader.get_row_group(0)?;
        let column = |name: &str| {
            let mut names = manifest.columns.iter();
            let place = names.position(|column| column.name == name);
            let place = place.ok_or_else(|| ParquetError::General(format!("no column {name}")))?;
            group.get_column_reader(place)
        };
        for (values, varied) in self.inputs.iter_mut().zip(&manifest.parameters) {
            let reader = column(&varied.column)?;
            if varied.words.is_empty() {
                values.extend(numbers(reader)?);
                continue;
            }
            for text in texts(reader)? {
                let mut words = varied.words.iter();
                let place = words.position(|word| word.as_bytes() == text.data());
                values.push(place.map_or(f64::NAN, |place| place as f64));
            }
        }
        self.values.extend(numbers(column(quantity)?)?);
        let failed = word(&Outcome::Failed);
        let outcomes = texts(column("outcome")?)?;
        let outcomes = outcomes.iter().map(|text| text.data() == failed.as_bytes());
        self.failed.extend(outcomes);
        Ok(())
    }
}

/// Whether a column of a block has any number; the file says so without being read.
pub(super) fn has_numbers(path: &Path, column: usize) -> bool {
    let reader = input_file::open(path, MAX_OWN_BYTES).map(SerializedFileReader::new);
    reader.is_ok_and(|reader| {
        reader.is_ok_and(|reader| {
            let group = reader.metadata().row_group(0);
            let nulls = group.column(column).statistics();
            let nulls = nulls.and_then(|statistics| statistics.null_count_opt());
            nulls.is_some_and(|nulls| nulls < group.num_rows() as u64)
        })
    })
}

/// The numbers of a column; NaN where there is none.
fn numbers(reader: ColumnReader) -> Result<Vec<f64>, ParquetError> {
    match reader {
        ColumnReader::DoubleColumnReader(reader) => {
            let (values, levels) = all(reader)?;
            let mut values = values.into_iter();
            Ok(levels
                .iter()
                .map(|level| match level {
                    0 => f64::NAN,
                    _ => values.next().unwrap_or(f64::NAN),
                })
                .collect())
        }
        ColumnReader::Int64ColumnReader(reader) => {
            Ok(all(reader)?.0.into_iter().map(|v| v as f64).collect())
        }
        _ => Err(ParquetError::General("no column of numbers".to_owned())),
    }
}

fn texts(reader: ColumnReader) -> Result<Vec<ByteArray>, ParquetError> {
    match reader {
        ColumnReader::ByteArrayColumnReader(reader) => Ok(all(reader)?.0),
        _ => Err(ParquetError::General("no column of texts".to_owned())),
    }
}

/// The values of a column, and for each row whether it has one: 1, or 0 for null.
fn all<T: DataType>(
    mut reader: parquet::column::reader::ColumnReaderImpl<T>,
) -> Result<(Vec<T::T>, Vec<i16>), ParquetError> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    loop {
        let (rows, ..) = reader.read_records(1 << 16, Some(&mut levels), None, &mut values)?;
        if rows == 0 {
            break;
        }
    }
    // A column that always has values has no levels.
    if levels.is_empty() {
        levels = vec![1; values.len()];
    }
    Ok((values, levels))
}
