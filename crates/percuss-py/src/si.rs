//! Plain numbers in tables of a case: a quantity of the schema gets the SI unit of its dimension.

use std::sync::LazyLock;

use percuss::{case::Case, units::si_unit};
use serde_json::Value as Json;
use toml::{Table, Value};

static SCHEMA: LazyLock<Json> = LazyLock::new(|| schemars::schema_for!(Case).to_value());

/// Adds units to the numbers of a case that need them.
pub fn add_units(case: &mut Table) {
    let root = forms(&SCHEMA);
    for (key, value) in case {
        add(value, &below(&root, key));
    }
}

fn add(value: &mut Value, forms: &[Form<'_>]) {
    match value {
        Value::Integer(number) => {
            if let Some(unit) = unit(forms) {
                *value = Value::String(format!("{number} {unit}"));
            }
        }
        Value::Float(number) => {
            if let Some(unit) = unit(forms) {
                // As many digits as it takes to read the number back unchanged.
                *value = Value::String(format!("{number:?} {unit}"));
            }
        }
        Value::Table(table) => {
            for (key, value) in table {
                add(value, &below(forms, key));
            }
        }
        Value::Array(items) => {
            let forms = forms_of_items(forms);
            for item in items {
                add(item, &forms);
            }
        }
        _ => {}
    }
}

/// One of the forms that a value may have.
struct Form<'a> {
    schema: &'a Json,
    /// SI unit, where it is a quantity.
    unit: Option<&'static str>,
}

/// The forms that a schema allows, references and choices resolved.
fn forms(schema: &Json) -> Vec<Form<'_>> {
    if let Some(name) = schema.get("$ref").and_then(Json::as_str) {
        let name = name.trim_start_matches("#/$defs/");
        let schema = &SCHEMA["$defs"][name];
        return match si_unit(name) {
            Some(unit) => vec![Form {
                schema,
                unit: Some(unit),
            }],
            None => forms(schema),
        };
    }
    let choices = ["anyOf", "oneOf", "allOf"]
        .iter()
        .filter_map(|key| schema.get(key)?.as_array())
        .flatten();
    let own = Form { schema, unit: None };
    std::iter::once(own)
        .chain(choices.flat_map(forms))
        .collect()
}

/// The forms of what stands under a key.
fn below<'a>(forms: &[Form<'a>], key: &str) -> Vec<Form<'a>> {
    let value = |form: &Form<'a>| -> Option<&'a Json> {
        let named = form.schema.get("properties").and_then(|all| all.get(key));
        named.or_else(|| form.schema.get("additionalProperties"))
    };
    forms
        .iter()
        .filter_map(value)
        .flat_map(self::forms)
        .collect()
}

/// The forms of what stands in a list.
fn forms_of_items<'a>(forms: &[Form<'a>]) -> Vec<Form<'a>> {
    let schemas = forms.iter().filter_map(|form| form.schema.get("items"));
    schemas.flat_map(self::forms).collect()
}

/// The unit that a number needs; `None` where a plain number is fine, or nothing is known.
fn unit(forms: &[Form<'_>]) -> Option<&'static str> {
    let is_number = |kind: &Json| ["number", "integer"].iter().any(|name| kind == name);
    let takes_number = |form: &Form<'_>| match form.schema.get("type") {
        Some(Json::Array(kinds)) => kinds.iter().any(is_number),
        Some(kind) => is_number(kind),
        None => false,
    };
    if forms.iter().any(takes_number) {
        return None;
    }
    forms.iter().find_map(|form| form.unit)
}
