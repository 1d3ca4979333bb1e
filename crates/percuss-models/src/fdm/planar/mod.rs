//! Geometry `planar`: uniaxial strain, shocks and spall.

mod column;
mod interface;
mod law;
mod results;
mod run;

pub use crate::material::{StateEquation, impedance_match};
pub use column::{Boundary, CellState, Layer, Medium, PlanarGrid, Solid};

pub(super) use run::{PlanarRun, cells, expected, not_applicable};
