//! Tables of comma-separated values with a row for each material.

use toml::Table;

use super::{cells, keys};
use crate::{
    case::materials_toml,
    check::Check,
    csv_table::{CsvRow, CsvTable, header},
    document::Document,
    error::{Error, InputError},
    lsdyna::Imported,
    material::{Material, MaterialTable},
};

/// Column of the ids.
const ID: &str = "id";

/// A column that is read: its name, the key of a material, and its unit where its name has one.
struct KeyColumn {
    name: String,
    key: String,
    unit: Option<String>,
}

/// Records as a table: a column for each key that one of them has, in dotted form, with units in the cells.
///
/// # Errors
/// The reason, where a record cannot be written.
pub fn csv(records: &MaterialTable) -> Result<String, String> {
    let tables: Table = materials_toml(records)
        .parse()
        .map_err(|error: toml::de::Error| error.to_string())?;
    let rows: Vec<(&String, Vec<(String, String)>)> = tables
        .iter()
        .filter_map(|(id, record)| Some((id, cells::of_table(record.as_table()?))))
        .collect();
    // The order of a record: what it is called, its constants, its strength law.
    let mut columns: Vec<&String> = Vec::new();
    for (_, row) in &rows {
        for (key, _) in row {
            if !columns.contains(&key) {
                columns.push(key);
            }
        }
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: csv::Error| error.to_string();
    let names = std::iter::once(ID).chain(columns.iter().map(|key| key.as_str()));
    writer.write_record(names).map_err(failed)?;
    for (id, row) in &rows {
        let cell = |key: &&String| {
            let found = row.iter().find(|(name, _)| name == *key);
            found.map_or("", |(_, cell)| cell.as_str())
        };
        let cells = std::iter::once(id.as_str()).chain(columns.iter().map(cell));
        writer.write_record(cells).map_err(failed)?;
    }
    let bytes = writer.into_inner().map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|error| error.to_string())
}

/// Reads a table of materials; `file` stands for it in messages. A quantity has its unit in the cell, or in the name of the column as
/// `density (kg/m3)`. Empty cells leave a key out; columns of other names are warnings.
///
/// # Errors
/// [`Error::Input`] with the place of what is not valid.
pub fn read_csv(file: &str, text: &str) -> Result<Imported, Error> {
    let (table, records) = CsvTable::read(file, text)?;
    let (columns, unread) = columns(&table)?;
    let mut found = Imported::default();
    for record in records {
        let row = CsvRow {
            table: &table,
            record,
        };
        let id = row.required(ID)?;
        if found.records.contains_key(&id) {
            let message = format!("a second material has the id `{id}`");
            return Err(row.error(ID, message, "give it another id").into());
        }
        let material = material(&row, &columns)?;
        found.add(id, material);
    }
    if found.records.is_empty() {
        let help = "write one row for each material below the names of the columns";
        let error = table.error(0..0, "", "the file holds no material", help);
        return Err(error.into());
    }
    let note = |name: &String| format!("column `{name}` is not read: no key of a material");
    found.warnings = unread.iter().map(note).collect();
    Ok(found)
}

/// The columns of keys, and the names of others.
fn columns(table: &CsvTable<'_>) -> Result<(Vec<KeyColumn>, Vec<String>), Box<InputError>> {
    let mut columns: Vec<KeyColumn> = Vec::new();
    for (i, name) in table.header.iter().enumerate() {
        let (key, unit) = match name.split_once(['(', '[']) {
            Some((key, unit)) => {
                let unit = unit.trim().trim_end_matches([')', ']']).trim();
                (key.trim(), Some(closed(unit)))
            }
            None => (name.as_str(), None),
        };
        if !keys::known().contains_key(key) {
            continue;
        }
        if columns.iter().any(|column| column.key == key) {
            let span = table.field_span(0, i);
            let message = format!("two columns are of `{key}`");
            return Err(table.error(span, name, message, "remove one"));
        }
        columns.push(KeyColumn {
            name: name.clone(),
            key: key.to_owned(),
            unit: unit.filter(|unit| !unit.is_empty()),
        });
    }
    let read: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
    let read = read.iter().map(String::as_str);
    let known = keys::known().keys().map(String::as_str);
    let known: Vec<&str> = read.chain(known).chain([ID]).collect();
    let unread = header::check(table, &known, &[ID])?;
    Ok((columns, unread))
}

/// A unit whose last bracket was taken for that of the column: `J/(kg K` is `J/(kg K)`.
fn closed(unit: &str) -> String {
    match unit.contains('(') {
        true => format!("{unit})"),
        false => unit.to_owned(),
    }
}

/// The material of a row.
fn material(row: &CsvRow<'_>, columns: &[KeyColumn]) -> Result<Material, Box<InputError>> {
    let mut record = Table::new();
    for column in columns {
        let cell = row.text(&column.name);
        if !cell.is_empty() {
            let value = cells::value(&column.key, cell, column.unit.as_deref());
            cells::put(&mut record, &column.key, value);
        }
    }
    let text = record.to_string();
    let document = Document::new(row.table.file, text).of_materials();
    let at = |key: &str, message: String, help: String| {
        let column = columns.iter().find(|column| column.key == key);
        // A key that is missing, or one of a table, has no column: the row is named by its id.
        let message = match column {
            None if !key.is_empty() => format!("`{key}`: {message}"),
            _ => message,
        };
        let name = column.map_or(ID, |column| column.name.as_str());
        row.error(name, message, help)
    };
    let material: Material = document.parse().map_err(|error| match error {
        Error::Input(error) => at(&error.key, error.message, error.help),
        other => at("", other.to_string(), String::new()),
    })?;
    let mut diagnostics = Vec::new();
    material.check(&mut Check::new(&mut diagnostics));
    match diagnostics.into_iter().next() {
        Some(diagnostic) => Err(at(&diagnostic.key, diagnostic.message, diagnostic.help)),
        None => Ok(material),
    }
}
