//! Depths by the axisymmetric reference, stored as data because they take hours.

use std::{
    path::Path,
    sync::{LazyLock, atomic::AtomicBool},
};

use percuss::{
    Error,
    axi::Axi,
    model::{Control, Model},
    outcome::Outcome,
};
use serde::{Deserialize, Serialize};

use super::{
    BenchmarkCase,
    resume::{self, Job, Report},
};

/// Stored reference depths of the grid and of the spread design.
const BUILT_IN: [&str; 2] = [
    include_str!("../../data/reference.csv"),
    include_str!("../../data/reference-spread.csv"),
];

/// Reference result for one case on one mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Id of the projectile's material.
    pub projectile: String,
    /// Id of the target's material.
    pub target: String,
    /// Length of the projectile over its diameter.
    pub length_to_diameter: f64,
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Cells along the projectile's radius.
    pub cells_per_radius: u32,
    /// Depth of penetration [mm].
    pub depth_of_penetration_mm: f64,
    /// Largest depth at any time [mm].
    pub largest_depth_mm: f64,
    /// Final length of the projectile on the axis [mm]; `None` where nothing remains on the axis.
    pub projectile_final_length_mm: Option<f64>,
    /// Final diameter of the projectile [mm].
    pub projectile_final_diameter_mm: Option<f64>,
    /// Outcome.
    pub outcome: String,
    /// Error of the energy balance as a fraction of the initial energy.
    pub energy_residual: f64,
    /// Fraction of the energy lost in the transfer between particles and grid.
    pub transfer_loss: f64,
    /// Time steps.
    pub steps: u64,
    /// Particles.
    pub particles: usize,
}

impl Reference {
    /// Whether this is the reference of a case.
    pub fn is_of(&self, case: &BenchmarkCase) -> bool {
        self.projectile == case.projectile
            && self.target == case.target
            && self.length_to_diameter == case.length_to_diameter
            && self.impact_velocity_m_s == case.speed
    }
}

/// Stored reference depths of both designs.
///
/// # Panics
/// Never: a test reads them.
pub fn built_in() -> Vec<Reference> {
    let read = |text: &str| read(text.as_bytes()).expect("built-in reference depths are valid");
    BUILT_IN.iter().copied().flat_map(read).collect()
}

/// Reads reference depths from CSV.
///
/// # Errors
/// Those of the CSV reader, with line and field.
pub fn read(text: impl std::io::Read) -> Result<Vec<Reference>, csv::Error> {
    csv::Reader::from_reader(text).deserialize().collect()
}

/// Reads reference depths from a file; empty where there is no file.
///
/// # Errors
/// [`Error::Read`].
pub fn read_file(file: &Path) -> Result<Vec<Reference>, Error> {
    resume::rows(file)
}

/// Computes a case by the reference model.
///
/// # Errors
/// Those of the model.
pub fn compute(
    case: &BenchmarkCase,
    cells_per_radius: u32,
    control: &mut Control<'_>,
) -> Result<Reference, Error> {
    let mut scenario = case.scenario()?;
    scenario.options.axi.cells_per_radius = Some(cells_per_radius);
    let result = Axi.run(&scenario, control)?;
    let numerics = result.numerics();
    let mm = |length: f64| length * 1e3;
    Ok(Reference {
        projectile: case.projectile.clone(),
        target: case.target.clone(),
        length_to_diameter: case.length_to_diameter,
        impact_velocity_m_s: case.speed,
        cells_per_radius,
        depth_of_penetration_mm: mm(result.depth_of_penetration.unwrap_or(f64::NAN)),
        largest_depth_mm: mm(result.largest_depth.unwrap_or(f64::NAN)),
        projectile_final_length_mm: result.projectile_final_length.map(mm),
        projectile_final_diameter_mm: result.projectile_final_diameter.map(mm),
        outcome: words(result.outcome),
        energy_residual: numerics.energy_residual,
        transfer_loss: numerics.energy.transfer / numerics.energy.initial,
        steps: numerics.steps,
        particles: numerics.elements.0 + numerics.elements.1,
    })
}

fn words(outcome: Outcome) -> String {
    outcome.describe().to_owned()
}

/// A case on a mesh.
struct OnMesh<'a> {
    case: &'a BenchmarkCase,
    cells_per_radius: u32,
}

impl Job for OnMesh<'_> {
    type Row = Reference;

    fn name(&self) -> String {
        let case = self.case;
        format!(
            "{} on {}, L/D {}, {} m/s",
            case.projectile, case.target, case.length_to_diameter, case.speed
        )
    }

    fn is_done_by(&self, row: &Reference) -> bool {
        row.is_of(self.case) && row.cells_per_radius == self.cells_per_radius
    }

    fn compute(&self, control: &mut Control<'_>) -> Result<Reference, Error> {
        compute(self.case, self.cells_per_radius, control)
    }
}

/// Computes all cases that a file does not have yet, several at once, and appends each to the file as it is done: a run that is
/// broken off goes on where it was.
///
/// `report` hears of every case that is done: how many, of how many, and the case or why it failed. The work ends when `stop` becomes
/// true.
///
/// # Errors
/// [`Error::Read`] when the file cannot be read or written; [`Error::Cancelled`] when it was stopped. A case that fails does not stop
/// the others.
pub fn complete(
    file: &Path,
    cases: &[BenchmarkCase],
    cells_per_radius: u32,
    stop: &AtomicBool,
    report: &Report<'_, Reference>,
) -> Result<Vec<Reference>, Error> {
    let jobs: Vec<OnMesh<'_>> = cases
        .iter()
        .map(|case| OnMesh {
            case,
            cells_per_radius,
        })
        .collect();
    resume::complete(file, &jobs, stop, report)
}

/// Particle-steps that a processor core does in a second, from which times are estimated.
pub(crate) const PARTICLE_STEPS_PER_SECOND: f64 = 5e6;

/// Estimate of the time that a case takes one processor core on a mesh [s], from its other meshes, those that come with the library
/// among them: particles grow with the square of the cells along a length, and steps with their number. `None` without any.
pub fn seconds(case: &BenchmarkCase, cells_per_radius: u32, known: &[Reference]) -> Option<f64> {
    static BUILT_IN: LazyLock<Vec<Reference>> = LazyLock::new(built_in);
    let mut own = known.iter().chain(&*BUILT_IN).filter(|row| row.is_of(case));
    let row = own.next()?;
    let finer = f64::from(cells_per_radius) / f64::from(row.cells_per_radius);
    let work = row.particles as f64 * row.steps as f64 * finer.powi(3);
    Some(work / PARTICLE_STEPS_PER_SECOND)
}
