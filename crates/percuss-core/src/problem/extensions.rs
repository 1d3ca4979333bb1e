//! Tables of a case that belong to models of others.

use std::{borrow::Cow, collections::BTreeMap};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::{Error, check::Diagnostic, document::Document};

/// Tables of models that are not part of percuss, by name.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Extensions(BTreeMap<String, toml::Table>);

impl Extensions {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The table of a model, or its default where the case has none.
    ///
    /// # Errors
    /// [`Error::Input`] when the table has an unknown key or a value of another type.
    pub fn read<T: DeserializeOwned + Default>(&self, name: &str) -> Result<T, Error> {
        let Some(table) = self.0.get(name) else {
            return Ok(T::default());
        };
        table.clone().try_into().map_err(|error: toml::de::Error| {
            let key = format!("extensions.{name}");
            let help = "the model of this table lists its keys";
            let diagnostic = Diagnostic::at(&key, error.message().to_owned(), help);
            Document::new("case", "").place(diagnostic).into()
        })
    }

    /// Puts the table of a model into a case that is built in code.
    ///
    /// # Errors
    /// [`Error::Input`] when the options are no table.
    pub fn set<T: Serialize>(&mut self, name: &str, options: &T) -> Result<(), Error> {
        let table = toml::Table::try_from(options).map_err(|error| {
            let key = format!("extensions.{name}");
            let diagnostic = Diagnostic::at(&key, error.to_string(), "");
            Error::from(Document::new("case", "").place(diagnostic))
        })?;
        self.0.insert(name.to_owned(), table);
        Ok(())
    }
}

impl JsonSchema for Extensions {
    fn schema_name() -> Cow<'static, str> {
        "Extensions".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "object",
            "description": "A table for each model, with the keys that the model defines.",
            "additionalProperties": { "type": "object" },
        })
    }
}
