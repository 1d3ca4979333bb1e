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
        CraterEnergyOptions, ForrestalConcreteOptions, ForrestalOptions, PonceletOptions,
        TaylorOptions, WilkinsGuinanOptions,
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
    /// Options of the model `forrestal`.
    #[serde(default)]
    pub forrestal: ForrestalOptions,
    /// Options of the model `forrestal_concrete`.
    #[serde(default)]
    pub forrestal_concrete: ForrestalConcreteOptions,
    /// Options of the model `poncelet`.
    #[serde(default)]
    pub poncelet: PonceletOptions,
    /// Options of the model `crater_energy`.
    #[serde(default)]
    pub crater_energy: CraterEnergyOptions,
    /// Options of the model `taylor`.
    #[serde(default)]
    pub taylor: TaylorOptions,
    /// Options of the model `wilkins_guinan`.
    #[serde(default)]
    pub wilkins_guinan: WilkinsGuinanOptions,
    /// The user's own materials, by id.
    #[serde(default, skip_serializing_if = "MaterialTable::is_empty")]
    pub materials: MaterialTable,
    /// Files with more materials, relative to the case file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub material_files: Vec<PathBuf>,
}
