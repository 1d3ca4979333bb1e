//! Keys of a material in dotted form, from its schema.

use std::{collections::BTreeMap, sync::LazyLock};

use serde_json::Value;

use crate::material::Material;

/// Most tables that a key of a material stands in.
const DEEPEST: usize = 4;

/// What stands under a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A text, or a quantity with its unit.
    Text,
    /// A list of texts.
    List,
    /// A number, or whether something holds.
    Plain,
    /// A table without keys: that it is there says all.
    Empty,
}

/// All keys with what stands under them.
pub(super) fn known() -> &'static BTreeMap<String, Kind> {
    static KEYS: LazyLock<BTreeMap<String, Kind>> = LazyLock::new(|| {
        let schema = schemars::schema_for!(Material).to_value();
        let mut keys = BTreeMap::new();
        collect(&schema, &schema, "", 0, &mut keys);
        keys
    });
    &KEYS
}

fn collect(
    root: &Value,
    schema: &Value,
    key: &str,
    depth: usize,
    keys: &mut BTreeMap<String, Kind>,
) {
    if depth > DEEPEST {
        return;
    }
    if let Some(name) = schema.get("$ref").and_then(Value::as_str) {
        let name = name.trim_start_matches("#/$defs/");
        collect(root, &root["$defs"][name], key, depth, keys);
    }
    let choices = ["anyOf", "oneOf", "allOf"].into_iter();
    let choices = choices.filter_map(|name| schema.get(name)?.as_array());
    for choice in choices.flatten() {
        collect(root, choice, key, depth, keys);
    }
    let Some(properties) = schema.get("properties").and_then(Value::as_object) else {
        if let Some(kind) = kind(schema).filter(|_| !key.is_empty()) {
            // A key with several forms takes the text that shows which.
            let first = keys.entry(key.to_owned()).or_insert(kind);
            if kind == Kind::Text {
                *first = kind;
            }
        }
        return;
    };
    for (name, inner) in properties {
        let key = match key {
            "" => name.clone(),
            outer => format!("{outer}.{name}"),
        };
        collect(root, inner, &key, depth + 1, keys);
    }
}

/// Kind of a schema without keys of its own; `None` where it says nothing.
fn kind(schema: &Value) -> Option<Kind> {
    let types = match schema.get("type")? {
        Value::Array(types) => types.iter().filter_map(Value::as_str).collect(),
        one => vec![one.as_str()?],
    };
    let has = |name: &str| types.contains(&name);
    match () {
        () if has("string") => Some(Kind::Text),
        () if has("array") => Some(Kind::List),
        () if has("object") => Some(Kind::Empty),
        () if has("number") || has("integer") || has("boolean") => Some(Kind::Plain),
        () => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, known};

    #[test]
    fn keys_are_those_of_numbers_texts_and_lists() {
        for (key, kind) in [
            ("name", Kind::Text),
            ("density", Kind::Text),
            ("poissons_ratio", Kind::Plain),
            ("aliases", Kind::List),
            ("damage.sources", Kind::List),
            ("recommended", Kind::Plain),
            ("trust", Kind::Text),
            ("strength.elastic", Kind::Empty),
            ("strength.johnson_cook.a", Kind::Text),
            ("strength.power_law.exponent", Kind::Plain),
            ("equation_of_state.gruneisen", Kind::Plain),
        ] {
            assert_eq!(known().get(key), Some(&kind), "{key} in {:?}", known());
        }
        for table in ["strength", "strength.johnson_cook"] {
            assert!(!known().contains_key(table), "{table}");
        }
    }
}
