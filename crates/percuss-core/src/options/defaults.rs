//! Defaults of options: one value for runs, for the schema, and for all that is made of the schema.

use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde_json::{Map, Value};

/// Time steps after which a run is ended.
pub const MAX_STEPS: u64 = 20_000_000;
/// Fraction of plastic work that becomes heat, in every model.
pub const HEAT_FRACTION: f64 = 0.9;

/// Gives options their defaults, and a function that writes these into their schema.
///
/// - `key: Type = default;` also makes a method that returns the value of the case or else the default.
/// - `also key = default;` is for a key that has a method of its own.
/// - `depending key: text;` is for a default that depends on something else: the description of the key ends with the text.
macro_rules! defaults {
    ($options:ident, $in_schema:ident {
        $( $(#[$doc:meta])+ $key:ident: $type:ty = $default:expr; )*
        $( also $also:ident = $value:expr; )*
        $( depending $depending:ident: $text:expr; )*
    }) => {
        impl $options {
            $( $(#[$doc])+ pub fn $key(&self) -> $type { self.$key.unwrap_or($default) } )*
        }

        /// Writes the defaults into the schema of the options.
        pub(super) fn $in_schema(schema: &mut schemars::Schema) {
            $( $crate::options::defaults::set(schema, stringify!($key), $default); )*
            $( $crate::options::defaults::set(schema, stringify!($also), $value); )*
            $( $crate::options::defaults::describe(schema, stringify!($depending), $text.as_ref()); )*
        }
    };
}

pub(crate) use defaults;

/// Whether options have no value but their defaults. A default that depends on something else counts as none.
pub(super) fn are_default<T: Default + PartialEq + Serialize + JsonSchema>(options: &T) -> bool {
    if *options == T::default() {
        return true;
    }
    let mut schema = schemars::schema_for!(T);
    let Ok(Value::Object(given)) = serde_json::to_value(options) else {
        return false;
    };
    given.iter().all(|(key, value)| {
        value.is_null()
            || property(&mut schema, key).is_some_and(|p| p.get("default") == Some(value))
    })
}

/// Writes the default of a key.
pub(super) fn set(schema: &mut Schema, key: &str, default: impl Serialize) {
    // Options are numbers and words, which JSON always has.
    let default = serde_json::to_value(default).unwrap_or_default();
    if let Some(property) = property(schema, key) {
        property.insert("default".to_owned(), default);
    }
}

/// Ends the description of a key with a default that depends on something else.
pub(super) fn describe(schema: &mut Schema, key: &str, default: &str) {
    let property = property(schema, key);
    if let Some(Value::String(text)) = property.and_then(|p| p.get_mut("description")) {
        *text += &format!(" Default: {default}.");
    }
}

fn property<'a>(schema: &'a mut Schema, key: &str) -> Option<&'a mut Map<String, Value>> {
    let properties = schema.as_object_mut()?.get_mut("properties")?;
    properties.get_mut(key)?.as_object_mut()
}
