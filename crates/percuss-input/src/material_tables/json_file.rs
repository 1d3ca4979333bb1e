//! JSON with a record for each id, as `percuss materials export --format json` prints it.

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{Error as _, MapAccess, SeqAccess, Visitor},
};
use serde_json::{Map, Value};

use crate::{
    check::Check,
    document::reword_toml_error,
    error::{Error, InputError, Subject},
    lsdyna::Imported,
    material::{Material, MaterialTable},
};

/// Records as JSON: an object with a record for each id, keys and units as in a case file.
///
/// # Errors
/// The reason, where a record cannot be written.
pub fn json(records: &MaterialTable) -> Result<String, String> {
    let text = serde_json::to_string_pretty(records).map_err(|error| error.to_string())?;
    Ok(text + "\n")
}

/// Reads records as JSON; `file` stands for it in messages.
///
/// # Errors
/// [`Error::Input`] with the id and key of what is not valid, and its line.
pub fn read_json(file: &str, text: &str) -> Result<Imported, Error> {
    let refuse = |span, key: String, message: String, help: String| -> Error {
        let error = InputError {
            subject: Subject::Material,
            file: file.to_owned(),
            text: text.to_owned(),
            span,
            key,
            message,
            help,
        };
        error.into()
    };
    let whole = serde_json::from_str(text).map_err(|error| {
        let place = place(text, &error);
        let help = match error.is_data() {
            true => "give each key of an object once",
            false => "up to here the file is valid JSON",
        };
        refuse(place, String::new(), error.to_string(), help.to_owned())
    })?;
    let Once(Value::Object(entries)) = whole else {
        let message = "the file is no object with a record for each id".to_owned();
        let help = "write {\"my-steel\": {\"name\": \"...\", \"density\": \"7850 kg/m3\", ...}}";
        return Err(refuse(0..0, String::new(), message, help.to_owned()));
    };
    let mut found = Imported::default();
    for (id, record) in entries {
        let failed = |key: &str, message: String, help: String| {
            let span = of_key(text, &id, key);
            let key = match key {
                "" => id.clone(),
                key => format!("{id}.{key}"),
            };
            refuse(span, key, message, help)
        };
        let material: Material = serde_json::from_value(record).map_err(|error| {
            let said = reword_toml_error(&error.to_string(), "");
            failed("", said.message, said.help)
        })?;
        let mut diagnostics = Vec::new();
        material.check(&mut Check::new(&mut diagnostics));
        if let Some(first) = diagnostics.into_iter().next() {
            return Err(failed(&first.key, first.message, first.help));
        }
        found.add(id, material);
    }
    if found.records.is_empty() {
        let message = "the file holds no material".to_owned();
        let help = "write a record for each id".to_owned();
        return Err(refuse(0..0, String::new(), message, help));
    }
    Ok(found)
}

/// A value whose objects have each key once: of two entries `serde_json` would keep the last without a word.
struct Once(Value);

impl<'de> Deserialize<'de> for Once {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OnceVisitor).map(Self)
    }
}

struct OnceVisitor;

impl<'de> Visitor<'de> for OnceVisitor {
    type Value = Value;

    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut values = Vec::new();
        while let Some(Once(value)) = entries.next_element()? {
            values.push(value);
        }
        Ok(values.into())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut values = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            if values.contains_key(&key) {
                return Err(A::Error::custom(format_args!(
                    "the key `{key}` is given twice"
                )));
            }
            let Once(value) = entries.next_value()?;
            values.insert(key, value);
        }
        Ok(values.into())
    }
}

/// The byte of an error.
fn place(text: &str, error: &serde_json::Error) -> std::ops::Range<usize> {
    let before = text
        .split_inclusive('\n')
        .take(error.line().saturating_sub(1));
    let start: usize = before.map(str::len).sum();
    let at = (start + error.column().saturating_sub(1)).min(text.len());
    at..(at + 1).min(text.len())
}

/// The bytes of the last part of a key behind its id; those of the id where it is not there.
fn of_key(text: &str, id: &str, key: &str) -> std::ops::Range<usize> {
    let quoted = |name: &str| format!("\"{name}\"");
    let Some(start) = text.find(&quoted(id)) else {
        return 0..0;
    };
    let mut at = start..start + quoted(id).len();
    for part in key.split('.').filter(|part| !part.is_empty()) {
        if let Some(found) = text[at.end..].find(&quoted(part)) {
            let begin = at.end + found;
            at = begin..begin + quoted(part).len();
        }
    }
    at
}
