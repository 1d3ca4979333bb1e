//! The case as its file holds it, with one table of options per model.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    inputs::UncertainInputs,
    material::MaterialTable,
    options::ModelOptions,
    problem::{Experiment, Extensions, Gauge, HistoryOptions, MeasuredTable, Projectile, Target},
};

macro_rules! case_with_model_options {
    ($($name:ident: $options:ty),* $(,)?) => {
        /// A case as its TOML file holds it.
        ///
        /// Every dimensional number is a quoted number with a unit, such as `"4.8 mm"`.
        // serde's `flatten` would lose the places of errors: the tables of the models are fields of the case.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        #[schemars(title = "percuss case")]
        pub struct Case {
            /// One line that says what the case is.
            #[serde(default, skip_serializing_if = "String::is_empty")]
            pub title: String,
            /// Bibliography keys of the works that the case is taken from.
            #[serde(default, skip_serializing_if = "Vec::is_empty")]
            pub sources: Vec<String>,
            /// What strikes.
            pub projectile: Projectile,
            /// What is struck.
            pub target: Target,
            $(
                #[doc = concat!("Options of the model `", stringify!($name), "`.")]
                #[serde(default)]
                pub $name: $options,
            )*
            /// Points of the material at which a numerical run keeps a time history.
            #[serde(default, skip_serializing_if = "Vec::is_empty")]
            pub gauges: Vec<Gauge>,
            /// Times at which a numerical run keeps its histories.
            #[serde(default, skip_serializing_if = "HistoryOptions::is_empty")]
            pub history: HistoryOptions,
            /// Tables of models that are not part of percuss, by name; only those models read them.
            #[serde(default, skip_serializing_if = "Extensions::is_empty")]
            pub extensions: Extensions,
            /// What was measured in tests of this case, for comparison; no model sees it.
            #[serde(default, skip_serializing_if = "Vec::is_empty")]
            pub experiments: Vec<Experiment>,
            /// Curves that were measured against time at the impact velocity of the case, for comparison; no model sees them.
            #[serde(default, skip_serializing_if = "Vec::is_empty")]
            pub measured_curves: Vec<MeasuredTable>,
            /// Which of its numbers are uncertain, for `percuss uncertainty`; no model sees it.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub uncertainty: Option<UncertainInputs>,
            /// The user's own materials, by id.
            #[serde(default, skip_serializing_if = "MaterialTable::is_empty")]
            pub materials: MaterialTable,
            /// Files with more materials, relative to the case file.
            #[serde(default, skip_serializing_if = "Vec::is_empty")]
            pub material_files: Vec<PathBuf>,
        }

        impl Case {
            /// A case with the default options of every model; [`Case::scenario`] makes it ready to run.
            pub fn new(projectile: Projectile, target: Target) -> Self {
                Self {
                    title: String::new(),
                    sources: Vec::new(),
                    projectile,
                    target,
                    $($name: Default::default(),)*
                    gauges: Vec::new(),
                    history: HistoryOptions::default(),
                    extensions: Extensions::default(),
                    experiments: Vec::new(),
                    measured_curves: Vec::new(),
                    uncertainty: None,
                    materials: MaterialTable::new(),
                    material_files: Vec::new(),
                }
            }

            /// Options of all models that have any.
            pub fn model_options(&self) -> ModelOptions {
                ModelOptions {
                    $($name: self.$name.clone(),)*
                }
            }

        }
    };
}

percuss_core::with_model_options!(case_with_model_options);
