//! The keys of a case file, from its schema.

use std::{
    collections::{BTreeSet, VecDeque},
    fmt::Write,
};

use serde_json::{Map, Value};

const INTRODUCTION: &str = "# Keys of a case file

Every table and key of a case file, what it means and what it may be. This page is written from the schema that `percuss schema`
prints; [case files](../case-files.md) explains how they work together. *Required* keys have to be there, all others may be left out.
";

/// The page of all keys.
pub(crate) fn page() -> String {
    let schema = percuss::case::schema();
    let mut page = String::from(INTRODUCTION);
    let mut reference = Reference {
        definitions: &schema["$defs"],
        waiting: VecDeque::new(),
        named: BTreeSet::new(),
    };
    let _ = write!(page, "\n## The file\n\n{}", reference.table(&schema));
    while let Some(name) = reference.waiting.pop_front() {
        let definition = &reference.definitions[name.as_str()];
        let text = description(definition);
        let _ = write!(
            page,
            "\n## {name}\n\n{text}\n\n{}",
            reference.table(definition)
        );
    }
    page
}

/// What is still to be described.
struct Reference<'a> {
    definitions: &'a Value,
    waiting: VecDeque<String>,
    named: BTreeSet<String>,
}

impl Reference<'_> {
    /// The keys of a table, or the choices among several.
    fn table(&mut self, schema: &Value) -> String {
        let mut text = String::new();
        if let Some(properties) = schema["properties"].as_object() {
            let required = |key: &str| {
                let keys = schema["required"].as_array();
                keys.is_some_and(|keys| keys.iter().any(|name| name == key))
            };
            text += "| key | value | meaning |\n|---|---|---|\n";
            for (key, property) in in_order(properties, required) {
                let value = self.value(property);
                let mark = if required(key) { "*required.* " } else { "" };
                // A table of the file that is left out is one of defaults.
                let default = match schema.get("$defs") {
                    Some(_) => String::new(),
                    None => default(property),
                };
                let meaning = cell(&(description(property) + &default));
                let _ = writeln!(text, "| `{key}` | {} | {mark}{meaning} |", cell(&value));
            }
        }
        for choice in choices(schema) {
            let value = self.value(choice);
            let _ = writeln!(text, "- {value}{}", described(choice));
        }
        text
    }

    /// What a value may be, in words.
    fn value(&mut self, schema: &Value) -> String {
        if let Some(name) = schema["$ref"]
            .as_str()
            .and_then(|path| path.rsplit('/').next())
        {
            return self.named(name);
        }
        if let Some(word) = schema.get("const") {
            return format!("`{word}`");
        }
        if let Some(words) = schema["enum"].as_array() {
            let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
            return words.join(", ");
        }
        let found: Vec<&Value> = choices(schema).collect();
        if !found.is_empty() {
            let values: Vec<String> = found.into_iter().map(|choice| self.value(choice)).collect();
            return values.join(" or ");
        }
        match schema["type"].as_str() {
            Some("array") => format!("list of: {}", self.value(&schema["items"])),
            Some("object") if schema["properties"].is_object() => self.inner(&schema["properties"]),
            Some("object") if schema["additionalProperties"].is_object() => {
                format!(
                    "tables by name, each: {}",
                    self.value(&schema["additionalProperties"])
                )
            }
            Some("object") => "table".to_owned(),
            Some("string") => match schema["examples"][0].as_str() {
                Some(example) => format!("text, such as `\"{example}\"`"),
                None => "text".to_owned(),
            },
            Some("integer") => "whole number".to_owned(),
            Some("boolean") => "`true` or `false`".to_owned(),
            Some(kind) => kind.to_owned(),
            None => "any".to_owned(),
        }
    }

    /// A quantity or a word by itself; a table by a link to its section.
    fn named(&mut self, name: &str) -> String {
        let definition = &self.definitions[name];
        if definition["type"] == "string" && definition["pattern"].is_string() {
            let example = definition["examples"][0].as_str().unwrap_or_default();
            return format!("{}, such as `\"{example}\"`", description(definition));
        }
        if self.named.insert(name.to_owned()) {
            self.waiting.push_back(name.to_owned());
        }
        format!("[{name}](#{})", name.to_lowercase())
    }

    /// A table that stands instead of a value.
    fn inner(&mut self, properties: &Value) -> String {
        let keys = properties.as_object().into_iter().flatten();
        let keys: Vec<String> = keys
            .map(|(key, value)| format!("`{key}`: {}", self.value(value)))
            .collect();
        format!("table with {}", keys.join("; "))
    }
}

/// Required keys first.
fn in_order(
    properties: &Map<String, Value>,
    required: impl Fn(&str) -> bool,
) -> Vec<(&String, &Value)> {
    let mut keys: Vec<(&String, &Value)> = properties.iter().collect();
    keys.sort_by_key(|(key, _)| !required(key));
    keys
}

fn choices(schema: &Value) -> impl Iterator<Item = &Value> {
    let lists = ["oneOf", "anyOf"].into_iter();
    lists.filter_map(|list| schema[list].as_array()).flatten()
}

/// What the schema says of a value; brackets stand for themselves in a page as they do in a doc comment.
fn description(schema: &Value) -> String {
    let text = schema["description"].as_str().unwrap_or_default();
    text.replace("\\[", "[").replace("\\]", "]")
}

/// The default of a key as the last sentence of its meaning.
fn default(property: &Value) -> String {
    match property.get("default") {
        None => String::new(),
        Some(Value::Array(items)) if items.is_empty() => String::new(),
        Some(default) => format!(" Default: `{}`.", toml::Value::try_from(default).unwrap()),
    }
}

fn described(schema: &Value) -> String {
    match description(schema) {
        text if text.is_empty() => text,
        text => format!(": {}", text.replace('\n', " ")),
    }
}

/// A text that fits into a cell of a table.
fn cell(text: &str) -> String {
    text.replace('\n', " ").replace('|', "\\|")
}
