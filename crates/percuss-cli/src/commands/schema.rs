use clap::Args;
use percuss::case::Case;
use serde_json::{Value, json};

use crate::{failure::Failure, terminal};

const LONG_ABOUT: &str = "\
Print the JSON Schema (draft 2020-12) of case files: every key with what it
means, the units allowed and the values allowed.

Editors check and complete case files with it. Those that use Taplo, such as
Visual Studio Code with Even Better TOML, take it from the first line of a file:
  #:schema percuss.schema.json
where the path is relative to the file.";

const AFTER_HELP: &str = "\
Examples:
  percuss schema > percuss.schema.json

Exit codes: 0 ok, 2 bad input, 4 the output could not be written";

/// Print the JSON Schema of case files
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Schema {}

impl Schema {
    pub fn run(&self) -> Result<(), Failure> {
        let mut schema = schemars::schema_for!(Case).to_value();
        remove_null(&mut schema);
        terminal::print_json(&schema)
    }
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
