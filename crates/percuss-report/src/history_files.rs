//! Files that hold the history of a run.

use std::path::{Path, PathBuf};

use percuss::{
    history::{ElementState, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    outcome::RunResult,
};

use crate::{
    ReportError,
    column::{self, Column},
    error::history_of,
    replace_file::replace_file,
};

/// Writes the history of a run to a folder, which is made if it does not exist. Files of these names are replaced:
///
/// - `history.csv` and `history.parquet`: velocities, positions, forces and both books, a row a sample;
/// - `profiles.parquet`: the state along the axis, a row for each element at each recorded time;
/// - `final-profile.csv`: that state at the end.
///
/// Column names end with the unit; both formats have the same columns and values.
///
/// # Errors
/// [`ReportError::NoHistory`] when the run kept no history; [`ReportError::Write`]; [`ReportError::Table`].
pub fn write_histories(folder: &Path, result: &RunResult) -> Result<Vec<PathBuf>, ReportError> {
    history_files(result)?
        .into_iter()
        .map(|(name, content)| replace_file(folder, name, &content))
        .collect()
}

/// The files that [`write_histories`] writes: name and content of each.
///
/// # Errors
/// [`ReportError::NoHistory`] when the run kept no history; [`ReportError::Table`].
pub fn history_files(result: &RunResult) -> Result<Vec<(&'static str, Vec<u8>)>, ReportError> {
    let history = history_of(result)?;
    let samples = sample_columns();
    let elements = element_columns();
    let rows = |profile: &Profile| {
        let time = profile.time;
        let states = profile.elements.clone().into_iter();
        states.map(move |state| Place { time, state })
    };
    let all: Vec<Place> = history.profiles.iter().flat_map(rows).collect();
    let last: Vec<Place> = history.profiles.last().into_iter().flat_map(rows).collect();
    let csv = "history.csv";
    let parquet = "history.parquet";
    let profiles = "profiles.parquet";
    let end = "final-profile.csv";
    let mut files = vec![(csv, column::csv(csv, &samples, &history.samples)?)];
    files.extend(column::parquet(parquet, &samples, &history.samples)?);
    files.extend(column::parquet(profiles, &elements, &all)?);
    files.push((end, column::csv(end, &elements, &last)?));
    Ok(files)
}

/// An element at a time.
struct Place {
    time: f64,
    state: ElementState,
}

fn sample_columns() -> Vec<Column<Sample>> {
    let mut columns: Vec<Column<Sample>> = vec![
        Column::float("time_us", |s: &Sample| s.time * 1e6),
        Column::integer("step", |s: &Sample| s.step as i64),
        Column::float("tip_velocity_m_s", |s: &Sample| s.tip_velocity),
        Column::float("tail_velocity_m_s", |s: &Sample| s.tail_velocity),
        Column::float("interface_velocity_m_s", |s: &Sample| s.interface_velocity),
        Column::float("back_velocity_m_s", |s: &Sample| s.back_velocity),
        Column::float("mean_velocity_m_s", |s: &Sample| s.mean_velocity),
        Column::float("tip_position_mm", |s: &Sample| s.tip_position * 1e3),
        Column::float("depth_mm", |s: &Sample| s.depth * 1e3),
        Column::float("projectile_length_mm", |s: &Sample| {
            s.projectile_length * 1e3
        }),
        Column::float("contact_force_kn", |s: &Sample| s.contact_force * 1e-3),
        Column::float("back_force_kn", |s: &Sample| s.back_force * 1e-3),
        Column::float("energy_initial_j", |s: &Sample| s.energy.initial),
    ];
    for (line, (label, _)) in EnergyLedger::default().lines().into_iter().enumerate() {
        let name = format!("energy_{}_j", label.replace(", ", "_").replace(' ', "_"));
        columns.push(Column::float(name, move |s: &Sample| {
            s.energy.lines()[line].1
        }));
    }
    columns.push(Column::float("momentum_initial_n_s", |s: &Sample| {
        s.momentum.initial
    }));
    for (line, (label, _)) in MomentumLedger::default().lines().into_iter().enumerate() {
        let name = format!("momentum_{}_n_s", label.replace(' ', "_"));
        columns.push(Column::float(name, move |s: &Sample| {
            s.momentum.lines()[line].1
        }));
    }
    columns
}

fn element_columns() -> Vec<Column<Place>> {
    vec![
        Column::float("time_us", |p: &Place| p.time * 1e6),
        Column::integer("part", |p: &Place| p.state.part as i64),
        Column::float("initial_position_mm", |p: &Place| {
            p.state.initial_position * 1e3
        }),
        Column::float("position_mm", |p: &Place| p.state.position * 1e3),
        Column::float("length_mm", |p: &Place| p.state.length * 1e3),
        Column::float("stress_mpa", |p: &Place| p.state.stress * 1e-6),
        Column::float("strain", |p: &Place| p.state.strain),
        Column::float("plastic_strain", |p: &Place| p.state.plastic_strain),
        Column::float("diameter_mm", |p: &Place| p.state.diameter * 1e3),
        Column::float("temperature_k", |p: &Place| p.state.temperature),
    ]
}
