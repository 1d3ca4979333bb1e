//! Geometry `rod`: uniaxial stress with a cross-section that changes.

mod blocks;
mod cell;
mod law;
mod mesh;
mod results;
mod run;

pub(super) use run::{RodRun, limits};
