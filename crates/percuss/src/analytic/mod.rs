//! Models that are formulae or ordinary differential equations.

mod hydrodynamic;
mod lanz_odermatt;
mod long_rod;
mod ode;
mod tate;
mod walker_anderson;

pub use hydrodynamic::Hydrodynamic;
pub use lanz_odermatt::{LanzOdermatt, LanzOdermattOptions};
pub use tate::{Phase, Rods, Stop, Tate, TateOptions};
pub use walker_anderson::{WalkerAnderson, WalkerAndersonOptions};
mod cavity_expansion;
mod crater_energy;
mod deep_shot;
mod dynamic_yield;
mod forrestal;
mod forrestal_concrete;
mod nose_load;
mod poncelet;
mod quasi_static;
mod rigid_motion;
mod taylor;
mod wilkins_guinan;

pub use cavity_expansion::{CavityExpansion, CavityFit, effective_yield_stress};
pub use crater_energy::{CraterEnergy, CraterEnergyOptions};
pub use dynamic_yield::mean_flow_stress;
pub use forrestal::{Cavity, Entry, Forrestal, ForrestalOptions};
pub use forrestal_concrete::{ForrestalConcrete, ForrestalConcreteOptions};
pub use nose_load::NoseLoad;
pub use poncelet::{Poncelet, PonceletOptions};
pub use quasi_static::QuasiStatic;
pub use taylor::{Taylor, TaylorOptions, TaylorRod, taylor_yield_stress};
pub use wilkins_guinan::{
    WilkinsGuinan, WilkinsGuinanOptions, wilkins_guinan_length, wilkins_guinan_yield_stress,
};
