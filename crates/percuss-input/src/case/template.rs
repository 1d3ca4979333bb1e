//! A case whose numbers can be changed before it becomes a scenario.

use std::{borrow::Cow, fmt, path::Path, sync::Arc};

use serde::Deserialize;
use toml::{Table, Value};

use super::{Case, ChainOptions, Document, load};
use crate::{
    check::Diagnostic,
    document::reword_toml_error,
    error::Error,
    material::{Library, Material},
    scenario::Scenario,
};

/// A change of every scenario of a study that no file can write, such as a strength law of the caller.
#[derive(Clone)]
pub struct ScenarioChange {
    /// What tells it from other changes: results of one do not go on with another.
    pub name: String,
    /// The scenario with the change.
    pub change: Arc<dyn Fn(Scenario) -> Scenario + Send + Sync>,
}

impl fmt::Debug for ScenarioChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

/// A case as a table of values, with the materials that it can name.
#[derive(Debug, Clone)]
pub struct Template {
    name: String,
    table: Table,
    library: Library,
    change: Option<ScenarioChange>,
    /// What the case and the files that it names say, without comments and in one order of keys.
    pub content: String,
}

impl Template {
    /// Reads a case, which has to be valid as it stands.
    pub fn of(document: &Document) -> Result<Self, Error> {
        load::scenario_of_models(document)?;
        let mut table: Table = document.parse()?;
        // No run depends on what is uncertain or was measured.
        table.remove("uncertainty");
        table.remove("measured_curves");
        let mut case: Case = document.parse()?;
        // Its own materials are among the numbers that can be changed: only those of other files are looked up beforehand.
        case.materials.clear();
        let library = load::library_of(&case, document)?;
        let mut content = table.to_string();
        for file in &case.material_files {
            let file = Document::read(document.folder().unwrap_or(Path::new("")).join(file))?;
            content += &file.parse::<Table>()?.to_string();
        }
        Ok(Self {
            name: document.name.clone(),
            table,
            library,
            change: None,
            content,
        })
    }

    /// A case that comes from no file.
    pub fn of_case(name: &str, case: &Case, library: &Library) -> Result<Self, Error> {
        // There is nothing in a case that TOML could not hold.
        let table = Table::try_from(case).map_err(|error| Error::Read {
            path: name.into(),
            reason: error.to_string(),
            remedy: String::new(),
            source: None,
        })?;
        Ok(Self {
            name: name.to_owned(),
            content: table.to_string(),
            table,
            library: library.clone(),
            change: None,
        })
    }

    /// The same with a change of every scenario.
    #[must_use]
    pub fn with_change(self, change: ScenarioChange) -> Self {
        Self {
            content: format!("{}\n{}", self.content, change.name),
            change: Some(change),
            ..self
        }
    }

    /// Name of the case.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Title of the case; empty where it has none.
    pub fn title(&self) -> &str {
        let title = self.table.get("title").and_then(Value::as_str);
        title.unwrap_or_default().trim()
    }

    /// The scenario with other values under some dotted keys.
    pub fn scenario(&self, changes: &[(&str, Value)]) -> Result<Scenario, Vec<Diagnostic>> {
        let table = self.changed(changes)?;
        let case = Case::deserialize(table).map_err(|error| {
            let source = changes
                .last()
                .map_or_else(String::new, |(_, v)| v.to_string());
            let said = reword_toml_error(error.message(), &source);
            vec![Diagnostic::whole(said.message, said.help)]
        })?;
        let mut scenario = case.into_scenario(&self.name, &self.library)?;
        // All cases of a sweep have one target resistance model, also where a varied number happens to be its default.
        let mut keys = changes.iter().map(|(key, _)| *key);
        if let Some(key) = keys.find(|key| ChainOptions::is_of_a_column(key)) {
            scenario.choose_column(key);
        }
        Ok(match &self.change {
            Some(own) => (own.change)(scenario),
            None => scenario,
        })
    }

    /// A material of the case with other values under some dotted keys; `None` if there is no such material.
    pub fn material(
        &self,
        id: &str,
        changes: &[(&str, Value)],
    ) -> Result<Option<Material>, Vec<Diagnostic>> {
        let table = self.changed(changes)?;
        let id = self.record_of(id);
        let own = table.get("materials").and_then(|own| own.get(id));
        let read = |own: &Value| Material::deserialize(own.clone()).ok();
        Ok(own.and_then(read).or_else(|| {
            let entry = self.library.find(id)?;
            Some((*entry.material).clone())
        }))
    }

    fn changed(&self, changes: &[(&str, Value)]) -> Result<Table, Vec<Diagnostic>> {
        let mut table = self.table.clone();
        for (key, value) in changes {
            let key = &*self.key_of_record(key);
            self.adopt(&mut table, key)
                .map_err(|diagnostic| vec![diagnostic])?;
            other_law(&table, key)
                .or_else(|| other_nose(&table, key))
                .map_or(Ok(()), |diagnostic| Err(vec![diagnostic]))?;
            put(&mut table, key, value.clone()).map_err(|message| {
                let help = "name a number of the case by the tables that it stands in, such as projectile.impact_velocity";
                vec![Diagnostic::at(key, message, help)]
            })?;
        }
        Ok(table)
    }

    /// Id of the record that a name selects; the name itself where no record answers to it.
    fn record_of<'a>(&'a self, name: &'a str) -> &'a str {
        let own = self.table.get("materials").and_then(|own| own.get(name));
        match (own, self.library.find(name)) {
            (None, Some(entry)) => &entry.id,
            _ => name,
        }
    }

    /// A key with the id of its material in place of a family or an alias: the case may name the same record differently, and a changed
    /// copy under another id would have no effect.
    fn key_of_record<'a>(&self, key: &'a str) -> Cow<'a, str> {
        let Some((name, rest)) = material_of(key) else {
            return Cow::Borrowed(key);
        };
        match self.record_of(name) {
            id if id == name => Cow::Borrowed(key),
            id => Cow::Owned(format!("materials.{id}.{rest}")),
        }
    }

    /// Whether two keys name one number, such as one by the id and one by an alias of a material.
    pub fn is_same_number(&self, one: &str, other: &str) -> bool {
        self.key_of_record(one) == self.key_of_record(other)
    }

    /// The material of a key, if there is such a record and no part of the case is made of it: then no change of it has an effect.
    pub fn unused_material<'a>(&self, key: &'a str) -> Option<&'a str> {
        let (name, _) = material_of(key)?;
        let record = self.record_of(name);
        let part = |part: &str| self.table.get(part)?.get("material")?.as_str();
        let layers = self
            .table
            .get("target")
            .and_then(|target| target.get("layers")?.as_array());
        let of_layers = layers
            .into_iter()
            .flatten()
            .filter_map(|layer| layer.get("material")?.as_str());
        let mut used = ["projectile", "target"]
            .into_iter()
            .filter_map(part)
            .chain(of_layers);
        match used.any(|used| self.record_of(used) == record) {
            true => None,
            false => Some(name),
        }
    }

    /// Puts the library's record of a material into the case that a key changes a number of, unless the case has its own.
    fn adopt(&self, table: &mut Table, key: &str) -> Result<(), Diagnostic> {
        let Some((id, _)) = material_of(key) else {
            return Ok(());
        };
        let own = table
            .entry("materials")
            .or_insert_with(|| Value::Table(Table::new()));
        let Some(own) = own.as_table_mut().filter(|own| !own.contains_key(id)) else {
            return Ok(());
        };
        let fail = |message: String, help: String| {
            Diagnostic::at(&format!("materials.{id}"), message, help).of_material()
        };
        let entry = self.library.find(id).ok_or_else(|| {
            let near = self.library.suggestion(id);
            fail(
                self.library.unknown(id),
                format!("{near}`percuss materials` lists all"),
            )
        })?;
        let record = Value::try_from(&*entry.material)
            .map_err(|error| fail(error.to_string(), String::new()))?;
        own.insert(id.to_owned(), record);
        Ok(())
    }
}

/// Name of the material whose number a key is, and the key within its record.
fn material_of(key: &str) -> Option<(&str, &str)> {
    key.strip_prefix("materials.")?.split_once('.')
}

/// What is wrong with a constant of another strength law than that of the material.
fn other_law(table: &Table, key: &str) -> Option<Diagnostic> {
    let (id, rest) = material_of(key)?;
    let (law, _) = rest.strip_prefix("strength.")?.split_once('.')?;
    let strength = table
        .get("materials")?
        .get(id)?
        .get("strength")?
        .as_table()?;
    let (own, constants) = strength.iter().next().filter(|(own, _)| *own != law)?;
    let constants = constants.as_table().into_iter().flatten();
    let constants =
        constants.filter(|(_, value)| value.is_str() || value.is_integer() || value.is_float());
    let constants: Vec<&str> = constants.map(|(name, _)| name.as_str()).collect();
    let message = format!("`{id}` has the strength law `{own}`, not `{law}`");
    let help = format!(
        "name a constant of that law, materials.{id}.strength.{own}.NAME; its record has {}",
        constants.join(", ")
    );
    Some(Diagnostic::at(key, message, help))
}

/// What is wrong with a dimension of the nose that is not the one that the case gives.
fn other_nose(table: &Table, key: &str) -> Option<Diagnostic> {
    let varied = key.strip_prefix("projectile.nose.")?;
    let nose = table.get("projectile")?.get("nose")?.as_table()?;
    let (shape, dimensions) = nose.iter().next()?;
    let dimension = dimensions.as_table()?.keys().next()?;
    let given = format!("{shape}.{dimension}");
    (given != varied).then(|| {
        let message = format!("the case gives its nose by `{given}`, not by `{varied}`");
        let help =
            format!("name projectile.nose.{given}, or give the nose of the case by `{varied}`");
        Diagnostic::at(key, message, help)
    })
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
        let inner = parts[depth + 1];
        let next = match at {
            None => table
                .entry(*part)
                .or_insert_with(|| Value::Table(Table::new())),
            Some(Value::Table(inner)) => inner
                .entry(*part)
                .or_insert_with(|| Value::Table(Table::new())),
            Some(Value::Array(items)) => {
                let count = items.len();
                // One number has one key: `00` and `+0` are none.
                let index = part.parse::<usize>().ok();
                let index = index.filter(|index| index.to_string() == *part);
                let item = index.and_then(|i| items.get_mut(i));
                item.ok_or_else(|| {
                    format!(
                        "the case has no `{here}`: the list has {count} entries, counted from 0"
                    )
                })?
            }
            Some(_) => return Err(format!("the case has no table above `{here}`")),
        };
        // Digits are an index, unless a table has them for a key: ids of materials may be nothing but digits.
        let is_key = next
            .as_table()
            .is_some_and(|table| table.contains_key(inner));
        if inner.parse::<usize>().is_ok() && !next.is_array() && !is_key {
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
