//! File of the fragments at the end of a run.

use std::path::{Path, PathBuf};

use percuss::{fragments::FragmentRecord, outcome::RunResult, units::UnitSystem};

use crate::{
    ReportError,
    column::{self, Column},
    replace_file::replace_file,
};

/// Writes `fragments.csv` to a folder, which is made if it does not exist: one row per fragment, from the tail of the projectile to the rear face of
/// the target. Nothing is written for a result without fragments. A file of this name is replaced.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Table`].
pub fn write_fragments(
    folder: &Path,
    result: &RunResult,
    units: Option<UnitSystem>,
) -> Result<Vec<PathBuf>, ReportError> {
    if result.fragments.is_empty() {
        return Ok(Vec::new());
    }
    let name = "fragments.csv";
    let rows: Vec<FragmentRecord> = result.fragments.iter().map(Into::into).collect();
    let columns = columns().into_iter();
    let columns: Vec<Column<FragmentRecord>> =
        columns.map(|column| column.in_units(units)).collect();
    let content = column::csv(name, &columns, &rows)?;
    Ok(vec![replace_file(folder, name, &content)?])
}

fn columns() -> Vec<Column<FragmentRecord>> {
    vec![
        Column::text("origin", |f: &FragmentRecord| f.origin.clone()),
        Column::float("initial_from_mm", |f: &FragmentRecord| f.initial_from_mm),
        Column::float("initial_to_mm", |f: &FragmentRecord| f.initial_to_mm),
        Column::float("mass_g", |f: &FragmentRecord| f.mass_g),
        Column::float("velocity_m_s", |f: &FragmentRecord| f.velocity_m_s),
        Column::float("length_mm", |f: &FragmentRecord| f.length_mm),
        Column::float("diameter_mm", |f: &FragmentRecord| f.diameter_mm),
        Column::float("position_mm", |f: &FragmentRecord| f.position_mm),
        Column::float("kinetic_energy_j", |f: &FragmentRecord| f.kinetic_energy_j),
    ]
}
