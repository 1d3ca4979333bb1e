//! Fields of the form, from the schema of case files.

use std::collections::BTreeMap;

use percuss::{case, units};
use serde::Serialize;
use serde_json::{Value, json};

/// Keys that the form shows at once, in this order, with the range of their sliders in SI units. All others are shown on demand.
const COMMON: &[(&str, Option<(f64, f64)>)] = &[
    ("projectile.material", None),
    ("projectile.impact_velocity", Some((0.0, 1500.0))),
    ("projectile.length", Some((1e-3, 50e-3))),
    ("projectile.diameter", Some((1e-3, 20e-3))),
    ("projectile.nose", None),
    ("target.material", None),
    ("target.thickness", Some((1e-3, 50e-3))),
    ("target.back_face", None),
    ("target.layers.*.material", None),
    ("target.layers.*.thickness", Some((1e-3, 50e-3))),
    ("target.layers.*.gap", None),
    ("chain.target_resistance", None),
    ("chain.projectile_elements", Some((10.0, 200.0))),
    ("chain.target_elements", Some((20.0, 400.0))),
];
/// Tables of a case that are no options of a model and no fields either: lists and materials are edited as text.
const TEXT_ONLY: [&str; 5] = [
    "title",
    "sources",
    "experiments",
    "materials",
    "material_files",
];
/// Tables within tables that are followed.
const DEPTH: usize = 4;

/// A field of the form.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Field {
    /// Dotted key; `*` stands for the number of an entry.
    key: String,
    /// What it means, with its unit and its default.
    help: String,
    /// Its default as TOML writes it, where it is one number or word.
    default: Option<String>,
    #[serde(flatten)]
    kind: Kind,
    common: bool,
    /// Whether it stands within one of several forms of a value, and so is there with that form only.
    nested: bool,
    /// Whether it is such a form itself: others stand instead of it.
    alternative: bool,
    /// Range of its slider in SI units.
    slider: Option<(f64, f64)>,
}

/// What a field takes.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Kind {
    /// Name of a material.
    Material,
    /// A number with a unit, or one of a few words.
    Quantity {
        units: Vec<UnitRecord>,
        /// The unit to start with.
        usual: String,
        words: Vec<String>,
    },
    /// A plain number, or one of a few words.
    Number { integer: bool, words: Vec<String> },
    /// `true` or `false`.
    Boolean,
    /// One of a few values, each as TOML writes it.
    Choice { choices: Vec<String> },
    /// Any text.
    Text,
}

/// A unit, for a page that converts between units.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct UnitRecord {
    symbol: &'static str,
    factor: f64,
    offset: f64,
}

/// All fields, those that are shown at once first.
pub(crate) fn fields() -> Vec<Field> {
    let schema = case::schema();
    let mut fields = Vec::new();
    for (name, property) in object(&schema["properties"]) {
        if !TEXT_ONLY.contains(&name.as_str()) {
            add(&schema, name, property, 0, [false; 2], &mut fields);
        }
    }
    // Sorting keeps the order of fields that are alike.
    let place = |key: &str| COMMON.iter().position(|(common, _)| *common == key);
    fields.sort_by_key(|field| place(&field.key).unwrap_or(COMMON.len()));
    fields
}

/// Longest key of a value that a form shows [bytes]. A long key of a table would stand before each of its values.
const LONGEST_KEY: usize = 200;

/// Values of a case by dotted key: what a form shows. Empty for a text that is not TOML.
pub(crate) fn values(text: &str) -> BTreeMap<String, Value> {
    let mut values = BTreeMap::new();
    if let Ok(table) = text.parse::<toml::Table>() {
        for (key, value) in &table {
            collect(key, value, &mut values);
        }
    }
    values
}

fn collect(key: &str, value: &toml::Value, values: &mut BTreeMap<String, Value>) {
    if key.len() > LONGEST_KEY {
        return;
    }
    match value {
        toml::Value::Table(table) => {
            for (name, value) in table {
                collect(&format!("{key}.{name}"), value, values);
            }
        }
        toml::Value::Array(entries) => {
            for (i, value) in entries.iter().enumerate() {
                collect(&format!("{key}.{i}"), value, values);
            }
        }
        toml::Value::String(text) => {
            values.insert(key.to_owned(), json!(text));
        }
        toml::Value::Boolean(value) => {
            values.insert(key.to_owned(), json!(value));
        }
        // As the file has them: JSON has no word for what is no number.
        other => {
            values.insert(key.to_owned(), json!({ "number": other.to_string() }));
        }
    }
}

fn object(value: &Value) -> impl Iterator<Item = (&String, &Value)> {
    value.as_object().into_iter().flatten()
}

/// The definition that a property names, and the name; the property itself where it names none.
fn resolve<'a>(schema: &'a Value, property: &'a Value) -> (&'a str, &'a Value) {
    let place = property["$ref"]
        .as_str()
        .and_then(|at| at.strip_prefix('#'));
    let found = place.and_then(|place| schema.pointer(place));
    match (found, place.and_then(|place| place.rsplit('/').next())) {
        (Some(definition), Some(name)) => (name, definition),
        _ => ("", property),
    }
}

fn add(
    schema: &Value,
    key: &str,
    property: &Value,
    depth: usize,
    [nested, alternative]: [bool; 2],
    fields: &mut Vec<Field>,
) {
    let (_, definition) = resolve(schema, property);
    let tables = object(&definition["properties"]).next().is_some();
    if tables && depth < DEPTH {
        for (name, inner) in object(&definition["properties"]) {
            let inner_key = format!("{key}.{name}");
            add(
                schema,
                &inner_key,
                inner,
                depth + 1,
                [nested, false],
                fields,
            );
        }
        return;
    }
    if definition["type"] == "array" {
        let (_, entry) = resolve(schema, &definition["items"]);
        if object(&entry["properties"]).next().is_some() && depth < DEPTH {
            let flags = [true, false];
            add(schema, &format!("{key}.*"), entry, depth + 1, flags, fields);
        }
        return;
    }
    let common = COMMON.iter().find(|(common, _)| *common == key);
    let default = default(property);
    fields.push(Field {
        key: key.to_owned(),
        help: help(property, definition, default.as_deref()),
        default,
        kind: kind(schema, key, property),
        common: common.is_some(),
        nested,
        alternative,
        slider: common.and_then(|(_, range)| *range),
    });
    // Numbers within one of several forms of a value, such as the length of a cone.
    for variant in definition["oneOf"].as_array().into_iter().flatten() {
        for (name, inner) in object(&variant["properties"]) {
            let inner_key = format!("{key}.{name}");
            if depth < DEPTH {
                add(schema, &inner_key, inner, depth + 1, [true; 2], fields);
            }
        }
    }
}

fn default(property: &Value) -> Option<String> {
    let default = toml::Value::try_from(property.get("default")?).ok()?;
    Some(default.to_string())
}

/// What a key means, and its default.
fn help(property: &Value, definition: &Value, default: Option<&str>) -> String {
    let description = property["description"].as_str();
    let description = description.or(definition["description"].as_str());
    let mut help = description
        .unwrap_or_default()
        .replace("\\[", "[")
        .replace("\\]", "]");
    if let Some(default) = default {
        help += &format!(" Default: {default}.");
    }
    help
}

fn kind(schema: &Value, key: &str, property: &Value) -> Kind {
    if key.ends_with(".material") {
        return Kind::Material;
    }
    let (name, definition) = resolve(schema, property);
    if let Some(units) = unit_records(name) {
        return Kind::Quantity {
            units,
            usual: usual_unit(definition),
            words: Vec::new(),
        };
    }
    if let Some(forms) = definition["anyOf"].as_array() {
        return any_of(schema, forms);
    }
    let choices = choices(schema, definition);
    if !choices.is_empty() {
        return Kind::Choice { choices };
    }
    match definition["type"].as_str() {
        Some("boolean") => Kind::Boolean,
        Some(number @ ("integer" | "number")) => Kind::Number {
            integer: number == "integer",
            words: Vec::new(),
        },
        _ => Kind::Text,
    }
}

fn unit_records(type_name: &str) -> Option<Vec<UnitRecord>> {
    let record = |unit: &units::Unit| UnitRecord {
        symbol: unit.symbol,
        factor: unit.factor,
        offset: unit.offset,
    };
    units::units_of(type_name).map(|units| units.iter().map(record).collect())
}

/// The unit of the example that the schema gives of a quantity.
fn usual_unit(definition: &Value) -> String {
    let example = definition["examples"][0].as_str().unwrap_or_default();
    let unit = example.split_once(' ').map(|(_, unit)| unit);
    unit.unwrap_or_default().to_owned()
}

/// A quantity or a number, or words in its place.
fn any_of(schema: &Value, forms: &[Value]) -> Kind {
    let words: Vec<String> = forms
        .iter()
        .filter_map(|form| form["const"].as_str().map(str::to_owned))
        .collect();
    let quantity = forms.iter().find_map(|form| {
        let (name, definition) = resolve(schema, form);
        Some((unit_records(name)?, usual_unit(definition)))
    });
    if let Some((units, usual)) = quantity {
        return Kind::Quantity {
            units,
            usual,
            words,
        };
    }
    let number = forms
        .iter()
        .find_map(|form| form["type"].as_str().filter(|kind| *kind != "string"));
    match number {
        Some(number @ ("integer" | "number")) => Kind::Number {
            integer: number == "integer",
            words,
        },
        _ => Kind::Text,
    }
}

/// Values that can be chosen from, as TOML writes them.
fn choices(schema: &Value, definition: &Value) -> Vec<String> {
    let of = |form: &Value| -> Vec<String> {
        let named = form["enum"].as_array().into_iter().flatten();
        let words = named.chain(form.get("const")).filter_map(Value::as_str);
        let mut choices: Vec<String> = words.map(|word| format!("\"{word}\"")).collect();
        for (name, inner) in object(&form["properties"]) {
            choices.push(format!("{{ {name} = {} }}", example(schema, inner)));
        }
        choices
    };
    match definition["oneOf"].as_array() {
        Some(forms) => forms.iter().flat_map(of).collect(),
        None => of(definition),
    }
}

/// A value to start with: a quantity is the example of the schema, and a table has what has to be in it. Plain numbers in such tables are
/// ratios or shape factors, for which 1 is as good a start as any.
fn example(schema: &Value, property: &Value) -> String {
    let (name, definition) = resolve(schema, property);
    if let (Some(_), Some(quantity)) = (unit_records(name), definition["examples"][0].as_str()) {
        return format!("\"{quantity}\"");
    }
    if definition["type"] == "number" {
        return "1.0".to_owned();
    }
    // Of several forms the first.
    let form = definition["oneOf"].get(0).unwrap_or(definition);
    let required = form["required"].as_array().into_iter().flatten();
    let values: Vec<String> = required
        .filter_map(Value::as_str)
        .map(|name| format!("{name} = {}", example(schema, &form["properties"][name])))
        .collect();
    match values.is_empty() {
        true => "{}".to_owned(),
        false => format!("{{ {} }}", values.join(", ")),
    }
}

#[cfg(test)]
mod tests;
