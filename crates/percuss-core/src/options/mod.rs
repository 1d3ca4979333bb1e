//! Options of the models: one file per model, with defaults and range checks, and the list of all.

mod awerbuch_bodner;
mod axi;
mod chain;
mod chain_defaults;
mod chain_enums;
mod common;
mod constraint_factor;
mod crater_energy;
mod defaults;
mod energy_balance;
mod failure_options;
mod fdm;
mod forrestal;
mod forrestal_concrete;
mod lambert_jonas;
mod lanz_odermatt;
mod momentum_balance;
mod number_or_name;
mod particles;
mod plate_cavity;
mod plugging;
mod poncelet;
mod power_balance;
mod published_options;
mod recht_ipson;
mod shear_band;
mod tate;
mod taylor;
mod walker_anderson;
mod wilkins_guinan;

pub use awerbuch_bodner::AwerbuchBodnerOptions;
pub use axi::{AxiOptions, ContactKind, Edge, Eos};
pub use chain::ChainOptions;
pub use chain_enums::{
    ArtificialViscosity, ErosionCriterion, Kinematics, Scheme, TargetResistanceModel,
};
pub use constraint_factor::constraint_factor;
pub use crater_energy::CraterEnergyOptions;
pub use defaults::MAX_STEPS;
pub use energy_balance::EnergyBalanceOptions;
pub use fdm::{FdmOptions, Geometry, RodOptions};
pub use forrestal::{Cavity, Entry, ForrestalOptions};
pub use forrestal_concrete::ForrestalConcreteOptions;
pub use lambert_jonas::LambertJonasOptions;
pub use lanz_odermatt::LanzOdermattOptions;
pub use momentum_balance::MomentumBalanceOptions;
pub use number_or_name::{ConstraintFactor, ErosionStrain};
pub use particles::{
    FailureCriterion, Formulation, Notch, Outline, PackingKind, ParticleContact, ParticlesOptions,
    Space,
};
pub use plate_cavity::{CavityShape, PlateCavityOptions};
pub use plugging::PluggingOptions;
pub use poncelet::PonceletOptions;
pub use power_balance::PowerBalanceOptions;
pub use published_options::{
    ContactSpring, Interface, PublishedBorderShear, PublishedOptions, PublishedTimeStep,
    SmallStrainStiffness,
};
pub use recht_ipson::RechtIpsonOptions;
pub use shear_band::{BandFailure, BorderShearLaw, ShearBandOptions};
pub use tate::TateOptions;
pub use taylor::TaylorOptions;
pub use walker_anderson::WalkerAndersonOptions;
pub use wilkins_guinan::WilkinsGuinanOptions;

/// Hands the list of models that have options, each with their type, to a macro. A model that has options is one line here.
#[doc(hidden)]
#[macro_export]
macro_rules! with_model_options {
    ($then:ident) => {
        $then! {
            chain: $crate::options::ChainOptions,
            fdm: $crate::options::FdmOptions,
            axi: $crate::options::AxiOptions,
            particles: $crate::options::ParticlesOptions,
            tate: $crate::options::TateOptions,
            walker_anderson: $crate::options::WalkerAndersonOptions,
            lanz_odermatt: $crate::options::LanzOdermattOptions,
            forrestal: $crate::options::ForrestalOptions,
            forrestal_concrete: $crate::options::ForrestalConcreteOptions,
            poncelet: $crate::options::PonceletOptions,
            crater_energy: $crate::options::CraterEnergyOptions,
            taylor: $crate::options::TaylorOptions,
            wilkins_guinan: $crate::options::WilkinsGuinanOptions,
            plate_cavity: $crate::options::PlateCavityOptions,
            plugging: $crate::options::PluggingOptions,
            recht_ipson: $crate::options::RechtIpsonOptions,
            lambert_jonas: $crate::options::LambertJonasOptions,
            awerbuch_bodner: $crate::options::AwerbuchBodnerOptions,
            power_balance: $crate::options::PowerBalanceOptions,
            energy_balance: $crate::options::EnergyBalanceOptions,
            momentum_balance: $crate::options::MomentumBalanceOptions,
        }
    };
}

macro_rules! model_options {
    ($($name:ident: $options:ty),* $(,)?) => {
        /// Options of all models that have any.
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct ModelOptions {
            $(
                #[doc = concat!("Options of the model `", stringify!($name), "`.")]
                pub $name: $options,
            )*
        }

        impl ModelOptions {
            /// Reports values that are not allowed for a target, each with its key, its allowed range and a remedy.
            pub fn check(&self, check: &mut crate::check::Check<'_>, target: &crate::problem::Target) {
                $(self.$name.check(&mut check.within(stringify!($name)), target);)*
            }

            /// Whether a model has its default options, written or not, as one without any always has.
            pub fn are_default(&self, model: &str) -> bool {
                match model {
                    $(stringify!($name) => defaults::are_default(&self.$name),)*
                    _ => true,
                }
            }
        }
    };
}

with_model_options!(model_options);
