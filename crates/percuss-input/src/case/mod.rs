//! Case files: projectile, target, impact velocity and the options of the models.

#[cfg(test)]
mod experiment_tests;
#[cfg(test)]
mod fdm_options_tests;
mod file;
mod load;
mod material_file;
mod measured_curves;
mod resolve;
mod schema;
mod self_contained;
mod template;
#[cfg(test)]
mod tests;

pub use file::Case;
pub use load::{library, load, load_str, scenario};
pub use material_file::{load_materials, materials_toml};
pub use schema::schema;
pub use self_contained::self_contained;
pub use template::{ScenarioChange, Template};

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
        ConeGeometry, CurveUncertainty, EdgeSupport, Experiment, Extensions, Gauge, Layer,
        LayerInterface, MeasuredTable, Nose, NoseGeometry, OgiveGeometry, Projectile,
        RearFaceCondition, SourceKeys, Target, Thickness, Uncertainty,
    },
};
