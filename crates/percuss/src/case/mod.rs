//! Case files: what strikes what, how fast, and by which model options.

mod chain_defaults;
mod chain_words;
mod document;
mod experiment;
mod failure_options;
mod load;
mod material_file;
mod model_options;
mod number_or_word;
mod options;
mod projectile;
mod published_options;
mod reword;
mod schema;
mod self_contained;
mod shear_band;
mod target;
mod template;
#[cfg(test)]
mod tests;

pub use chain_words::*;
pub use document::Document;
pub use experiment::{Experiment, SourceKeys, Uncertainty};
pub(crate) use load::read_text;
pub use load::{MAX_FILE_BYTES, load, load_str};
pub use material_file::load_materials;
pub use model_options::{Case, ModelOptions};
pub(crate) use number_or_word::NumberOrWord;
pub use number_or_word::{ConstraintFactor, ErosionStrain};
pub use options::*;
pub use projectile::{Nose, Projectile};
pub use published_options::*;
pub use schema::schema;
pub use shear_band::{BandFailure, BorderShearLaw, ShearBandOptions};
pub use target::{BackFace, Layer, LayerInterface, Support, Target, Thickness};
pub(crate) use template::Template;
