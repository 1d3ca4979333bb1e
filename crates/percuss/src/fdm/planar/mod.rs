//! Geometry `planar`: uniaxial strain, shocks and spall.

mod column;
mod interface;
mod law;
mod results;
mod run;
mod state;

pub use column::{Boundary, CellState, Column, Layer, Medium, Solid};
pub use state::{StateEquation, impedance_match};

pub(super) use run::{cells, not_applicable, run};

use crate::case::ArtificialViscosity;

/// Artificial viscosity of a planar impact when a case gives none.
pub const DEFAULT_VISCOSITY: ArtificialViscosity = ArtificialViscosity {
    linear: 0.1,
    quadratic: 2.0,
};
/// Cells along the projectile when a case gives none.
pub(super) const DEFAULT_CELLS: u32 = 200;
