//! Files of the history of a run.

use std::path::{Path, PathBuf};

use percuss::{
    history::{
        ELEMENT_COLUMNS, ElementState, GaugeHistory, HistoryColumn, Profile, Read, SAMPLE_COLUMNS,
        Sample,
    },
    outcome::RunResult,
    units::{ResultUnit as Unit, UnitSystem},
};

use crate::{
    ReportError,
    column::{self, Column},
    error::history_of,
    replace_file::replace_file,
};

/// Writes the history of a run to a folder, which is made if it does not exist. Files of these names are replaced:
///
/// - `history.csv` and `history.parquet`: velocities, positions, forces and both balances, one row per sample;
/// - `profiles.parquet`, where the model has elements: the state along the axis, a row for each element at each recorded time;
/// - `final-profile.csv`: that state at the end;
/// - `gauges.csv` and `gauges.parquet`, where the case has gauges: a row for each gauge and time.
///
/// Column names end with the unit, of a system where one is given; both formats have the same columns and values.
///
/// # Errors
/// [`ReportError::NoHistory`] when the run kept no history; [`ReportError::Write`]; [`ReportError::Table`].
pub fn write_histories(
    folder: &Path,
    result: &RunResult,
    units: Option<UnitSystem>,
) -> Result<Vec<PathBuf>, ReportError> {
    history_files(result, units)?
        .into_iter()
        .map(|(name, content)| replace_file(folder, name, &content))
        .collect()
}

/// The files that [`write_histories`] writes: name and content of each.
///
/// # Errors
/// [`ReportError::NoHistory`] when the run kept no history; [`ReportError::Table`].
pub fn history_files(
    result: &RunResult,
    units: Option<UnitSystem>,
) -> Result<Vec<(&'static str, Vec<u8>)>, ReportError> {
    let history = history_of(result)?;
    let samples = converted(sample_columns(), units);
    let elements = converted(element_columns(), units);
    let rows = |profile: &Profile| {
        let time = profile.time;
        let states = profile.elements.clone().into_iter();
        states.map(move |state| Place {
            gauge: String::new(),
            time,
            state,
        })
    };
    let all: Vec<Place> = history.profiles.iter().flat_map(rows).collect();
    let last: Vec<Place> = history.profiles.last().into_iter().flat_map(rows).collect();
    let csv = "history.csv";
    let parquet = "history.parquet";
    let profiles = "profiles.parquet";
    let end = "final-profile.csv";
    let mut files = vec![(csv, column::csv(csv, &samples, &history.samples)?)];
    files.extend(column::parquet(parquet, &samples, &history.samples)?);
    if !all.is_empty() {
        files.extend(column::parquet(profiles, &elements, &all)?);
        files.push((end, column::csv(end, &elements, &last)?));
    }
    if !history.gauges.is_empty() {
        let (csv, parquet) = ("gauges.csv", "gauges.parquet");
        let rows: Vec<Place> = history.gauges.iter().flat_map(readings).collect();
        let columns = converted(gauge_columns(), units);
        files.push((csv, column::csv(csv, &columns, &rows)?));
        files.extend(column::parquet(parquet, &columns, &rows)?);
    }
    Ok(files)
}

/// An element, or a gauge, at a time.
struct Place {
    /// Name of the gauge; empty of an element.
    gauge: String,
    time: f64,
    state: ElementState,
}

fn readings(gauge: &GaugeHistory) -> impl Iterator<Item = Place> + '_ {
    let rows = gauge.times.iter().zip(&gauge.states);
    rows.map(|(&time, &state)| Place {
        gauge: gauge.name.clone(),
        time,
        state,
    })
}

fn gauge_columns() -> Vec<Column<Place>> {
    let gauge = Column::text("gauge", |place: &Place| place.gauge.clone());
    std::iter::once(gauge).chain(element_columns()).collect()
}

fn sample_columns() -> Vec<Column<Sample>> {
    let columns = SAMPLE_COLUMNS.iter();
    columns.map(|of| column(of, |sample| sample)).collect()
}

fn element_columns() -> Vec<Column<Place>> {
    let time = Column::float("time_us", |place: &Place| Unit::US.of_si(place.time));
    let columns = ELEMENT_COLUMNS.iter();
    let columns = columns.map(|of| column(of, |place: &Place| &place.state));
    std::iter::once(time).chain(columns).collect()
}

/// Columns in the units of a system, if there is one.
fn converted<R: 'static>(columns: Vec<Column<R>>, units: Option<UnitSystem>) -> Vec<Column<R>> {
    let columns = columns.into_iter();
    columns.map(|column| column.in_units(units)).collect()
}

/// A column of a file, in the unit of its name.
fn column<P: 'static, R>(of: &'static HistoryColumn<R>, row: fn(&P) -> &R) -> Column<P> {
    let name = of.name();
    match of.read {
        Read::Number(read) => Column::float(name, move |place| of.unit.of_si(read(row(place)))),
        Read::Whole(read) => Column::integer(name, move |place| read(row(place)) as i64),
        Read::Size(read) => Column::integer(name, move |place| read(row(place)) as i64),
    }
}
