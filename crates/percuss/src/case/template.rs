//! A case whose numbers can be changed before it becomes a scenario.

use std::path::Path;

use serde::Deserialize;
use toml::{Table, Value};

use super::{Case, Document, load, reword::reword};
use crate::{check::Finding, error::Error, material::Library, scenario::Scenario};

/// A case as a table of values, with the materials that it can name.
#[derive(Debug, Clone)]
pub(crate) struct Template {
    name: String,
    table: Table,
    library: Library,
    /// What the case and the files that it names say, without comments and in one order of keys.
    pub(crate) content: String,
}

impl Template {
    /// Reads a case file, which has to be valid as it stands.
    pub(crate) fn read(path: &Path) -> Result<Self, Error> {
        let scenario = load::load(path)?;
        let document = Document {
            file: path.display().to_string(),
            text: load::read_text(path)?,
        };
        let mut table: Table = document.parse()?;
        // No shot depends on what is uncertain.
        table.remove("uncertainty");
        let mut case: Case = document.parse()?;
        // Its own materials are among the numbers that can be changed: only those of other files are looked up beforehand.
        case.materials.clear();
        let directory = path.parent().map(Path::to_path_buf).unwrap_or_default();
        let library = load::library_of(&case, &document, &scenario.name, Some(&directory))?;
        let mut content = table.to_string();
        for file in &case.material_files {
            let text = load::read_text(&directory.join(file))?;
            let document = Document {
                file: file.display().to_string(),
                text,
            };
            content += &document.parse::<Table>()?.to_string();
        }
        Ok(Self {
            name: scenario.name,
            table,
            library,
            content,
        })
    }

    /// Name of the case.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The scenario with other values under some dotted keys.
    pub(crate) fn scenario(&self, changes: &[(&str, Value)]) -> Result<Scenario, Vec<Finding>> {
        let mut table = self.table.clone();
        for (key, value) in changes {
            put(&mut table, key, value.clone()).map_err(|message| {
                vec![Finding {
                    key: (*key).to_owned(),
                    message,
                    help: "name a number of the case by the tables that it stands in, such as projectile.velocity".to_owned(),
                }]
            })?;
        }
        let case = Case::deserialize(table).map_err(|error| {
            let source = changes
                .last()
                .map_or_else(String::new, |(_, v)| v.to_string());
            let said = reword(error.message(), &source);
            vec![Finding {
                key: String::new(),
                message: said.message,
                help: said.help,
            }]
        })?;
        case.into_scenario(&self.name, &self.library)
    }
}

/// Puts a value under a dotted key; tables on the way are made where a default stands in for them.
fn put(table: &mut Table, key: &str, value: Value) -> Result<(), String> {
    let parts: Vec<&str> = key.split('.').collect();
    let Some((last, way)) = parts.split_last() else {
        return Err("the key is empty".to_owned());
    };
    let mut at: Option<&mut Value> = None;
    for (depth, part) in way.iter().enumerate() {
        let here = parts[..=depth].join(".");
        let list_is_due = parts[depth + 1].parse::<usize>().is_ok();
        let next = match at {
            None => table
                .entry(*part)
                .or_insert_with(|| Value::Table(Table::new())),
            Some(Value::Table(inner)) => inner
                .entry(*part)
                .or_insert_with(|| Value::Table(Table::new())),
            Some(Value::Array(items)) => {
                let count = items.len();
                let item = part.parse::<usize>().ok().and_then(|i| items.get_mut(i));
                item.ok_or_else(|| {
                    format!(
                        "the case has no `{here}`: the list has {count} entries, counted from 0"
                    )
                })?
            }
            Some(_) => return Err(format!("the case has no table above `{here}`")),
        };
        if list_is_due && !next.is_array() {
            return Err(format!("the case has no list `{here}`"));
        }
        at = Some(next);
    }
    match at {
        None => {
            table.insert((*last).to_owned(), value);
        }
        Some(Value::Table(inner)) => {
            inner.insert((*last).to_owned(), value);
        }
        Some(_) => return Err(format!("the case has no table that `{key}` could stand in")),
    }
    Ok(())
}
