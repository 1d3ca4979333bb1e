//! Model `fdm`: one-dimensional finite differences on a staggered grid, stresses in cells and velocities at nodes.

mod flow;
mod grid;
mod options;
pub mod planar;
mod rod;
mod viscosity;
mod warnings;

pub use options::{FdmOptions, Geometry};
pub use rod::Rod;

use crate::{
    Error, Scenario,
    guard::{Guard, NoseKind},
    model::{Control, Model},
    outcome::RunResult,
};

/// One-dimensional finite differences, as a rod or as a planar impact.
#[derive(Debug, Clone, Copy)]
pub struct Fdm;

impl Model for Fdm {
    fn name(&self) -> &'static str {
        "fdm"
    }

    fn summary(&self) -> &'static str {
        "1-D finite differences: a rod on a column of target, or a planar impact with shocks and spall"
    }

    fn guard(&self) -> &'static Guard {
        const {
            &Guard {
                noses: &[NoseKind::Flat],
                notes: &[
                    "normal impact of a flat-ended projectile; no erosion",
                    "geometry `rod`: the column of target in line with the rod stands for the target, closed as in `chain`",
                    "geometry `planar`: uniaxial strain, until release waves from the edges arrive; needs the materials' equations \
                     of state",
                ],
                ..Guard::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<String> {
        match scenario.options.fdm.geometry {
            Geometry::Rod => None,
            Geometry::Planar => planar::not_applicable(scenario),
        }
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        match scenario.options.fdm.geometry {
            Geometry::Rod => Rod::new(scenario).run(control),
            Geometry::Planar => planar::run(scenario, control),
        }
    }
}
