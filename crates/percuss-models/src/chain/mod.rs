//! Model `chain`: the 1-D discrete element model, point masses joined by normal springs.
//!
//! Three solvers, each driven by [`Drive`](crate::solver): the target column (`column`), the expanding cavity (`expanding`) and the seed paper's
//! scheme (`published`), which shares dry friction alone with the others, so that it stays as printed. `closure` chooses the target resistance model
//! of a case that names none; `explain` computes the alternatives beside a run.
//!
//! The column: `mesh` turns a scenario into a `state` of nodes and elements, in segments that touch, separate and meet again. `part` has what is the same
//! for all of a body; `cone` and `penetration` are a target that widens. A step (`solver`) is
//!
//! 1. kick: new velocities from forces, with `damping`, `friction` and what `contact` does at every `interface`;
//! 2. drift: new positions and strains, and the constitutive update of each `element`;
//! 3. `erosion`, then `fracture` by a failure law.
//!
//! A plate that fails by plugging adds `plug`, which joins nodes to the shear bands around them (`shear_band`, `band`, `band_law`, `shear_zone`,
//! `adiabatic`) and to a plate that dishes (`dishing`, `dishing_mesh`, `plate_section`). `end` finds the end and the outcome.
//!
//! Velocities are half a step behind positions. The work of a kick is force times the mean of the velocities before and after it, so that the
//! energy balance closes to rounding in small strain. A jump of velocity in a contact is accounted for with the half drift that it displaces.
//!
//! Each equation of the step is a function of single numbers: in `friction`, `pair` (contact of two ends), `element`, `flow` (return to the yield
//! surface), `solver` and `state`. `batch` advances eight columns side by side: its loops over the lanes call the same functions, and it leaves
//! rare events to the single run. A test compares their bits.

mod adiabatic;
mod band;
mod band_law;
mod batch;
mod column;
mod cone;
mod contact;
mod damping;
mod dishing;
mod dishing_mesh;
mod drift;
mod element;
mod end;
mod erosion;
mod expanding;
mod explain;
mod flow;
mod fracture;
mod fragments;
mod friction;
mod interface;
mod mesh;
mod pair;
mod part;
mod penetration;
mod plate_flow;
mod plate_section;
mod plug;
mod published;
mod resistance_model;
mod results;
#[cfg(test)]
mod separation_tests;
mod shear_band;
mod shear_zone;
mod snapshot;
mod solver;
mod state;
mod tate;
#[cfg(test)]
mod tests;
mod warnings;

use column::ColumnRun;
pub use published::Published;
pub use resistance_model::{choose_target_resistance, resistance_model_in_use};

use std::sync::atomic::AtomicBool;

pub use batch::Stopped;

use crate::{
    Error, Refusal, Scenario,
    material::MaterialClass,
    options::{BorderShearLaw, Scheme, TargetResistanceModel},
    outcome::RunResult,
    regime::{ProjectileRegime, TargetKind},
    solver::{
        Control, CostClass, Estimate, Model,
        estimate::{ExpectedTimes, WorkRate, element_time},
        limits::Limits,
        times,
    },
    validity::{FirstChoice, NoseKind, Range, ValidityDomain},
};

/// Memory of an element with its node and their copy in fields [bytes], and elements times steps per second of processor time.
const WORK: WorkRate = WorkRate {
    bytes: 1000.0,
    rate: 60e6,
};
/// Duration of a run in times of waves and of the expected stop: that of 80 % of random cases within a factor of four.
const DURATION: [f64; 2] = [3.0, 0.25];
/// First time step of a run over its mean: elements shorten, and steps with them.
const SHORTENING: f64 = 3.0;

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

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                noses: &[NoseKind::Flat],
                start_temperature: true,
                separate_layers: true,
                own_resistance: true,
                first_choice: &[FirstChoice {
                    projectile: ProjectileRegime::Deforming,
                    targets: &[
                        TargetKind::SemiInfinite,
                        TargetKind::ThickPlate,
                        TargetKind::Plate,
                        TargetKind::RigidWall,
                        TargetKind::ConstantPressure,
                    ],
                    noses: &[NoseKind::Flat],
                    target_material: MaterialClass::Metal,
                    because: "it follows the deformation of the projectile and reports its energy and momentum balance",
                }],
                notes: &[
                    "normal impact of a flat-ended rod",
                    "a target of one metal, semi-infinite or at least 0.866 diameters thick, is an expanding cavity under the rod, \
                     unless the case chooses otherwise: the depth is only as good as the theory of cavities",
                    "every other target is the column in line with the rod: the depth is only as good as the constraint factor and \
                     the border shear that close it",
                    "a plate is perforated by a plug with `border_shear_law = \"shear-band\"`; without it a column models neither \
                     plug nor bend",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn cost(&self) -> CostClass {
        CostClass::Seconds
    }

    fn has_fields(&self) -> bool {
        true
    }

    fn estimate(&self, scenario: &Scenario) -> Estimate {
        let options = &scenario.options.chain;
        let (rod, target) = (options.projectile_elements(), options.target_elements());
        let time_step = options.courant() * element_time(scenario, (rod, target)) / SHORTENING;
        let end = ExpectedTimes::of(scenario).weighted(DURATION);
        let limits = Limits::new(scenario, options.end_time, options.max_steps());
        Estimate::of_time(WORK.of((rod + target) as f64), (end, time_step), limits)
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        match scenario.options.chain.scheme {
            Scheme::Conservative if is_expanding(scenario) => {
                expanding::not_applicable(scenario).or_else(|| fracture::not_applicable(scenario))
            }
            _ if scenario.resistance.is_some() => Some(
                Refusal::new(
                    "a resistance law replaces the target's in the target resistance model `expanding-cavity` only",
                )
                .with_remedy("set `chain.target_resistance = \"expanding-cavity\"`"),
            ),
            Scheme::Conservative => {
                fracture::not_applicable(scenario).or_else(|| plug::band_laws(scenario).err())
            }
            Scheme::Published => Published::not_applicable(scenario),
        }
    }

    fn refined(&self, scenario: &Scenario, factor: f64) -> Option<Scenario> {
        let finer = |elements: usize| Some(times(elements as f64, factor));
        let mut refined = scenario.clone();
        let options = &mut refined.options.chain;
        options.projectile_elements = finer(options.projectile_elements());
        options.target_elements = finer(options.target_elements());
        Some(refined)
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let result = match scenario.options.chain.scheme {
            Scheme::Conservative if is_expanding(scenario) => {
                expanding::CavityRun::new(scenario, control)?.run(control)?
            }
            Scheme::Conservative => ColumnRun::new(scenario, control)?.run(control)?,
            Scheme::Published => published::PublishedRun::new(scenario, control)?.run(control)?,
        };
        Ok(with_warnings_of_shape(scenario, result))
    }

    fn explain(
        &self,
        scenario: &Scenario,
        result: &mut RunResult,
        control: &mut Control<'_>,
    ) -> Result<(), Error> {
        explain::explain(scenario, result, control)
    }
}

fn with_warnings_of_shape(scenario: &Scenario, mut result: RunResult) -> RunResult {
    let disc = Range::ROD.diagnostic(scenario);
    result.warnings.splice(0..0, disc);
    if scenario.options.chain.border_shear_law() == BorderShearLaw::Friction {
        let thin = Range::COLUMN.diagnostic(scenario);
        result.warnings.splice(0..0, thin);
    }
    result
}

/// Whether an impact is one of those that [`run_batch`] computes.
pub fn is_for_batch(scenario: &Scenario) -> bool {
    batch::accepts(scenario)
}

/// What [`Chain`] says of impacts that are for the batch, side by side, to the last bit.
///
/// # Errors
/// [`Stopped`]: `stop` has become true.
pub fn run_batch(
    scenarios: &[&Scenario],
    stop: &AtomicBool,
) -> Result<Vec<Result<RunResult, Error>>, Stopped> {
    let results = batch::run(scenarios, stop)?;
    let with_warnings = |(scenario, result): (&&Scenario, Result<RunResult, Error>)| {
        result.map(|result| with_warnings_of_shape(scenario, result))
    };
    Ok(scenarios.iter().zip(results).map(with_warnings).collect())
}

fn is_expanding(scenario: &Scenario) -> bool {
    scenario.options.chain.target_resistance() == TargetResistanceModel::ExpandingCavity
}
