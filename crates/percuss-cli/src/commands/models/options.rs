//! Options of a model, from the schema of case files.

use serde::{Serialize, Serializer};
use serde_json::Value;

/// A key of a model's table in a case file.
pub struct ModelOption {
    pub key: String,
    /// Description with unit and default.
    pub meaning: String,
}

/// Options of a model; empty when a case has no table of its name.
pub fn of(model: &str, schema: &Value) -> Vec<ModelOption> {
    let table = &schema["properties"][model]["$ref"];
    let definition = table.as_str().and_then(|place| place.strip_prefix('#'));
    let properties = definition
        .and_then(|place| schema.pointer(place))
        .and_then(|definition| definition["properties"].as_object());
    properties
        .into_iter()
        .flatten()
        .map(|(key, property)| ModelOption {
            key: key.clone(),
            meaning: property["description"]
                .as_str()
                .unwrap_or_default()
                .replace("\\[", "[")
                .replace("\\]", "]")
                .trim_end_matches('.')
                .to_owned(),
        })
        .collect()
}

/// Writes the keys alone.
pub fn keys<S: Serializer>(options: &[ModelOption], serializer: S) -> Result<S::Ok, S::Error> {
    let keys: Vec<&str> = options.iter().map(|option| option.key.as_str()).collect();
    keys.serialize(serializer)
}
