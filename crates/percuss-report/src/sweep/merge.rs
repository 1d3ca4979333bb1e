//! Merge of all rows into one file.

use std::{
    fs::{self, File},
    io,
    path::{Path, PathBuf},
    sync::Arc,
};

use parquet::{
    basic::Type as PhysicalType,
    column::{reader::ColumnReader, writer::ColumnCloseResult},
    data_type::DoubleType,
    errors::ParquetError,
    file::{
        metadata::KeyValue,
        properties::WriterProperties,
        reader::{FileReader, SerializedFileReader},
        writer::{SerializedFileWriter, SerializedRowGroupWriter},
    },
    schema::types::Type,
};

use percuss::{
    input_file::{self, MAX_OWN_BYTES},
    units::UnitSystem,
};

use super::{block_file, is_sweep_file, manifest::Manifest, merge_csv, parts::Parts};
use crate::{ReportError, replace_file::replace_file_durably};

/// Joins the blocks of folders that hold parts of one sweep into one file, in the order of the runs: CSV where its name ends with
/// `.csv`, Parquet with a row group per block where it ends with `.parquet`. Columns are in the units of a system where one is given. The file depends on the sweep alone, not on who computed which block. Returns the number of rows.
///
/// # Errors
/// [`ReportError::Sweep`] when a folder holds another sweep or a block is missing; [`ReportError::Write`]; [`ReportError::Table`].
pub fn merge(
    folders: &[PathBuf],
    out: &Path,
    units: Option<UnitSystem>,
) -> Result<u64, ReportError> {
    let parts = Parts::open(folders)?;
    let files: Vec<Option<PathBuf>> = parts.files().collect();
    let missing = files.iter().filter(|file| file.is_none()).count();
    if let Some(block) = files.iter().position(Option::is_none) {
        return Err(ReportError::Sweep {
            path: parts.first().to_owned(),
            reason: format!(
                "{missing} of {} blocks {} missing or damaged, the first is {}",
                files.len(),
                if missing == 1 { "is" } else { "are" },
                block_file(block as u64)
            ),
            remedy: "`percuss sweep SWEEP.toml --out DIR --resume` computes them".to_owned(),
        });
    }
    let files: Vec<PathBuf> = files.into_iter().flatten().collect();
    // A pipe or a device would become a file.
    if fs::metadata(out).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return Err(ReportError::Write {
            path: out.to_owned(),
            source: io::Error::other("it is not a regular file"),
        });
    }
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    let folder = match out.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if is_part(folders, folder, &name) {
        return Err(ReportError::Sweep {
            path: out.to_owned(),
            reason: "this is a file of a folder that is merged".to_owned(),
            remedy: "give `--out` another name".to_owned(),
        });
    }
    if !is_csv(out) && !has_extension(out, "parquet") {
        return Err(ReportError::Sweep {
            path: out.to_owned(),
            reason: "the name of a file of rows ends with `.parquet` or `.csv`".to_owned(),
            remedy: "give `--out` such a name".to_owned(),
        });
    }
    fs::create_dir_all(folder).map_err(|source| ReportError::Write {
        path: folder.to_owned(),
        source,
    })?;
    replace_file_durably(folder, &name, |file| {
        // What is wrong with the blocks comes out as an error of the system too: their footers were read before.
        let joined = match is_csv(out) {
            true => merge_csv::write(&files, units, file),
            false => join(&files, &parts.manifest, units, file),
        };
        joined.map_err(io::Error::other)
    })?;
    Ok(parts.manifest.runs)
}

/// Whether a file is to have comma-separated values, by its name.
fn is_csv(out: &Path) -> bool {
    has_extension(out, "csv")
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension()
        .is_some_and(|own| own.eq_ignore_ascii_case(extension))
}

/// Name and factor of a column of numbers in a unit system; `None` where it stays as it is.
fn conversion(column: &Type, units: Option<UnitSystem>) -> Option<(String, f64)> {
    let is_number = column.is_primitive() && column.get_physical_type() == PhysicalType::DOUBLE;
    let units = units.filter(|_| is_number)?;
    units.column(column.name())
}

/// The schema with the names of columns in a unit system.
fn converted_schema(
    schema: Arc<Type>,
    units: Option<UnitSystem>,
) -> Result<Arc<Type>, ParquetError> {
    let fields = schema.get_fields().iter().map(|field| {
        let Some((name, _)) = conversion(field, units) else {
            return Ok(Arc::clone(field));
        };
        let renamed = Type::primitive_type_builder(&name, field.get_physical_type())
            .with_repetition(field.get_basic_info().repetition());
        Ok(Arc::new(renamed.build()?))
    });
    let fields: Vec<Arc<Type>> = fields.collect::<Result<_, ParquetError>>()?;
    let group = Type::group_type_builder(schema.name()).with_fields(fields);
    Ok(Arc::new(group.build()?))
}

/// Writes a column of numbers times a factor.
fn scale(
    source: ColumnReader,
    rows: usize,
    factor: f64,
    group: &mut SerializedRowGroupWriter<'_, &mut File>,
) -> Result<(), ParquetError> {
    let ColumnReader::DoubleColumnReader(mut source) = source else {
        return Err(ParquetError::General(
            "a column of numbers has texts".to_owned(),
        ));
    };
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    source.read_records(rows, Some(&mut levels), None, &mut values)?;
    values.iter_mut().for_each(|value| *value *= factor);
    let Some(mut column) = group.next_column()? else {
        return Err(ParquetError::General("a column is missing".to_owned()));
    };
    let levels = (!levels.is_empty()).then_some(levels.as_slice());
    let writer = column.typed::<DoubleType>();
    writer.write_batch(&values, levels, None)?;
    column.close()
}

/// Whether a name in a folder is that of a file that a sweep's folder holds, one of `folders`.
fn is_part(folders: &[PathBuf], folder: &Path, name: &str) -> bool {
    let real = |path: &Path| path.canonicalize().ok();
    let is_merged = folders
        .iter()
        .any(|merged| real(merged).is_some_and(|merged| Some(merged) == real(folder)));
    is_merged && is_sweep_file(name)
}

/// Copies the encoded columns; only those in other units are decoded, a block at a time, so that memory stays flat.
fn join(
    files: &[PathBuf],
    manifest: &Manifest,
    units: Option<UnitSystem>,
    out: &mut File,
) -> Result<(), ParquetError> {
    let open = |path: &PathBuf| {
        input_file::open(path, MAX_OWN_BYTES)
            .map_err(|error| ParquetError::General(error.to_string()))
    };
    let Some(first) = files.first() else {
        return Ok(());
    };
    let schema = SerializedFileReader::new(open(first)?)?
        .metadata()
        .file_metadata()
        .schema_descr()
        .root_schema_ptr();
    let schema = converted_schema(schema, units)?;
    let properties = WriterProperties::builder()
        .set_created_by(concat!("percuss ", env!("CARGO_PKG_VERSION")).to_owned())
        .build();
    let mut writer = SerializedFileWriter::new(out, schema, Arc::new(properties))?;
    for path in files {
        let source = open(path)?;
        let reader = SerializedFileReader::new(open(path)?)?;
        let rows = reader.get_row_group(0)?;
        let group = rows.metadata();
        let mut copy = writer.next_row_group()?;
        for (at, column) in group.columns().iter().enumerate() {
            if let Some((_, factor)) = conversion(column.column_descr().self_type(), units) {
                let count = group.num_rows() as usize;
                scale(rows.get_column_reader(at)?, count, factor, &mut copy)?;
                continue;
            }
            copy.append_column(
                &source,
                ColumnCloseResult {
                    bytes_written: column.compressed_size() as u64,
                    rows_written: group.num_rows() as u64,
                    metadata: column.clone(),
                    bloom_filter: None,
                    column_index: None,
                    offset_index: None,
                },
            )?;
        }
        copy.close()?;
    }
    // Whoever gets the file alone learns from it what it is.
    writer.append_key_value_metadata(KeyValue::new(
        "percuss.manifest".to_owned(),
        manifest.text(),
    ));
    writer.close()?;
    Ok(())
}
