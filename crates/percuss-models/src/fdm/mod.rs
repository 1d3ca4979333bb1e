//! Model `fdm`: one-dimensional finite differences on a staggered grid, stresses in cells and velocities at nodes.

mod audit;
mod grid;
pub mod planar;
mod rod;
mod viscosity;
mod warnings;

use std::borrow::Cow;

pub use crate::options::{FdmOptions, Geometry};
pub use planar::StateEquation;

use crate::{
    Error, Refusal, Scenario,
    options::ErosionStrain,
    outcome::{Outcome, RunResult},
    regime::{ProjectileRegime, Regime, STRENGTH_STRAIN, struck_end_strain},
    solver::{
        Control, CostClass, Estimate, Model,
        estimate::{ExpectedTimes, WorkRate, element_time},
        times,
    },
    validity::{NoseKind, Range, ValidityDomain, fixed_rear_face_warning},
};

/// Memory of a cell with its node and their copy in fields [bytes], and cells times steps per second of processor time.
const WORK: WorkRate = WorkRate {
    bytes: 1000.0,
    rate: 55e6,
};
/// The same in the geometry `planar`: Johnson–Cook metals 3e6, Steinberg–Guinan ones 5e6.
const PLANAR_WORK: WorkRate = WorkRate {
    bytes: 1000.0,
    rate: 3e6,
};
/// Duration of a rod's run in times of waves and of the expected stop: that of 80 % of random cases within a factor of 1.6.
const ROD_DURATION: [f64; 2] = [3.0, 0.75];

/// One-dimensional finite differences, as a rod or as a planar impact.
#[derive(Debug, Clone, Copy)]
pub struct Fdm;

impl Model for Fdm {
    fn name(&self) -> &'static str {
        "fdm"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("finite differences")
    }

    // Erosion and heating are those of the column of discrete elements.
    fn reads_options_of(&self, model: &str) -> bool {
        matches!(model, "fdm" | "chain")
    }

    fn summary(&self) -> &'static str {
        "1-D finite differences: a rod on a column of target, or a planar impact with shocks and spall"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                noses: &[NoseKind::Flat],
                notes: &[
                    "normal impact of a flat-ended projectile",
                    "geometry `rod` has no erosion: a rod that erodes gets no number, unless the case asks for a comparison without \
                     erosion by `chain.erosion_strain = \"never\"`",
                    "geometry `rod`: the column of target in line with the rod stands for the target, closed as in `chain`",
                    "geometry `planar`: uniaxial strain, until release waves from the edges arrive; needs the materials' equations \
                     of state",
                    "geometry `planar`: the plateau of the interface stress is its mean over the second half of the time in which a \
                     wave crosses the thinner body; the peak force leaves out the first half",
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
        let (rod, target) = elements(scenario);
        let rate = match scenario.options.fdm.geometry {
            Geometry::Planar => PLANAR_WORK,
            Geometry::Rod => WORK,
        };
        let work = rate.of(f64::from(rod) + f64::from(target));
        let (time_step, end, limits) = match scenario.options.fdm.geometry {
            Geometry::Planar => {
                let (time_step, limits) = planar::expected(scenario);
                (time_step, limits.end_time, limits)
            }
            Geometry::Rod => {
                let (courant, limits) = rod::limits(scenario);
                let cells = (rod as usize, target as usize);
                let time_step = courant * element_time(scenario, cells) * tip_length(scenario);
                let end = ExpectedTimes::of(scenario).weighted(ROD_DURATION);
                (time_step, end, limits)
            }
        };
        Estimate::of_time(work, (end, time_step), limits)
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        match scenario.options.fdm.geometry {
            Geometry::Rod => erodes(scenario),
            Geometry::Planar => planar::not_applicable(scenario),
        }
    }

    fn refined(&self, scenario: &Scenario, factor: f64) -> Option<Scenario> {
        let (projectile, target) = elements(scenario);
        let mut refined = scenario.clone();
        let options = &mut refined.options.fdm;
        options.projectile_elements = Some(times(projectile, factor));
        options.target_elements = Some(times(target, factor));
        Some(refined)
    }

    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        match scenario.options.fdm.geometry {
            Geometry::Rod => {
                let mut result = rod::RodRun::new(scenario, control)?.run(control)?;
                result.warnings.extend(Range::COLUMN.diagnostic(scenario));
                result.warnings.extend(Range::ROD.diagnostic(scenario));
                if result.outcome != Outcome::Perforated {
                    result.warnings.extend(fixed_rear_face_warning(scenario));
                }
                Ok(result)
            }
            Geometry::Planar => planar::PlanarRun::new(scenario, control)?.run(control),
        }
    }
}

/// Smallest length of a cell over its first one: that of the tip of Taylor's rod \[taylor1948\]. Steps shorten with it.
fn tip_length(scenario: &Scenario) -> f64 {
    let rod = &scenario.projectile.material;
    let Some(strength) = rod.flow_stress(STRENGTH_STRAIN) else {
        return 1.0;
    };
    let number = rod.density.si() * scenario.impact_velocity.powi(2) / strength;
    1.0 - struck_end_strain(number)
}

/// Why a rod that erodes gets no number: its cells are crushed instead, to nothing and at the cost of any number of time steps.
fn erodes(scenario: &Scenario) -> Option<Refusal> {
    let regime = Regime::of(scenario);
    let asked = scenario.options.chain.erosion_strain == Some(ErosionStrain::Never);
    let sharply = regime.projectile == ProjectileRegime::Eroding
        && regime.neighbour != Some(ProjectileRegime::Deforming);
    (sharply && !asked).then(|| {
        let reason = format!(
            "geometry `rod` has no erosion, and this rod erodes: {}",
            regime.because
        );
        Refusal::new(reason)
            .with_remedy("for a comparison without erosion give `chain.erosion_strain = \"never\"`")
    })
}

/// Cells along the projectile and through the target, as a case resolves them.
pub fn elements(scenario: &Scenario) -> (u32, u32) {
    match scenario.options.fdm.geometry {
        Geometry::Planar => planar::cells(scenario),
        Geometry::Rod => {
            let (fdm, chain) = (&scenario.options.fdm, &scenario.options.chain);
            let options = fdm.of_rod(chain);
            (options.projectile_elements, options.target_elements)
        }
    }
}
