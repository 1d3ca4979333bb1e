//! Tables: columns that are defined once and written as CSV or as Parquet.

use std::sync::Arc;

use parquet::{
    basic::{Compression, LogicalType, Repetition, Type as PhysicalType},
    data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type},
    errors::ParquetError,
    file::{metadata::KeyValue, properties::WriterProperties, writer::SerializedFileWriter},
    schema::types::Type,
};

use crate::ReportError;

/// How a value is read off a row.
type Read<R, T> = Box<dyn Fn(&R) -> T>;

/// What a column holds of a row.
pub(crate) enum Value<R> {
    Float(Read<R, f64>),
    Integer(Read<R, i64>),
    Optional(Read<R, Option<f64>>),
    Text(Read<R, String>),
}

/// A column of a table whose rows are made from `R`.
pub(crate) struct Column<R> {
    name: String,
    value: Value<R>,
}

impl<R> Column<R> {
    pub(crate) fn float(name: impl Into<String>, value: impl Fn(&R) -> f64 + 'static) -> Self {
        Self {
            name: name.into(),
            value: Value::Float(Box::new(value)),
        }
    }

    pub(crate) fn integer(name: impl Into<String>, value: impl Fn(&R) -> i64 + 'static) -> Self {
        Self {
            name: name.into(),
            value: Value::Integer(Box::new(value)),
        }
    }

    /// A number that some rows lack: empty in CSV, null in Parquet.
    pub(crate) fn optional(
        name: impl Into<String>,
        value: impl Fn(&R) -> Option<f64> + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            value: Value::Optional(Box::new(value)),
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

    pub(crate) fn text(name: impl Into<String>, value: impl Fn(&R) -> String + 'static) -> Self {
        Self {
            name: name.into(),
            value: Value::Text(Box::new(value)),
        }
    }
}

/// The table as CSV with a header; numbers have as many digits as it takes to read them back unchanged.
pub(crate) fn csv<R>(
    table: &str,
    columns: &[Column<R>],
    rows: &[R],
) -> Result<Vec<u8>, ReportError> {
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

/// The table as Parquet: one row group, null in optional columns only, Snappy compression.
pub(crate) fn parquet<R>(
    table: &str,
    columns: &[Column<R>],
    rows: &[R],
) -> Result<Vec<u8>, ReportError> {
    parquet_with(table, columns, rows, &[])
}

/// The same with notes in the file's metadata.
pub(crate) fn parquet_with<R>(
    table: &str,
    columns: &[Column<R>],
    rows: &[R],
    notes: &[(&str, String)],
) -> Result<Vec<u8>, ReportError> {
    encode(columns, rows, notes).map_err(|source| ReportError::Table {
        table: table.to_owned(),
        source: source.into(),
    })
}

fn encode<R>(
    columns: &[Column<R>],
    rows: &[R],
    notes: &[(&str, String)],
) -> Result<Vec<u8>, ParquetError> {
    let fields = columns.iter().map(|column| {
        let (kind, logical) = match column.value {
            Value::Float(_) | Value::Optional(_) => (PhysicalType::DOUBLE, None),
            Value::Integer(_) => (PhysicalType::INT64, None),
            Value::Text(_) => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let repetition = match column.value {
            Value::Optional(_) => Repetition::OPTIONAL,
            _ => Repetition::REQUIRED,
        };
        let field = Type::primitive_type_builder(&column.name, kind)
            .with_repetition(repetition)
            .with_logical_type(logical)
            .build()?;
        Ok(Arc::new(field))
    });
    let fields: Vec<_> = fields.collect::<Result<_, ParquetError>>()?;
    let schema = Type::group_type_builder("table")
        .with_fields(fields)
        .build()?;
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(concat!("percuss ", env!("CARGO_PKG_VERSION")).to_owned())
        .build();
    let mut file = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = file.next_row_group()?;
    let mut columns = columns.iter();
    while let (Some(mut writer), Some(column)) = (group.next_column()?, columns.next()) {
        match &column.value {
            Value::Float(value) => {
                let values: Vec<f64> = rows.iter().map(value).collect();
                writer
                    .typed::<DoubleType>()
                    .write_batch(&values, None, None)?;
            }
            Value::Integer(value) => {
                let values: Vec<i64> = rows.iter().map(value).collect();
                writer
                    .typed::<Int64Type>()
                    .write_batch(&values, None, None)?;
            }
            Value::Optional(value) => {
                let all: Vec<Option<f64>> = rows.iter().map(value).collect();
                let levels: Vec<i16> = all.iter().map(|v| i16::from(v.is_some())).collect();
                let values: Vec<f64> = all.into_iter().flatten().collect();
                writer
                    .typed::<DoubleType>()
                    .write_batch(&values, Some(&levels), None)?;
            }
            Value::Text(value) => {
                let texts = rows.iter().map(|row| ByteArray::from(value(row).as_str()));
                let values: Vec<ByteArray> = texts.collect();
                writer
                    .typed::<ByteArrayType>()
                    .write_batch(&values, None, None)?;
            }
        }
        writer.close()?;
    }
    group.close()?;
    for (key, value) in notes {
        file.append_key_value_metadata(KeyValue::new((*key).to_owned(), value.clone()));
    }
    file.into_inner()
}
