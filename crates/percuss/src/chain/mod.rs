//! Model `chain`: the 1-D discrete element model, point masses joined by normal springs.

mod conservative;
mod contact;
mod element;
mod erosion;
mod friction;
mod mesh;
mod part;
mod published;
mod results;
mod snapshot;
mod solver;
mod state;
#[cfg(test)]
mod tests;
mod warnings;
mod watch;

pub use conservative::{Conservative, ENERGY_TOLERANCE, MOMENTUM_TOLERANCE};
pub use published::Published;

use crate::{
    Error, Scenario,
    case::{Nose, Scheme},
    model::{Control, Model},
    outcome::RunResult,
};

/// The 1-D discrete element model.
#[derive(Debug, Clone, Copy)]
pub struct Chain;

impl Model for Chain {
    fn name(&self) -> &'static str {
        "chain"
    }

    fn summary(&self) -> &'static str {
        "1-D discrete element model: point masses joined by normal springs"
    }

    fn guard(&self) -> &'static [&'static str] {
        &[
            "normal impact of a flat-ended rod",
            "deformable projectile on a thick target, a rigid wall or a constant pressure",
            "the column of target in line with the rod stands for the target",
        ]
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<String> {
        if scenario.projectile.nose != Nose::Flat {
            return Some(format!(
                "it has flat-ended rods only, and this nose is of the shape `{}`; leave `projectile.nose` out for a flat end",
                scenario.projectile.nose.name()
            ));
        }
        match scenario.chain.scheme {
            Scheme::Conservative => None,
            Scheme::Published => Published::not_applicable(scenario),
        }
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        match scenario.chain.scheme {
            Scheme::Conservative => Conservative::new(scenario).run(control),
            Scheme::Published => Published::new(scenario)?.run(control),
        }
    }
}
