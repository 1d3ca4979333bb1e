//! The JSON Schema of case files.

use serde_json::{Value, json};

use super::Case;

/// The JSON Schema (draft 2020-12) of case files: every key with what it means, the units allowed and the values allowed.
pub fn schema() -> Value {
    let mut schema = schemars::schema_for!(Case).to_value();
    remove_null(&mut schema);
    schema
}

/// Removes what allows null: a TOML file has none, and editors would offer it.
fn remove_null(schema: &mut Value) {
    match schema {
        Value::Object(object) => {
            object.retain(|_, value| !value.is_null());
            if let Some(Value::Array(types)) = object.get_mut("type") {
                types.retain(|name| name != "null");
                if let [only] = types.as_slice() {
                    let only = only.clone();
                    object.insert("type".to_owned(), only);
                }
            }
            if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
                choices.retain(|choice| *choice != json!({ "type": "null" }));
                if let [Value::Object(only)] = choices.as_slice() {
                    let only = only.clone();
                    object.remove("anyOf");
                    // What is said of the key comes before what is said of its type.
                    for (key, value) in only {
                        object.entry(key).or_insert(value);
                    }
                }
            }
            object.values_mut().for_each(remove_null);
        }
        Value::Array(items) => items.iter_mut().for_each(remove_null),
        _ => {}
    }
}
