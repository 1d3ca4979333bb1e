//! Files of a comparison.

use std::path::{Path, PathBuf};

use percuss::{
    compare::Comparison,
    outcome::{Band, BandQuantity},
    summary::ResultRecord,
    units::UnitSystem,
};

use crate::{
    ReportError,
    column::{self, Column, word},
    replace_file::replace_files,
};

/// An entry of a comparison.
struct Entry {
    record: ResultRecord,
    regime: &'static str,
    recommended: bool,
}

/// Writes `compare.csv` and `compare.parquet` to a folder, which is made if it does not exist: one row per velocity and model.
/// Files of these names are replaced.
///
/// Column names end with the unit, of a system where one is given; both formats have the same columns and values. What a model does not give is empty or
/// null.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Table`].
pub fn write_comparison(
    folder: &Path,
    comparison: &Comparison,
    units: Option<UnitSystem>,
) -> Result<Vec<PathBuf>, ReportError> {
    replace_files(folder, comparison_files(comparison, units)?)
}

/// The files that [`write_comparison`] writes: name and content of each.
///
/// # Errors
/// [`ReportError::Table`].
pub fn comparison_files(
    comparison: &Comparison,
    units: Option<UnitSystem>,
) -> Result<Vec<(&'static str, Vec<u8>)>, ReportError> {
    let entries: Vec<Entry> = (0..comparison.regime.len())
        .flat_map(|i| {
            let recommended = &comparison.recommended[i].models;
            comparison
                .at_impact_velocity(i)
                .iter()
                .map(move |record| Entry {
                    record: record.clone(),
                    regime: comparison.regime[i].regime.projectile.describe(),
                    recommended: recommended
                        .iter()
                        .any(|choice| choice.model == record.model),
                })
        })
        .collect();
    let columns = columns().into_iter();
    let columns: Vec<Column<Entry>> = columns.map(|column| column.in_units(units)).collect();
    column::files(["compare.csv", "compare.parquet"], &columns, &entries)
}

fn columns() -> Vec<Column<Entry>> {
    let end = |quantity: BandQuantity, end: fn(&Band) -> f64| {
        move |entry: &Entry| {
            let band = entry.record.band.as_ref();
            band.filter(|band| band.quantity == quantity).map(end)
        }
    };
    let mut columns = vec![
        Column::float("impact_velocity_m_s", |e: &Entry| {
            e.record.impact_velocity_m_s
        }),
        Column::text("regime", |e: &Entry| e.regime.to_owned()),
        Column::text("model", |e: &Entry| e.record.model.to_owned()),
        Column::integer("recommended", |e: &Entry| i64::from(e.recommended)),
        Column::text("outcome", |e: &Entry| word(&e.record.outcome)),
    ];
    for &quantity in BandQuantity::ALL {
        let name = quantity.name();
        columns.push(Column::optional(name, move |e: &Entry| {
            e.record.value(quantity)
        }));
        columns.push(Column::optional(
            format!("low_{name}"),
            end(quantity, |band| band.low),
        ));
        columns.push(Column::optional(
            format!("high_{name}"),
            end(quantity, |band| band.high),
        ));
    }
    columns.push(Column::integer("warnings", |e: &Entry| {
        e.record.warnings.len() as i64
    }));
    columns.push(Column::text("reason", |e: &Entry| {
        e.record.reason.clone().unwrap_or_default()
    }));
    columns
}
