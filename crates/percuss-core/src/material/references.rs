//! The bibliography: every source key of materials, cases and equations.

use std::{collections::BTreeMap, sync::LazyLock};

use biblatex::{Bibliography, ChunksExt, DateValue, PermissiveType};

/// A work that numbers or equations come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reference {
    /// Bibliography key.
    pub key: String,
    /// Authors and year, for example `Johnson & Cook 1983`.
    pub label: String,
    /// Title.
    pub title: String,
    /// Where it appeared, or where it can be read.
    pub place: String,
    /// What was read, and what was not.
    pub note: String,
}

static REFERENCES: LazyLock<BTreeMap<String, Reference>> = LazyLock::new(|| {
    let text = include_str!("../../materials/references.bib");
    let bibliography =
        Bibliography::parse(text).unwrap_or_else(|error| panic!("references.bib: {error}"));
    bibliography
        .iter()
        .map(|entry| {
            let authors: Vec<String> = entry
                .author()
                .unwrap_or_default()
                .into_iter()
                .map(|person| {
                    format!("{} {}", person.prefix, person.name)
                        .trim()
                        .to_owned()
                })
                .collect();
            let year = match entry.date() {
                Ok(PermissiveType::Typed(date)) => match date.value {
                    DateValue::At(at) | DateValue::After(at) | DateValue::Before(at) => {
                        at.year.to_string()
                    }
                    DateValue::Between(from, _) => from.year.to_string(),
                },
                _ => "undated".to_owned(),
            };
            let authors = match authors.as_slice() {
                [] => entry.key.clone(),
                [one] => one.clone(),
                [one, others] if others == "others" => format!("{one} et al."),
                [one, two] => format!("{one} & {two}"),
                [one, ..] => format!("{one} et al."),
            };
            let field = |name: &str| {
                entry
                    .get(name)
                    .map_or_else(String::new, ChunksExt::format_verbatim)
            };
            let place = [
                "journaltitle",
                "journal",
                "booktitle",
                "institution",
                "publisher",
                "howpublished",
            ]
            .into_iter()
            .map(field)
            .find(|text| !text.is_empty())
            .unwrap_or_default();
            let reference = Reference {
                key: entry.key.clone(),
                label: format!("{authors} {year}"),
                title: field("title"),
                place,
                note: field("note"),
            };
            (entry.key.clone(), reference)
        })
        .collect()
});

/// All works by key.
pub fn references() -> &'static BTreeMap<String, Reference> {
    &REFERENCES
}
