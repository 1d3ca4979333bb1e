//! The paper's own case by the reference: on several meshes and in targets of several sizes, stored as data.

pub mod ablation;

use std::{path::Path, sync::atomic::AtomicBool};

use percuss::{
    Error, Scenario,
    axi::Axi,
    case,
    model::{Control, Model},
};
use serde::{Deserialize, Serialize};

use crate::benchmark::{
    Estimate,
    reference::PARTICLE_STEPS_PER_SECOND,
    resume::{self, Job, Report},
};

/// The study that comes with the library.
const BUILT_IN: &str = include_str!("../../data/paper-case.csv");

/// Impact speeds of the study [m/s]: that of the paper's table, and one at which the rod penetrates.
pub const SPEEDS: &[f64] = &[230.0, 600.0];

/// Cells along the projectile's radius and radius of the target [mm]: one is varied at a time.
pub const VARIANTS: &[(u32, f64)] = &[
    (4, RADIUS),
    (8, RADIUS),
    (12, RADIUS),
    (14, RADIUS),
    (16, RADIUS),
    (20, RADIUS),
    (24, RADIUS),
    (8, 16.0),
    (8, 36.0),
];

/// Fewest cells along the projectile's radius of a mesh that counts for the depth.
pub const FINE: u32 = 12;

/// Radius of the target on which meshes are compared [mm].
pub const RADIUS: f64 = 24.0;

/// The paper's case on one mesh and in one target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// Impact speed [m/s].
    pub impact_velocity_m_s: f64,
    /// Cells along the projectile's radius.
    pub cells_per_radius: u32,
    /// Radius of the target that is modelled [mm].
    pub target_radius_mm: f64,
    /// Depth of penetration [mm].
    pub depth_of_penetration_mm: f64,
    /// Largest depth at any time [mm].
    pub largest_depth_mm: f64,
    /// Largest part of the energy without an account.
    pub energy_residual: f64,
    /// Part of the energy lost between particles and grid.
    pub transfer_loss: f64,
    /// Time steps.
    pub steps: u64,
    /// Particles.
    pub particles: usize,
}

/// The paper's case at a speed [m/s], with options of a model, in TOML.
///
/// # Errors
/// [`Error::Input`].
pub fn scenario(speed: f64, options: &str) -> Result<Scenario, Error> {
    let text = format!(
        "[projectile]\nmaterial = \"copper-woodward\"\nlength = \"12.74 mm\"\ndiameter = \"4.8 mm\"\nimpact_velocity = \"{speed} m/s\"\n\
         [target]\nmaterial = \"aluminium-2024-t351-woodward\"\nthickness = \"25 mm\"\nback_face = \"fixed\"\n{options}"
    );
    case::load_str("the paper's case", &text)
}

/// The study that comes with the library.
///
/// # Panics
/// Never: a test reads it.
pub fn built_in() -> Vec<Study> {
    csv::Reader::from_reader(BUILT_IN.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("the built-in study is valid")
}

/// Reads a study from a file; none where there is no file.
///
/// # Errors
/// [`Error::Read`].
pub fn read_file(file: &Path) -> Result<Vec<Study>, Error> {
    resume::rows(file)
}

/// Depth at a speed [m/s]: the mean over the meshes of at least [`FINE`] cells in one target, with the largest distance from it as its
/// uncertainty. `None` with fewer than three such meshes.
///
/// The depth alternates with the mesh and is not extrapolated: at 230 m/s the crater is two cells deep on 24.
pub fn depth(study: &[Study], speed: f64) -> Option<Estimate> {
    let own = study.iter().filter(|row| {
        row.impact_velocity_m_s == speed
            && row.target_radius_mm == RADIUS
            && row.cells_per_radius >= FINE
    });
    let depths: Vec<f64> = own.map(|row| row.depth_of_penetration_mm).collect();
    if depths.len() < 3 {
        return None;
    }
    let mean = depths.iter().sum::<f64>() / depths.len() as f64;
    let distances = depths.iter().map(|depth| (depth - mean).abs());
    Some(Estimate {
        depth_mm: mean,
        uncertainty_mm: distances.fold(0.0, f64::max),
    })
}

struct Variant {
    speed: f64,
    cells_per_radius: u32,
    target_radius_mm: f64,
}

impl Job for Variant {
    type Row = Study;

    fn name(&self) -> String {
        format!(
            "the paper's case at {} m/s on {} cells per radius",
            self.speed, self.cells_per_radius
        )
    }

    fn is_done_by(&self, row: &Study) -> bool {
        row.impact_velocity_m_s == self.speed
            && row.cells_per_radius == self.cells_per_radius
            && row.target_radius_mm == self.target_radius_mm
    }

    fn compute(&self, control: &mut Control<'_>) -> Result<Study, Error> {
        let options = format!(
            "[axi]\ncells_per_radius = {}\ntarget_radius = \"{} mm\"\n",
            self.cells_per_radius, self.target_radius_mm
        );
        let scenario = scenario(self.speed, &options)?;
        let result = Axi.run(&scenario, control)?;
        let numerics = result.numerics();
        let mm = |length: Option<f64>| length.unwrap_or(f64::NAN) * 1e3;
        Ok(Study {
            impact_velocity_m_s: self.speed,
            cells_per_radius: self.cells_per_radius,
            target_radius_mm: self.target_radius_mm,
            depth_of_penetration_mm: mm(result.depth_of_penetration),
            largest_depth_mm: mm(result.largest_depth),
            energy_residual: numerics.energy_residual,
            transfer_loss: numerics.energy.transfer / numerics.energy.initial,
            steps: numerics.steps,
            particles: numerics.elements.0 + numerics.elements.1,
        })
    }
}

/// Computes what of the study a file does not have yet, and appends it; `stop` and `report` are those of
/// [`crate::benchmark::reference::complete`].
///
/// # Errors
/// [`Error::Read`] when the file cannot be read or written; [`Error::Cancelled`] when it was stopped.
pub fn complete(
    file: &Path,
    stop: &AtomicBool,
    report: &Report<'_, Study>,
) -> Result<Vec<Study>, Error> {
    resume::complete(file, &variants(), stop, report)
}

/// All variants of the study.
fn variants() -> Vec<Variant> {
    let at = |speed: f64| {
        VARIANTS
            .iter()
            .map(move |&(cells_per_radius, radius)| Variant {
                speed,
                cells_per_radius,
                target_radius_mm: radius,
            })
    };
    SPEEDS.iter().flat_map(|&speed| at(speed)).collect()
}

impl Study {
    /// Time that it takes a processor core [s], by the work that it is.
    pub fn seconds(&self) -> f64 {
        self.particles as f64 * self.steps as f64 / PARTICLE_STEPS_PER_SECOND
    }
}

/// Estimate of the time that one processor core takes for what rows lack of the study [s], by those that come with the library.
pub fn seconds_left(known: &[Study]) -> f64 {
    let done = |job: &Variant| known.iter().any(|row| job.is_done_by(row));
    let left: Vec<Variant> = variants().into_iter().filter(|job| !done(job)).collect();
    let same = |row: &&Study| left.iter().any(|job| job.is_done_by(row));
    built_in().iter().filter(same).map(Study::seconds).sum()
}
