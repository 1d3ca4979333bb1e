//! Models: the list of all, the default for a case, and which of several results to rely on.

mod choice;
mod label;
mod recommend;
mod unread;

use crate::{
    Error,
    analytic::{
        AwerbuchBodner, CraterEnergy, EnergyBalance, Forrestal, ForrestalConcrete, Hydrodynamic,
        LambertJonas, LanzOdermatt, MomentumBalance, PlateCavity, Plugging, Poncelet, PowerBalance,
        QuasiStatic, RechtIpson, Tate, Taylor, WalkerAnderson, WilkinsGuinan,
    },
    axi::Axi,
    chain::Chain,
    error::nearest,
    fdm::Fdm,
    particles::Particles,
    units::shorten,
};

pub use choice::{ChosenModel, DEFAULT_MODEL, choose, default_model};
pub use label::label;
pub use recommend::{Choice, Recommendation, outside, recommend};
pub use unread::why_unread;

pub use crate::solver::{
    CHECKPOINT_START, Checkpoints, Control, CostClass, Model, OnFrame, Progress, applicability,
    run, run_explained,
};
pub use crate::solver::{Estimate, memory, time_in_words};
pub use crate::solver::{applicability_in, complete, run_in};

/// All models. Adding one is one file and one line here.
pub static MODELS: &[&dyn Model] = &[
    &Chain,
    &Fdm,
    &Axi,
    &Particles,
    &Tate,
    &WalkerAnderson,
    &LanzOdermatt,
    &Hydrodynamic,
    &Forrestal,
    &ForrestalConcrete,
    &QuasiStatic,
    &Poncelet,
    &CraterEnergy,
    &EnergyBalance,
    &MomentumBalance,
    &Taylor,
    &WilkinsGuinan,
    &PlateCavity,
    &Plugging,
    &RechtIpson,
    &LambertJonas,
    &AwerbuchBodner,
    &PowerBalance,
];

/// The models that take seconds at most: what comparisons and validations run unless models are named.
pub fn fast_models() -> Vec<&'static dyn Model> {
    MODELS
        .iter()
        .copied()
        .filter(|model| model.cost() < CostClass::Minutes)
        .collect()
}

/// The model with this name.
///
/// # Errors
/// [`Error::UnknownModel`].
pub fn model(name: &str) -> Result<&'static dyn Model, Error> {
    MODELS
        .iter()
        .find(|model| model.name() == name)
        .copied()
        .ok_or_else(|| Error::UnknownModel {
            name: shorten(name),
            suggestion: nearest(name, MODELS.iter().map(|model| model.name())),
            known: MODELS.iter().map(|model| model.name()).collect(),
        })
}
