//! The library of materials: built-in records, and those of a case.

use std::{
    collections::BTreeMap,
    sync::{Arc, LazyLock},
};

use super::{Material, MaterialTable};
use crate::{
    check::{Check, Diagnostic},
    document::Document,
    error::Error,
};

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../materials/", $name)))),*]
    };
}

/// Built-in material files. Adding one is one file in `materials/` and one line here.
const FILES: &[(&str, &str)] = files![
    "borvik2002.toml",
    "brittle.toml",
    "floresjohnson2011.toml",
    "forrestal1994.toml",
    "holtz.toml",
    "johnson1983.toml",
    "johnson1989.toml",
    "lesuer2000.toml",
    "lesuer2001.toml",
    "meyer2001.toml",
    "payette.toml",
    "ryan2023.toml",
    "steinberg1996.toml",
    "vaango.toml",
    "woodward1982.toml",
];

/// A material with its id and the place it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialEntry {
    /// Id: the name of its table.
    pub id: String,
    /// File or case that holds it.
    pub origin: String,
    /// The record.
    pub material: Arc<Material>,
}

/// A name as aliases are written: lower case, with hyphens for blanks and `_`.
pub(super) fn alias_form(name: &str) -> String {
    name.trim().to_lowercase().replace([' ', '_'], "-")
}

/// The record where there is just one.
fn only<'a>(found: impl IntoIterator<Item = &'a MaterialEntry>) -> Option<&'a MaterialEntry> {
    let mut found = found.into_iter();
    found.next().filter(|_| found.next().is_none())
}

/// Materials by id and by family.
#[derive(Debug, Clone, Default)]
pub struct Library {
    entries: BTreeMap<String, MaterialEntry>,
}

static BUILT_IN: LazyLock<Result<Library, Error>> = LazyLock::new(|| {
    let mut library = Library::default();
    for (file, text) in FILES {
        let document = Document::new(file, *text).of_materials();
        let table: MaterialTable = document.parse()?;
        let mut diagnostics: Vec<Diagnostic> = Vec::new();
        for (id, material) in &table {
            material.check(&mut Check::new(&mut diagnostics).within(id));
        }
        document.report(diagnostics)?;
        library.add(&table, file);
    }
    Ok(library)
});

impl Library {
    /// The materials that the program ships.
    ///
    /// # Panics
    /// When a shipped file is not valid, which the library's own tests rule out.
    pub fn built_in() -> &'static Self {
        match &*BUILT_IN {
            Ok(library) => library,
            Err(error) => panic!("built-in materials: {error}"),
        }
    }

    /// Adds records; one with an id that exists already replaces it.
    pub fn add(&mut self, table: &MaterialTable, origin: &str) {
        for (id, material) in table {
            let mut material = material.clone();
            if material.name.is_empty() {
                material.name.clone_from(id);
            }
            let entry = MaterialEntry {
                id: id.clone(),
                origin: origin.to_owned(),
                material: Arc::new(material),
            };
            self.entries.insert(id.clone(), entry);
        }
    }

    /// All records in the order of their ids.
    pub fn iter(&self) -> impl Iterator<Item = &MaterialEntry> {
        self.entries.values()
    }

    /// The record with this id, or the recommended one of the family with this name, or the one to which an alias leads.
    ///
    /// Where none has just this name, case does not matter and a blank or `_` stands for `-`. An alias of several families leads
    /// nowhere; [`Library::suggestion`] lists them.
    pub fn find(&self, name: &str) -> Option<&MaterialEntry> {
        let form = alias_form(name);
        self.entries
            .get(name)
            .or_else(|| self.recommended(|family| family == name))
            .or_else(|| only(self.with_alias(name)))
            .or_else(|| only(self.iter().filter(|entry| alias_form(&entry.id) == form)))
            .or_else(|| self.recommended(|family| alias_form(family) == form))
    }

    /// The recommended record of the first family that is meant.
    fn recommended(&self, is_meant: impl Fn(&str) -> bool) -> Option<&MaterialEntry> {
        self.iter().find(|entry| {
            entry.material.recommended && entry.material.family.as_deref().is_some_and(&is_meant)
        })
    }

    /// The records to which an alias leads, one of each family: the recommended one where it has the alias. Case does not matter, and a
    /// blank or `_` stands for `-`.
    pub fn with_alias(&self, name: &str) -> Vec<&MaterialEntry> {
        let alias = alias_form(name);
        let mut found: Vec<&MaterialEntry> = Vec::new();
        for entry in self.iter() {
            if !entry.material.aliases.contains(&alias) {
                continue;
            }
            let family = &entry.material.family;
            let rival =
                |other: &&mut &MaterialEntry| family.is_some() && other.material.family == *family;
            match found.iter_mut().find(rival) {
                Some(other) if entry.material.recommended => *other = entry,
                Some(_) => {}
                None => found.push(entry),
            }
        }
        found
    }

    /// The records of a family, or of the family that a record belongs to.
    pub fn rivals<'a>(
        &'a self,
        entry: &'a MaterialEntry,
    ) -> impl Iterator<Item = &'a MaterialEntry> {
        self.iter().filter(move |other| {
            other.id != entry.id
                && other.material.family.is_some()
                && other.material.family == entry.material.family
        })
    }
}
