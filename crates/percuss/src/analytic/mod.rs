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
