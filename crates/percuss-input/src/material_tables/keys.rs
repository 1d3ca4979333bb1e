//! Keys of a material in dotted form, from its schema.

use std::{collections::BTreeSet, sync::LazyLock};

use serde_json::Value;

use crate::material::Material;

/// Most tables that a key of a material stands in.
const DEEPEST: usize = 4;

/// All keys of numbers, texts and lists.
pub(super) fn known() -> &'static BTreeSet<String> {
    static KEYS: LazyLock<BTreeSet<String>> = LazyLock::new(|| {
        let schema = schemars::schema_for!(Material).to_value();
        let mut keys = BTreeSet::new();
        collect(&schema, &schema, "", 0, &mut keys);
        keys
    });
    &KEYS
}

fn collect(root: &Value, schema: &Value, key: &str, depth: usize, keys: &mut BTreeSet<String>) {
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
        if schema.get("type").is_some() && schema["type"] != "null" && !key.is_empty() {
            keys.insert(key.to_owned());
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

#[cfg(test)]
mod tests {
    use super::known;

    #[test]
    fn keys_are_those_of_numbers_texts_and_lists() {
        for key in [
            "name",
            "density",
            "poissons_ratio",
            "aliases",
            "recommended",
            "trust",
            "strength.johnson_cook.a",
            "strength.power_law.exponent",
            "equation_of_state.gruneisen",
        ] {
            assert!(known().contains(key), "{key} is not in {:?}", known());
        }
        assert!(!known().contains("strength") && !known().contains("strength.johnson_cook"));
    }
}
