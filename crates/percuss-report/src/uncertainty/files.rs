//! Tables of an uncertainty analysis.

use std::path::{Path, PathBuf};

use percuss::uncertainty::{
    Draw, Estimate, PERCENTS, QuantityResult, Statistics, Uncertainty, quantities,
};

use crate::{
    ReportError,
    column::{self, Column},
    replace_file::replace_files,
};

/// A quantity at a speed, or of the whole sample.
struct Spread {
    speed: Option<f64>,
    quantity: &'static str,
    statistics: Option<Statistics>,
}

/// Sensitivity of a quantity to a parameter.
struct Influence {
    quantity: &'static str,
    key: String,
    at_low: Option<f64>,
    at_high: Option<f64>,
    first_order: Option<Estimate>,
    total: Option<Estimate>,
}

/// Writes `samples.csv` (one row per run), `statistics.csv` (one row per quantity), `sensitivity.csv` (one row per quantity and parameter)
/// and, where there are velocities, `bands.csv` (one row per velocity and quantity) to a folder, which is made if it does not exist. Files
/// of these names are replaced. What does not exist is empty.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Table`].
pub fn write_uncertainty(folder: &Path, found: &Uncertainty) -> Result<Vec<PathBuf>, ReportError> {
    replace_files(folder, uncertainty_files(found)?)
}

/// The files that [`write_uncertainty`] writes: name and content of each.
///
/// # Errors
/// [`ReportError::Table`].
pub fn uncertainty_files(found: &Uncertainty) -> Result<Vec<(&'static str, Vec<u8>)>, ReportError> {
    let whole: Vec<Spread> = found
        .quantities
        .iter()
        .map(|q| Spread {
            speed: None,
            quantity: q.quantity,
            statistics: Some(q.statistics.clone()),
        })
        .collect();
    let influences: Vec<Influence> = found.quantities.iter().flat_map(influences).collect();
    let mut files = vec![
        table("samples.csv", &sample_columns(found), &found.draws)?,
        table("statistics.csv", &spread_columns(), &whole)?,
        table("sensitivity.csv", &influence_columns(), &influences)?,
    ];
    if !found.bands.is_empty() {
        let of_band = found.bands.iter().flat_map(|band| {
            band.quantities.iter().map(|q| Spread {
                speed: Some(band.impact_velocity_m_s),
                quantity: q.quantity,
                statistics: q.statistics.clone(),
            })
        });
        let of_band: Vec<Spread> = of_band.collect();
        let mut columns = spread_columns();
        columns.insert(
            0,
            Column::optional("impact_velocity_m_s", |s: &Spread| s.speed),
        );
        files.push(table("bands.csv", &columns, &of_band)?);
    }
    Ok(files)
}

fn table<R>(
    name: &'static str,
    columns: &[Column<R>],
    rows: &[R],
) -> Result<(&'static str, Vec<u8>), ReportError> {
    Ok((name, column::csv(name, columns, rows)?))
}

fn sample_columns(found: &Uncertainty) -> Vec<Column<Draw>> {
    let mut columns = Vec::new();
    for (i, input) in found.inputs.iter().enumerate() {
        let value = move |draw: &Draw| draw.inputs[i];
        let column = Column::varied(input.column.as_str(), input.words.clone(), value);
        columns.push(column);
    }
    columns.push(Column::text("outcome", |draw: &Draw| {
        column::word(&draw.outcome)
    }));
    for (i, quantity) in quantities().enumerate() {
        if found.draws.iter().any(|draw| draw.values[i].is_some()) {
            columns.push(Column::optional(quantity.name, move |draw: &Draw| {
                draw.values[i]
            }));
        }
    }
    columns.push(Column::text("error", |draw: &Draw| draw.error.clone()));
    columns
}

fn spread_columns() -> Vec<Column<Spread>> {
    let number = |name: &str, of: fn(&Statistics) -> f64| {
        Column::optional(name, move |s: &Spread| s.statistics.as_ref().map(of))
    };
    let mut columns = vec![
        Column::text("quantity", |s: &Spread| s.quantity.to_owned()),
        number("runs", |s| s.runs as f64),
        number("mean", |s| s.mean),
        number("standard_error", |s| s.standard_error),
        number("standard_deviation", |s| s.standard_deviation),
        number("smallest", |s| s.smallest),
        number("largest", |s| s.largest),
    ];
    for percent in PERCENTS {
        columns.push(Column::optional(
            format!("p{percent:02}"),
            move |s: &Spread| s.statistics.as_ref().map(|s| s.percentile(percent).value),
        ));
    }
    columns
}

fn influences(result: &QuantityResult) -> Vec<Influence> {
    let of = |bar: &percuss::uncertainty::TornadoBar| {
        let indices = result.indices.as_ref();
        let index = indices.and_then(|i| i.parameters.iter().find(|index| index.key == bar.key));
        Influence {
            quantity: result.quantity,
            key: bar.key.clone(),
            at_low: bar.at_low,
            at_high: bar.at_high,
            first_order: index.map(|index| index.first_order),
            total: index.map(|index| index.total),
        }
    };
    result.tornado.iter().map(of).collect()
}

fn influence_columns() -> Vec<Column<Influence>> {
    let mut columns = vec![
        Column::text("quantity", |i: &Influence| i.quantity.to_owned()),
        Column::text("parameter", |i: &Influence| i.key.clone()),
        Column::optional("at_5_percent", |i: &Influence| i.at_low),
        Column::optional("at_95_percent", |i: &Influence| i.at_high),
    ];
    type Of = fn(&Influence) -> Option<Estimate>;
    let kinds: [(&str, Of); 2] = [("first_order", |i| i.first_order), ("total", |i| i.total)];
    for (name, of) in kinds {
        columns.push(Column::optional(name, move |i: &Influence| {
            of(i).map(|e| e.value)
        }));
        columns.push(Column::optional(
            format!("{name}_low"),
            move |i: &Influence| of(i).map(|e| e.low),
        ));
        columns.push(Column::optional(
            format!("{name}_high"),
            move |i: &Influence| of(i).map(|e| e.high),
        ));
    }
    columns
}
