//! Depths by the axisymmetric reference, stored as data: they take hours.

use std::{
    fs::OpenOptions,
    io::Write,
    path::Path,
    sync::{
        Mutex,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

use serde::{Deserialize, Serialize};

use super::design::Shot;
use crate::{
    Error,
    axi::Axi,
    model::{Control, Model},
    outcome::Outcome,
};

/// Reference depths that come with the library.
const BUILT_IN: &str = include_str!("../../data/judge/reference.csv");

/// What the reference says of one shot on one mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Id of the projectile's material.
    pub projectile: String,
    /// Id of the target's material.
    pub target: String,
    /// Length of the projectile over its diameter.
    pub length_to_diameter: f64,
    /// Impact speed [m/s].
    pub impact_velocity_m_s: f64,
    /// Cells along the projectile's radius.
    pub cells_per_radius: u32,
    /// Depth of penetration [mm].
    pub depth_of_penetration_mm: f64,
    /// Largest depth at any time [mm].
    pub largest_depth_mm: f64,
    /// Final length of the projectile on the axis [mm]; none where nothing is left on it.
    pub projectile_final_length_mm: Option<f64>,
    /// Final diameter of the projectile [mm].
    pub projectile_final_diameter_mm: Option<f64>,
    /// How the shot ended.
    pub outcome: String,
    /// Largest part of the energy without an account.
    pub energy_residual: f64,
    /// Part of the energy lost between particles and grid.
    pub transfer_loss: f64,
    /// Time steps.
    pub steps: u64,
    /// Particles.
    pub particles: usize,
}

impl Reference {
    /// Whether this is the reference of a shot.
    pub fn is_of(&self, shot: &Shot) -> bool {
        self.projectile == shot.projectile
            && self.target == shot.target
            && self.length_to_diameter == shot.length_to_diameter
            && self.impact_velocity_m_s == shot.speed
    }
}

/// Reference depths that come with the library.
///
/// # Panics
/// Never: a test reads them.
pub fn built_in() -> Vec<Reference> {
    read(BUILT_IN.as_bytes()).expect("built-in reference depths are valid")
}

/// Reads reference depths from CSV.
///
/// # Errors
/// Those of the CSV reader, with line and field.
pub fn read(text: impl std::io::Read) -> Result<Vec<Reference>, csv::Error> {
    csv::Reader::from_reader(text).deserialize().collect()
}

/// Computes a shot by the reference model.
///
/// # Errors
/// Those of the model.
pub fn compute(
    shot: &Shot,
    cells_per_radius: u32,
    control: &mut Control<'_>,
) -> Result<Reference, Error> {
    let mut scenario = shot.scenario()?;
    scenario.options.axi.cells_per_radius = Some(cells_per_radius);
    let result = Axi.run(&scenario, control)?;
    let numerics = result.numerics();
    let mm = |length: f64| length * 1e3;
    Ok(Reference {
        projectile: shot.projectile.clone(),
        target: shot.target.clone(),
        length_to_diameter: shot.length_to_diameter,
        impact_velocity_m_s: shot.speed,
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
    outcome.in_words().to_owned()
}

/// Computes all shots that a file does not have yet, several at once, and appends each to the file as it is done: a run that is
/// broken off goes on where it was.
///
/// `report` hears of every shot that is done: how many, of how many, and the shot or why it failed.
///
/// # Errors
/// [`Error::Read`] when the file cannot be read or written. A shot that fails does not stop the others.
pub fn complete(
    file: &Path,
    shots: &[Shot],
    cells_per_radius: u32,
    report: &(dyn Fn(usize, usize, Result<&Reference, String>) + Sync),
) -> Result<Vec<Reference>, Error> {
    let known = match std::fs::File::open(file) {
        Ok(text) => read(text).map_err(|error| unreadable(file, &error))?,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(unreadable(file, &error)),
    };
    let left: Vec<&Shot> = shots
        .iter()
        .filter(|shot| {
            !known
                .iter()
                .any(|known| known.is_of(shot) && known.cells_per_radius == cells_per_radius)
        })
        .collect();
    let next = AtomicUsize::new(0);
    let done = AtomicUsize::new(shots.len() - left.len());
    let stop = AtomicBool::new(false);
    let state = Mutex::new((known, None));
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for _ in 0..threads.min(left.len()) {
            scope.spawn(|| {
                while let Some(shot) = left.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if stop.load(Ordering::Relaxed) {
                        return;
                    }
                    // Shots side by side use the machine better than the threads of one: each gets a pool of one thread.
                    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
                    let computed = match pool {
                        Ok(pool) => pool
                            .install(|| compute(shot, cells_per_radius, &mut Control::default())),
                        Err(_) => compute(shot, cells_per_radius, &mut Control::default()),
                    };
                    let mut state = state
                        .lock()
                        .unwrap_or_else(|poisoned| poisoned.into_inner());
                    let count = done.fetch_add(1, Ordering::Relaxed) + 1;
                    match computed {
                        Err(error) => report(count, shots.len(), Err(error.to_string())),
                        Ok(reference) => {
                            if let Err(error) = append(file, &reference) {
                                state.1 = Some(unreadable(file, &error));
                                stop.store(true, Ordering::Relaxed);
                                return;
                            }
                            report(count, shots.len(), Ok(&reference));
                            state.0.push(reference);
                        }
                    }
                }
            });
        }
    });
    match state
        .into_inner()
        .unwrap_or_else(|poisoned| poisoned.into_inner())
    {
        (_, Some(error)) => Err(error),
        (references, None) => Ok(references),
    }
}

fn append(file: &Path, reference: &Reference) -> Result<(), std::io::Error> {
    let empty = std::fs::metadata(file).map_or(true, |data| data.len() == 0);
    let mut buffer = csv::WriterBuilder::new()
        .has_headers(empty)
        .from_writer(Vec::new());
    buffer.serialize(reference).map_err(std::io::Error::other)?;
    let row = buffer
        .into_inner()
        .map_err(|error| std::io::Error::other(error.to_string()))?;
    let mut out = OpenOptions::new().create(true).append(true).open(file)?;
    out.write_all(&row)?;
    out.sync_data()
}

fn unreadable(file: &Path, error: &dyn std::fmt::Display) -> Error {
    Error::Read {
        path: file.to_path_buf(),
        reason: error.to_string(),
        source: None,
    }
}
