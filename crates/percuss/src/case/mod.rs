//! Case files: what strikes what, how fast, and by which model options.

mod file;
mod load;
mod material_file;
mod resolve;
mod schema;
mod self_contained;
mod template;
#[cfg(test)]
mod tests;

pub use file::Case;
pub use load::{load, load_str};
pub use material_file::load_materials;
pub use schema::schema;
pub(crate) use template::Template;

pub use crate::{
    check::limits::MAX_ELEMENTS,
    document::{Document, MAX_FILE_BYTES},
    options::{
        ArtificialViscosity, BandFailure, BorderShearLaw, ChainOptions, ConstraintFactor,
        ContactSpring, ErosionCriterion, ErosionStrain, Interface, Kinematics, ModelOptions,
        PublishedBorderShear, PublishedOptions, PublishedTimeStep, Scheme, ShearBandOptions,
        SmallStrainStiffness, TargetResistanceModel,
    },
    problem::{
        EdgeSupport, Experiment, Extensions, Gauge, Layer, LayerInterface, Nose, Projectile,
        RearFaceCondition, SourceKeys, Target, Thickness, Uncertainty,
    },
};
