//! Model `particles`: solids as lattices of bonded particles, in a plane or in space.

mod ball;
mod body;
mod bonded;
mod bonds;
mod cracks;
mod cubic;
mod debris;
mod energy;
mod fields;
mod flight;
mod fracture;
mod frequency;
mod lammps;
mod lattice;
mod onset;
mod packing;
mod periodic;
mod pieces;
mod places;
mod plane;
mod restitution;
mod results;
mod row;
mod run;
mod setup;
mod shape;
mod slot;
mod step;
mod stress;
mod survey;
mod tasks;
mod tension;
#[cfg(test)]
mod tests;

pub use lammps::{LammpsInput, lammps};

pub use crate::options::{
    FailureCriterion, Formulation, Outline, PackingKind, ParticleContact, ParticlesOptions, Space,
};

use self::{ball::Collision, body::Body, cubic::CubicBody, run::ParticlesRun, stress::StressBody};
use crate::{
    Error, Refusal, Scenario,
    outcome::{BandQuantity, RunResult},
    regime::{ProjectileRegime, TargetKind},
    solver::{
        Control, CostClass, Estimate, Model,
        driver::Drive,
        estimate::WorkRate,
        interface::{Audit, BalanceTolerance, Retry},
    },
    units::Length,
    validity::{NoseKind, ValidityDomain},
};

/// Steps between two checks of the balances.
const INTERVAL: u64 = 50;
/// How often and how strictly the balances are checked.
const AUDIT: Audit = Audit {
    interval: INTERVAL,
    report_interval: INTERVAL,
    tolerance: BalanceTolerance {
        energy: 1e-3,
        momentum: 1e-9,
    },
    retry: Retry::OfBalance { smallest: 0.1 },
};

/// Courant number that a case gives, and the default.
fn courant(scenario: &Scenario) -> (Option<f64>, f64) {
    let given = scenario.options.particles.courant;
    (given, ParticlesOptions::default().courant())
}

/// Memory of a particle in space, twice as much where bonds break, and its rate.
const WORK_IN_SPACE: WorkRate = WorkRate {
    bytes: 900.0,
    rate: 5e6,
};
/// The same where bonds break and pieces meet: 1.9 million particle-steps per second are measured.
const WORK_IN_PIECES: WorkRate = WorkRate {
    rate: 2e6,
    ..WORK_IN_SPACE
};
/// Memory of a particle with the files that show it [bytes], and particles times steps per second of processor time.
const WORK: WorkRate = WorkRate {
    bytes: 300.0,
    rate: 20e6,
};
/// Memory of a particle with a stress, and its rate: measured are 350 bytes with the files of a run, and 7 to 15 million particle-steps per second.
const WORK_OF_STRESS: WorkRate = WorkRate {
    bytes: 550.0,
    rate: 8e6,
};
/// Memory of a particle of an irregular packing over that of the lattice: of a plane body, and of one in space.
const IRREGULAR: [f64; 2] = [1.6, 2.0];

/// Lattice of bonded particles.
#[derive(Debug, Clone, Copy)]
pub struct Particles;

/// Number of particles of a case.
pub fn particles(scenario: &Scenario) -> f64 {
    match ball::is_meant(scenario) {
        true => ball::count(scenario),
        false => setup::extent(scenario).particles(),
    }
}

/// Whether bonds of a case break.
pub fn breaks(scenario: &Scenario) -> bool {
    !ball::is_meant(scenario) && setup::toughness(scenario).is_some()
}

/// Whether the packing of a case has random numbers.
pub fn has_seeds(scenario: &Scenario) -> bool {
    !ball::is_meant(scenario) && setup::packing(scenario) != packing::Packing::Regular
}

/// The same case with the packing of another seed: another specimen of the same solid.
pub fn with_seed(scenario: &Scenario, seed: u64) -> Scenario {
    let mut other = scenario.clone();
    other.options.particles.seed = Some(seed);
    other
}

/// Validity domain of a formulation, from the projectile regimes and targets that it takes.
const fn domain(
    projectile: &'static [ProjectileRegime],
    targets: &'static [TargetKind],
) -> ValidityDomain {
    ValidityDomain {
        projectile,
        targets,
        predicts: &[BandQuantity::ResidualVelocity],
        oblique_noses: NoseKind::ALL,
        breaks_brittle: true,
        notes: &[
            "`space`: plane strain or plane stress, where the projectile is a strip and results are per metre of width, or three dimensions",
            "springs: a rigid projectile on one elastic plate, or an elastic strip or rod on a rigid wall; bonds break where the material has \
             `fracture`, and pieces meet with friction; no plastic flow, and no friction of the projectile",
            "`formulation = \"particle-stress\"`: metals that yield, in plane strain; a rigid projectile on one plate, or a strip that deforms \
             on a rigid wall; nothing breaks",
            "`contact = \"hertz\"`: projectile and target ball are one elastic particle each, on a rigid wall, a half-space or another \
             ball, with friction and rotation; semi-infinite targets in this way alone",
            "Poisson's ratio of the springs up to 1/4 in plane strain, 1/3 in plane stress and 0.4 in three dimensions",
            "never a first choice: for what is axisymmetric use `axi`",
        ],
        ..ValidityDomain::OPEN
    }
}

impl Model for Particles {
    fn name(&self) -> &'static str {
        "particles"
    }

    fn summary(&self) -> &'static str {
        "2-D and 3-D bonded particles: elastic waves, cracks, rigid impact on brittle plates; metals in plane strain"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &domain(
                &[ProjectileRegime::Rigid],
                &[
                    TargetKind::SemiInfinite,
                    TargetKind::ThickPlate,
                    TargetKind::Plate,
                    TargetKind::ThinPlate,
                    TargetKind::RigidWall,
                ],
            )
        }
    }

    fn validity_for(&self, scenario: &Scenario) -> &'static ValidityDomain {
        // On a wall the strip itself has the stresses: it may yield.
        match stress::is_meant(scenario) && !setup::is_plate(scenario) {
            true => {
                const {
                    &domain(
                        &[ProjectileRegime::Rigid, ProjectileRegime::Deforming],
                        &[TargetKind::RigidWall],
                    )
                }
            }
            false => self.validity(),
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
        if ball::is_meant(scenario) {
            return ball::estimate(scenario);
        }
        let (time_step, end, limits) = setup::expected(scenario);
        let (work, irregular) = match scenario.options.particles.space() {
            _ if stress::is_meant(scenario) => (WORK_OF_STRESS, 1.0),
            Space::ThreeDimensional if breaks(scenario) => (WORK_IN_PIECES, IRREGULAR[1]),
            Space::ThreeDimensional => (WORK_IN_SPACE, IRREGULAR[1]),
            Space::PlaneStrain | Space::PlaneStress => (WORK, IRREGULAR[0]),
        };
        let mut work = work.of(particles(scenario));
        if has_seeds(scenario) {
            work.bytes *= irregular;
        }
        Estimate::of_time(work, (end, time_step), limits)
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        if let Some(gauge) = scenario.gauges.iter().find(|gauge| gauge.fixed) {
            let reason = format!(
                "it has gauges of the material only, and `{}` is fixed",
                gauge.name
            );
            return Some(Refusal::new(reason).with_remedy("remove `fixed` of the gauge"));
        }
        match ball::is_meant(scenario) {
            true => ball::not_applicable(scenario),
            false => setup::not_applicable(scenario),
        }
    }

    fn refined(&self, scenario: &Scenario, factor: f64) -> Option<Scenario> {
        let mut refined = scenario.clone();
        if ball::is_meant(scenario) {
            let courant = scenario.options.particles.courant() / factor;
            refined.options.particles.courant = Some(courant);
            return Some(refined);
        }
        let spacing = setup::extent(scenario).spacing() / factor;
        refined.options.particles.spacing = Some(Length::new(spacing));
        Some(refined)
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        if ball::is_meant(scenario) {
            return Drive::<Collision<'_>>::new(scenario, control)?.run(control);
        }
        if stress::is_meant(scenario) {
            return ParticlesRun::<StressBody, 2>::new(scenario, control)?.run(control);
        }
        match scenario.options.particles.space() {
            Space::ThreeDimensional => {
                ParticlesRun::<CubicBody, 3>::new(scenario, control)?.run(control)
            }
            Space::PlaneStrain | Space::PlaneStress => {
                ParticlesRun::<Body, 2>::new(scenario, control)?.run(control)
            }
        }
    }
}
