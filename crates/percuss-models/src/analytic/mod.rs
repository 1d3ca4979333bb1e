//! Models that are formulae or ordinary differential equations.

mod awerbuch_bodner;
mod cavity_expansion;
mod crater_energy;
mod deep_penetration;
mod dynamic_yield;
mod energy_balance;
mod forrestal;
mod forrestal_concrete;
mod gauss;
mod hydrodynamic;
mod impact_wave;
mod lambert_jonas;
mod lanz_odermatt;
mod limit;
mod long_rod;
mod momentum_balance;
mod moving_mass;
mod nose_load;
mod nose_shape;
mod ode;
mod plate_cavity;
mod plate_impact;
mod plugging;
mod poncelet;
mod power_balance;
mod quasi_static;
mod recht_ipson;
mod rigid_motion;
mod rod_flow;
mod tate;
mod taylor;
mod walker_anderson;
mod wilkins_guinan;

pub use awerbuch_bodner::AwerbuchBodner;
pub use cavity_expansion::{CavityExpansion, CavityFit, effective_yield_stress};
pub use crater_energy::CraterEnergy;
pub use dynamic_yield::mean_flow_stress;
pub use energy_balance::EnergyBalance;
pub use forrestal::Forrestal;
pub use forrestal_concrete::ForrestalConcrete;
pub use hydrodynamic::Hydrodynamic;
pub use lambert_jonas::LambertJonas;
pub use lanz_odermatt::LanzOdermatt;
pub use momentum_balance::MomentumBalance;
pub use nose_load::NoseLoad;
pub use plate_cavity::PlateCavity;
pub use plugging::Plugging;
pub use poncelet::Poncelet;
pub use power_balance::PowerBalance;
pub use quasi_static::QuasiStatic;
pub use recht_ipson::RechtIpson;
pub use tate::{Phase, Rods, Stop, Tate};
pub use taylor::{Taylor, TaylorRod, taylor_yield_stress};
pub use walker_anderson::WalkerAnderson;
pub use wilkins_guinan::{WilkinsGuinan, wilkins_guinan_length, wilkins_guinan_yield_stress};

pub use crate::options::{
    AwerbuchBodnerOptions, Cavity, CavityShape, CraterEnergyOptions, EnergyBalanceOptions, Entry,
    ForrestalConcreteOptions, ForrestalOptions, LambertJonasOptions, LanzOdermattOptions,
    MomentumBalanceOptions, PlateCavityOptions, PluggingOptions, PonceletOptions,
    PowerBalanceOptions, RechtIpsonOptions, TateOptions, TaylorOptions, WalkerAndersonOptions,
    WilkinsGuinanOptions,
};
pub use crate::solver::InputLimit;
