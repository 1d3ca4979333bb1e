//! Case files: what strikes what, how fast, and by which model options.

mod document;
mod load;
mod number_or_word;
mod options;
mod projectile;
mod published_options;
mod reword;
mod target;
#[cfg(test)]
mod tests;

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    analytic::{
        AwerbuchBodnerOptions, LambertJonasOptions, PlateCavityOptions, PluggingOptions,
        RechtIpsonOptions,
    },
    material::MaterialTable,
};

pub(crate) use document::Document;
pub use load::{MAX_FILE_BYTES, load, load_library, load_materials, load_str};
pub use number_or_word::{ConstraintFactor, ErosionStrain};
pub use options::*;
pub use projectile::{Nose, Projectile};
pub use published_options::*;
pub use target::{BackFace, Layer, Target, Thickness};

/// A case as its TOML file holds it.
///
/// Every dimensional number is a quoted number with a unit, such as `"4.8 mm"`.
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
    /// Options of the 1-D discrete element model.
    #[serde(default)]
    pub chain: ChainOptions,
    /// Options of the model `plate_cavity`.
    #[serde(default)]
    pub plate_cavity: PlateCavityOptions,
    /// Options of the model `plugging`.
    #[serde(default)]
    pub plugging: PluggingOptions,
    /// Options of the model `recht_ipson`.
    #[serde(default)]
    pub recht_ipson: RechtIpsonOptions,
    /// Options of the model `lambert_jonas`.
    #[serde(default)]
    pub lambert_jonas: LambertJonasOptions,
    /// Options of the model `awerbuch_bodner`.
    #[serde(default)]
    pub awerbuch_bodner: AwerbuchBodnerOptions,
    /// The user's own materials, by id.
    #[serde(default, skip_serializing_if = "MaterialTable::is_empty")]
    pub materials: MaterialTable,
    /// Files with more materials, relative to the case file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub material_files: Vec<PathBuf>,
}
