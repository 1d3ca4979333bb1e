//! Bodies in space: particles on a body-centred cubic lattice, with springs to their fourteen neighbours and a stiffness of each particle's volume.
//!
//! All forces are central, so particles need no rotation.

mod body;
mod grid;
mod kernels;
mod lattice;
mod run;
pub(super) mod setup;
mod step;
mod stretch;
mod tetrahedra;
mod toughness;

pub(super) use self::{body::CubicBody, lattice::Cubic, setup::LAYER};
#[cfg(test)]
pub(super) use self::{
    grid::Grid,
    lattice::SIDE,
    toughness::{CUT, lattice_factor, softening},
};
