//! Model `axi`: axisymmetric continuum mechanics by the material point method, the reference of the one-dimensional models.

mod advance;
mod axial;
mod balance;
mod block;
mod body;
mod boundary;
mod contact;
mod crater;
mod deposit;
mod end;
mod field;
mod fill;
mod floor;
mod kernel;
mod localization;
mod mesh;
mod nodes;
mod opening;
mod remnant;
mod results;
mod run;
mod setup;
mod solver;
mod surface;
#[cfg(test)]
mod tests;
mod transfer;
mod warnings;

use std::borrow::Cow;

pub use crate::options::{AxiOptions, ContactKind, Edge, Eos};
pub use crate::solver::Particle;
pub use warnings::layers_that_cannot_fail;

use crate::{
    Error, Refusal, Scenario,
    material::MaterialClass,
    outcome::RunResult,
    regime::{ProjectileRegime, TargetKind},
    solver::{Control, CostClass, Estimate, Model, estimate::Work, times},
    validity::{FirstChoice, NoseKind, ValidityDomain},
};

/// Axisymmetric material point method.
#[derive(Debug, Clone, Copy)]
pub struct Axi;

/// Memory of a particle with its share of the nodes [bytes].
const PARTICLE: f64 = 1200.0;
/// Particles times steps per second of processor time: 7 to 14 million on one core of 2024.
const RATE: f64 = 10e6;
/// Steps of a run per cell along the radius, at the default Courant number: at least, and per diameter of the projectile's length.
const STEPS: (f64, f64) = (21.0, 43.0);

/// Metal targets that are not thin, where one dimension has no crater, and walls, which spread the foot of a rod.
const fn resolves(projectile: ProjectileRegime) -> FirstChoice {
    FirstChoice {
        projectile,
        targets: &[
            TargetKind::SemiInfinite,
            TargetKind::ThickPlate,
            TargetKind::Plate,
            TargetKind::RigidWall,
        ],
        noses: NoseKind::ALL,
        target_material: MaterialClass::Metal,
        because: "it resolves projectile and target, and states the error of its mesh",
    }
}

/// Number of particles that a run of a case begins with, for estimates of its cost. A nose that is not flat has fewer.
pub fn particles(scenario: &Scenario) -> f64 {
    setup::particles(scenario)
}

impl Model for Axi {
    fn name(&self) -> &'static str {
        "axi"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("axisymmetric")
    }

    fn summary(&self) -> &'static str {
        "axisymmetric reference: large deformation by the material point method"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                targets: &[
                    TargetKind::SemiInfinite,
                    TargetKind::ThickPlate,
                    TargetKind::Plate,
                    TargetKind::ThinPlate,
                    TargetKind::Layered,
                    TargetKind::RigidWall,
                ],
                start_temperature: true,
                first_choice: &[
                    resolves(ProjectileRegime::Deforming),
                    resolves(ProjectileRegime::Eroding),
                ],
                notes: &[
                    "normal impact of a body of revolution",
                    "a second to minutes: it runs when asked for by name, and beside a run",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn cost(&self) -> CostClass {
        CostClass::Minutes
    }

    fn has_fields(&self) -> bool {
        true
    }

    fn is_two_dimensional(&self) -> bool {
        true
    }

    fn estimate(&self, scenario: &Scenario) -> Estimate {
        let (options, rod) = (&scenario.options.axi, &scenario.projectile);
        let work = Work {
            elements: particles(scenario),
            bytes: PARTICLE,
            rate: RATE,
        };
        let of_length = STEPS.0 + STEPS.1 * rod.length / rod.diameter;
        let courant = setup::courant(scenario, options.courant());
        let finer = AxiOptions::default().courant() / courant;
        let steps = f64::from(options.cells_per_radius()) * of_length * finer;
        // A step is the time in which the fastest wave crosses a part of a cell.
        let time_step = courant * setup::cell(scenario) / setup::wave_speed(scenario);
        let ended = options
            .end_time
            .map_or(f64::INFINITY, |time| time.si() / time_step);
        Estimate::of_steps(work, steps.min(ended), options.max_steps())
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        run::not_applicable(scenario)
    }

    fn refined(&self, scenario: &Scenario, factor: f64) -> Option<Scenario> {
        let mut refined = scenario.clone();
        let options = &mut refined.options.axi;
        options.cells_per_radius = Some(times(options.cells_per_radius(), factor));
        Some(refined)
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        run::AxiRun::new(scenario, control)?.run(control)
    }
}
