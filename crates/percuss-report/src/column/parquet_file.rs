//! Tables as Parquet.

use std::sync::Arc;

use parquet::{
    basic::{Compression, LogicalType, Repetition, Type as PhysicalType},
    data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type},
    errors::ParquetError,
    file::{metadata::KeyValue, properties::WriterProperties, writer::SerializedFileWriter},
    schema::types::Type,
};

use super::{Column, Value};
use crate::ReportError;

/// The table as Parquet, with notes in the file's metadata.
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
