//! Models that are formulae or ordinary differential equations.

mod awerbuch_bodner;
mod cavity_expansion;
mod crater_energy;
mod deep_shot;
mod dynamic_yield;
mod forrestal;
mod forrestal_concrete;
mod hydrodynamic;
mod lambert_jonas;
mod lanz_odermatt;
mod limit;
mod long_rod;
mod nose_load;
mod nose_shape;
mod ode;
mod plate_cavity;
mod plate_shot;
mod plugging;
mod poncelet;
mod quasi_static;
mod recht_ipson;
mod rigid_motion;
mod tate;
mod taylor;
mod walker_anderson;
mod wilkins_guinan;

pub use awerbuch_bodner::{AwerbuchBodner, AwerbuchBodnerOptions};
pub use cavity_expansion::{CavityExpansion, CavityFit, effective_yield_stress};
pub use crater_energy::{CraterEnergy, CraterEnergyOptions};
pub use dynamic_yield::mean_flow_stress;
pub use forrestal::{Cavity, Entry, Forrestal, ForrestalOptions};
pub(crate) use forrestal_concrete::strength_factor;
pub use forrestal_concrete::{ForrestalConcrete, ForrestalConcreteOptions};
pub use hydrodynamic::Hydrodynamic;
pub use lambert_jonas::{LambertJonas, LambertJonasOptions};
pub use lanz_odermatt::{LanzOdermatt, LanzOdermattOptions};
pub use limit::InputLimit;
pub use nose_load::NoseLoad;
pub use plate_cavity::{CavityShape, PlateCavity, PlateCavityOptions};
pub use plugging::{Plugging, PluggingOptions};
pub use poncelet::{Poncelet, PonceletOptions};
pub use quasi_static::QuasiStatic;
pub use recht_ipson::{RechtIpson, RechtIpsonOptions};
pub use tate::{Phase, Rods, Stop, Tate, TateOptions};
pub use taylor::{Taylor, TaylorOptions, TaylorRod, taylor_yield_stress};
pub use walker_anderson::{WalkerAnderson, WalkerAndersonOptions};
pub use wilkins_guinan::{
    WilkinsGuinan, WilkinsGuinanOptions, wilkins_guinan_length, wilkins_guinan_yield_stress,
};
