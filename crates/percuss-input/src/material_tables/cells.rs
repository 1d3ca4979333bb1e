//! Values of a material as cells of a table.

use toml::{Table, Value};

use super::keys::{Kind, known};

/// What stands for a table without keys.
const PRESENT: &str = "yes";
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
            Value::Table(inner) if inner.is_empty() => cells.push((key, PRESENT.to_owned())),
            Value::Table(inner) => add(inner, &key, cells),
            Value::String(text) => cells.push((key, text.clone())),
            Value::Array(items) => {
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
    let text = || Value::String(cell.to_owned());
    match known().get(key) {
        Some(Kind::List) => {
            let items = cell.split(SEPARATOR).map(str::trim);
            let items = items.filter(|item| !item.is_empty());
            Value::Array(items.map(|item| Value::String(item.to_owned())).collect())
        }
        Some(Kind::Plain) => match (cell.to_lowercase().as_str(), cell.parse::<f64>()) {
            ("true", _) => Value::Boolean(true),
            ("false", _) => Value::Boolean(false),
            (_, Ok(number)) => whole(number).unwrap_or(Value::Float(number)),
            _ => text(),
        },
        Some(Kind::Empty) if cell == PRESENT => Value::Table(Table::new()),
        _ => text(),
    }
}

/// A whole number, which a key may need.
fn whole(number: f64) -> Option<Value> {
    let is_whole = number.fract() == 0.0 && number.abs() < 1e15;
    is_whole.then_some(Value::Integer(number as i64))
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
