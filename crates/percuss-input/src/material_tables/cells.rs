//! Values of a material as cells of a table.

use toml::{Table, Value};

/// Keys whose values are texts, whatever they look like.
const TEXTS: [&str; 9] = [
    "name",
    "family",
    "group",
    "state",
    "trust",
    "note",
    "calibrated.from",
    "calibrated.model",
    "calibrated.percuss_version",
];
/// Keys of lists of texts.
const LISTS: [&str; 5] = [
    "aliases",
    "sources",
    "calibrated.parameters",
    "calibrated.sources",
    "calibrated.shots",
];
/// What stands between the items of a list.
const SEPARATOR: char = ';';

/// Cells of a table by their keys in dotted form.
pub(super) fn of_table(table: &Table) -> Vec<(String, String)> {
    let mut cells = Vec::new();
    add(table, "", &mut cells);
    cells
}

fn add(table: &Table, outer: &str, cells: &mut Vec<(String, String)>) {
    for (name, value) in table {
        let key = match outer {
            "" => name.clone(),
            outer => format!("{outer}.{name}"),
        };
        match value {
            Value::Table(inner) => add(inner, &key, cells),
            Value::String(text) => cells.push((key, text.clone())),
            Value::Array(items) if LISTS.contains(&key.as_str()) => {
                let items: Vec<&str> = items.iter().filter_map(Value::as_str).collect();
                cells.push((key, items.join(&format!("{SEPARATOR} "))));
            }
            other => cells.push((key, other.to_string())),
        }
    }
}

/// Value of a cell; `unit` is that of its column.
pub(super) fn value(key: &str, cell: &str, unit: Option<&str>) -> Value {
    if let Some(unit) = unit {
        return Value::String(format!("{cell} {unit}"));
    }
    if LISTS.contains(&key) {
        let items = cell.split(SEPARATOR).map(str::trim);
        let items = items.filter(|item| !item.is_empty());
        return Value::Array(items.map(|item| Value::String(item.to_owned())).collect());
    }
    if TEXTS.contains(&key) {
        return Value::String(cell.to_owned());
    }
    let parsed: Option<Table> = format!("x = {cell}").parse().ok();
    let number = cell.parse::<f64>().ok().map(Value::Float);
    let of_toml = parsed.and_then(|mut table| table.remove("x"));
    of_toml
        .or(number)
        .unwrap_or_else(|| Value::String(cell.to_owned()))
}

/// Puts a value under a key in dotted form; a table is made where there is none.
pub(super) fn put(table: &mut Table, key: &str, value: Value) {
    match key.split_once('.') {
        None => {
            table.insert(key.to_owned(), value);
        }
        Some((outer, rest)) => {
            let inner = table
                .entry(outer)
                .or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(inner) = inner {
                put(inner, rest, value);
            }
        }
    }
}
