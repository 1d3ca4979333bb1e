//! Case of the seed paper by the axisymmetric reference, on several meshes and in targets of several radii, stored as data.

pub mod variants;

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

/// Stored results.
const BUILT_IN: &str = include_str!("../../data/paper-case.csv");

/// Impact velocities [m/s]: that of the paper's Table 1, and one at which the rod penetrates.
pub const SPEEDS: &[f64] = &[230.0, 600.0];

/// Cells along the projectile's radius and radius of the target [mm], varied one at a time.
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

/// Smallest number of cells along the projectile's radius of a mesh that counts for the depth.
pub const FINE: u32 = 12;

/// Radius of the target on which meshes are compared [mm].
pub const RADIUS: f64 = 24.0;

/// Result for the case of the seed paper on one mesh and in one target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PaperCaseRow {
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Cells along the projectile's radius.
    pub cells_per_radius: u32,
    /// Radius of the target that is modelled [mm].
    pub target_radius_mm: f64,
    /// Depth of penetration [mm].
    pub depth_of_penetration_mm: f64,
    /// Largest depth at any time [mm].
    pub largest_depth_mm: f64,
    /// Error of the energy balance as a fraction of the initial energy.
    pub energy_residual: f64,
    /// Fraction of the energy lost in the transfer between particles and grid.
    pub transfer_loss: f64,
    /// Time steps.
    pub steps: u64,
    /// Particles.
    pub particles: usize,
}

/// Case of the seed paper at an impact velocity [m/s], with options of a model in TOML.
///
/// # Errors
/// [`Error::Input`].
pub fn scenario(speed: f64, options: &str) -> Result<Scenario, Error> {
    let text = format!(
        "[projectile]\nmaterial = \"copper-woodward\"\nlength = \"12.74 mm\"\ndiameter = \"4.8 mm\"\nimpact_velocity = \"{speed} m/s\"\n\
         [target]\nmaterial = \"aluminium-2024-t351-woodward\"\nthickness = \"25 mm\"\nback_face = \"fixed\"\n{options}"
    );
    case::load_str("case of the seed paper", &text)
}

/// Stored results.
///
/// # Panics
/// Never: a test reads it.
pub fn built_in() -> Vec<PaperCaseRow> {
    csv::Reader::from_reader(BUILT_IN.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("the stored results are valid")
}

/// Reads results from a file; empty where there is no file.
///
/// # Errors
/// [`Error::Read`].
pub fn read_file(file: &Path) -> Result<Vec<PaperCaseRow>, Error> {
    resume::rows(file)
}

/// Depth at an impact velocity [m/s]: the mean over the meshes of at least [`FINE`] cells in one target, with the largest distance from it as its
/// uncertainty. `None` with fewer than three such meshes.
///
/// The depth alternates with the mesh and is not extrapolated: at 230 m/s the crater is two cells deep on 24.
pub fn depth(rows: &[PaperCaseRow], speed: f64) -> Option<Estimate> {
    let own = rows.iter().filter(|row| {
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
    type Row = PaperCaseRow;

    fn name(&self) -> String {
        format!(
            "case of the seed paper at {} m/s on {} cells per radius",
            self.speed, self.cells_per_radius
        )
    }

    fn is_done_by(&self, row: &PaperCaseRow) -> bool {
        row.impact_velocity_m_s == self.speed
            && row.cells_per_radius == self.cells_per_radius
            && row.target_radius_mm == self.target_radius_mm
    }

    fn compute(&self, control: &mut Control<'_>) -> Result<PaperCaseRow, Error> {
        let options = format!(
            "[axi]\ncells_per_radius = {}\ntarget_radius = \"{} mm\"\n",
            self.cells_per_radius, self.target_radius_mm
        );
        let scenario = scenario(self.speed, &options)?;
        let result = Axi.run(&scenario, control)?;
        let numerics = result.numerics();
        let mm = |length: Option<f64>| length.unwrap_or(f64::NAN) * 1e3;
        Ok(PaperCaseRow {
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

/// Computes the variants that a file lacks and appends them; `stop` and `report` are those of
/// [`crate::benchmark::reference::complete`].
///
/// # Errors
/// [`Error::Read`] when the file cannot be read or written; [`Error::Cancelled`] when it was stopped.
pub fn complete(
    file: &Path,
    stop: &AtomicBool,
    report: &Report<'_, PaperCaseRow>,
) -> Result<Vec<PaperCaseRow>, Error> {
    resume::complete(file, &variants(), stop, report)
}

/// All variants.
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

impl PaperCaseRow {
    /// Estimated time on one processor core [s].
    pub fn seconds(&self) -> f64 {
        self.particles as f64 * self.steps as f64 / PARTICLE_STEPS_PER_SECOND
    }
}

/// Estimated time on one processor core for the variants that these rows lack [s], from the stored results.
pub fn seconds_left(known: &[PaperCaseRow]) -> f64 {
    let done = |job: &Variant| known.iter().any(|row| job.is_done_by(row));
    let left: Vec<Variant> = variants().into_iter().filter(|job| !done(job)).collect();
    let same = |row: &&PaperCaseRow| left.iter().any(|job| job.is_done_by(row));
    built_in()
        .iter()
        .filter(same)
        .map(PaperCaseRow::seconds)
        .sum()
}
