//! Geometry `rod`: uniaxial stress with a cross-section that changes.

mod law;
mod mesh;
mod results;
mod run;

pub(super) use run::{RodRun, limits};
