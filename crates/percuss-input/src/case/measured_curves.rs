//! Curves that were measured in the test of a case, from their tables.

use std::borrow::Cow;

use super::{Case, Document};
use crate::{
    check::Diagnostic,
    csv_table::{
        CsvRow, CsvTable, KnownColumn, REMARKS_HELP, Recognised, SEPARATORS_HELP, names, recognise,
    },
    document::read_text,
    error::{Error, InputError},
    history::{ELEMENT_COLUMNS, Read, SAMPLE_COLUMNS},
    problem::{CurveUncertainty, MeasuredTable, SourceKeys},
    scenario::MeasuredCurve,
    units::{ColumnUnit, ResultUnit, Time, column_symbols, shorten, split_number},
};

/// Name of the column of times.
const TIME: &str = "time";
/// Most characters of the tables of a case: a copy of the case holds them all.
const MOST: usize = 3 << 18;

/// Quantity of a curve: name without unit and unit of its kind.
type Kind = (&'static str, ResultUnit);

/// The measured curves of a case, in the order of its tables and their columns.
pub(super) fn measured_curves(
    case: &Case,
    document: &Document,
) -> Result<Vec<MeasuredCurve>, Error> {
    let mut curves = Vec::new();
    let mut length = 0;
    for (i, table) in case.measured_curves.iter().enumerate() {
        let key = format!("measured_curves.{i}");
        let (file, text) = source(table, &key, document)?;
        length += text.len();
        if length > MOST {
            let message = format!("the measured curves have more than {} KiB", MOST >> 10);
            let help = "keep fewer rows: a few hundred show a curve";
            return Err(document.place(Diagnostic::at(&key, message, help)).into());
        }
        let mut found = read(&file, &text, table, i)?;
        if let Some(uncertainty) = &table.uncertainty {
            set_uncertainties(&mut found, uncertainty)
                .map_err(|diagnostic| document.place(diagnostic.within(&key)))?;
        }
        curves.extend(found);
    }
    Ok(curves)
}

/// Gives the curves of a table their uncertainties.
fn set_uncertainties(
    curves: &mut [MeasuredCurve],
    uncertainty: &CurveUncertainty,
) -> Result<(), Diagnostic> {
    let key = "uncertainty";
    let quantities: Vec<&str> = curves.iter().map(|curve| curve.quantity).collect();
    match uncertainty {
        CurveUncertainty::Of(text) => {
            let [curve] = curves else {
                let message = format!("the table has {} quantities", quantities.len());
                let help = format!(
                    "give a table: uncertainty = {{ {} = \"...\" }}; quantities: {}",
                    quantities.first().unwrap_or(&""),
                    quantities.join(", ")
                );
                return Err(Diagnostic::at(key, message, help));
            };
            curve.uncertainty = Some(uncertainty_of(curve, text, key)?);
        }
        CurveUncertainty::Each(texts) => {
            for (quantity, text) in texts {
                let key = format!("{key}.{quantity}");
                let curve = curves.iter_mut().find(|curve| curve.quantity == quantity);
                let Some(curve) = curve else {
                    let message = format!("the table has no quantity `{}`", shorten(quantity));
                    let help = format!("quantities: {}", quantities.join(", "));
                    return Err(Diagnostic::at(&key, message, help));
                };
                curve.uncertainty = Some(uncertainty_of(curve, text, &key)?);
            }
        }
    }
    Ok(())
}

/// Standard uncertainty of a curve in SI units.
fn uncertainty_of(curve: &MeasuredCurve, text: &str, key: &str) -> Result<f64, Diagnostic> {
    let example = format!("\"1 {}\"", curve.unit.symbol);
    let refuse = |message: String, help: String| Err(Diagnostic::at(key, message, help));
    let Some((value, unit)) = split_number(text.trim()) else {
        return refuse(
            format!("`{}` is no number with a unit", shorten(text)),
            format!("write it as in {}", example.trim()),
        );
    };
    let Some(unit) = ColumnUnit::named(unit, curve.unit) else {
        return refuse(
            match unit {
                "" => format!("the unit of `{}` is missing", shorten(text)),
                _ => format!("`{}` is no unit of `{}`", shorten(unit), curve.quantity),
            },
            format!("units: {}", column_symbols(curve.unit)),
        );
    };
    let si = unit.difference_to_si(value);
    if !(si.is_finite() && si > 0.0) {
        return refuse(
            format!("the uncertainty `{}` is not positive", shorten(text)),
            "give the standard uncertainty of the values, or remove the key".to_owned(),
        );
    }
    Ok(si)
}

/// Text of the table, with the name that stands for its file in messages.
fn source<'a>(
    table: &'a MeasuredTable,
    key: &str,
    document: &Document,
) -> Result<(String, Cow<'a, str>), Error> {
    let refuse = |message: &str, help: &str| -> Error {
        let diagnostic = Diagnostic::at(&format!("{key}.file"), message, help);
        document.place(diagnostic).into()
    };
    let Some(relative) = &table.file else {
        let text = table.csv.as_deref().unwrap_or_default();
        return Ok((format!("{}: {key}.csv", document.file), text.into()));
    };
    let path = match &document.folder {
        Some(folder) => folder.join(relative),
        None => {
            return Err(refuse(
                "a case that comes from no file cannot name files of measured curves",
                "give the text of the file as `csv`",
            ));
        }
    };
    match read_text(&path) {
        Ok(text) => Ok((path.display().to_string(), text.into())),
        Err(error) => {
            let (message, remedy) = error.message_and_help();
            let place = "the path is relative to the case file";
            let help = match remedy.as_str() {
                "" => place.to_owned(),
                remedy => format!("{remedy}; {place}"),
            };
            let diagnostic = Diagnostic::at(&format!("{key}.file"), message, help);
            Err(document.place(diagnostic.of_case_file()).into())
        }
    }
}

/// A column with the quantity and unit that it is in.
struct Found {
    column: String,
    kind: Kind,
    unit: ColumnUnit,
}

fn read(
    file: &str,
    text: &str,
    of: &MeasuredTable,
    index: usize,
) -> Result<Vec<MeasuredCurve>, Error> {
    let (table, records) = CsvTable::read(file, text)?;
    let (time, columns, recognised) = columns(&table, of)?;
    let rows: Vec<CsvRow<'_>> = records
        .into_iter()
        .map(|record| CsvRow {
            table: &table,
            record,
        })
        .collect();
    let times = times(&rows, &time)?;
    let curve = |column: &Found| -> Result<MeasuredCurve, Error> {
        let mut points = Vec::new();
        for (row, time) in rows.iter().zip(&times) {
            if let Some(value) = row.number(&column.column)? {
                points.push((*time, column.unit.to_si(value)));
            }
        }
        if points.len() < 2 {
            let at = table.header.iter().position(|name| *name == column.column);
            let span = table.name_span(at.unwrap_or(0));
            let message = format!("`{}` has fewer than two values", column.column);
            let help = "a curve has two values or more: one row for each time";
            return Err(table.error(span, &column.column, message, help).into());
        }
        Ok(MeasuredCurve {
            name: of.name(index),
            gauge: of.gauge.clone(),
            quantity: column.kind.0,
            unit: column.kind.1,
            points,
            unread_columns: recognised.unread.clone(),
            read_as: recognised.read_as.clone(),
            uncertainty: None,
            correlation_time: of.correlation_time.map(Time::si),
            sources: match &of.source {
                Some(SourceKeys(keys)) => keys.clone(),
                None => vec![of.name(index)],
            },
            table: index,
        })
    };
    columns.iter().map(curve).collect()
}

/// Times [s], each later than the one before it.
fn times(rows: &[CsvRow<'_>], time: &Found) -> Result<Vec<f64>, Box<InputError>> {
    let mut times: Vec<f64> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let value = time.unit.to_si(row.required_number(&time.column)?);
        if times.last().is_some_and(|before| value <= *before) {
            let before = rows[i - 1].text(&time.column);
            let message = format!(
                "time {} does not come after {before}",
                row.text(&time.column)
            );
            let help = "sort the rows by time and keep one row for each time";
            return Err(row.error(&time.column, message, help));
        }
        times.push(value);
    }
    Ok(times)
}

/// The column of times, those of quantities, and what the names of the table are.
fn columns(
    table: &CsvTable<'_>,
    of: &MeasuredTable,
) -> Result<(Found, Vec<Found>, Recognised), Box<InputError>> {
    let at_gauge = of.gauge.is_some();
    let (own, others) = match at_gauge {
        true => (gauge_kinds(), sample_kinds()),
        false => (sample_kinds(), gauge_kinds()),
    };
    let others = others.into_iter().filter(|kind| !own.contains(kind));
    let kinds: Vec<Kind> = own.iter().copied().chain(others).collect();
    let full_names = kinds
        .iter()
        .map(|(name, unit)| format!("{name}{}", unit.suffix));
    let full_names: Vec<String> = full_names.collect();
    let known = kinds.iter().zip(&full_names);
    let known: Vec<KnownColumn<'_>> = known
        .map(|((quantity, unit), name)| KnownColumn {
            name,
            quantity,
            aliases: names::of_curve(quantity),
            unit: Some(*unit),
        })
        .collect();
    let recognised = recognise(table, &known, &[])?;
    let mut times = None;
    let mut found: Vec<Found> = Vec::new();
    for (i, name) in table.header.iter().enumerate() {
        let Some((at, Some(unit))) = recognised.columns[i] else {
            continue;
        };
        let kind = kinds[at];
        if at >= own.len() {
            let (message, help) = of_other_table(kind.0, at_gauge);
            return Err(table.error(table.name_span(i), name, message, help));
        }
        let column = Found {
            column: name.clone(),
            kind,
            unit,
        };
        match kind.0 {
            TIME => times = Some(column),
            _ => found.push(column),
        }
    }
    let separator = match table.header.len() {
        1 => SEPARATORS_HELP,
        _ => "",
    };
    let Some(time) = times else {
        let help = format!("name it with its unit, such as `time_us`{separator}{REMARKS_HELP}");
        return Err(table.error(0..0, "", "the table has no column of times", help));
    };
    if found.is_empty() {
        let names: Vec<&str> = own.iter().map(|(name, _)| *name).skip(1).collect();
        let help = format!("quantities: {}", names.join(", "));
        return Err(table.error(0..0, "", "the table has no column of a quantity", help));
    }
    Ok((time, found, recognised))
}

fn of_other_table(quantity: &str, at_gauge: bool) -> (String, String) {
    match at_gauge {
        true => (
            format!("`{quantity}` is no quantity of a gauge"),
            "put it into a table of its own, without `gauge`".to_owned(),
        ),
        false => (
            format!("`{quantity}` is a quantity of a gauge"),
            "name the gauge of the case: `gauge = \"NAME\"`".to_owned(),
        ),
    }
}

/// Time and the quantities of a history.
fn sample_kinds() -> Vec<Kind> {
    let columns = SAMPLE_COLUMNS.iter();
    let numbers = columns.filter(|column| matches!(column.read, Read::Number(_)));
    numbers
        .map(|column| (column.quantity, column.unit))
        .collect()
}

/// Time and the quantities of a gauge.
fn gauge_kinds() -> Vec<Kind> {
    let columns = ELEMENT_COLUMNS.iter();
    let numbers = columns.filter(|column| matches!(column.read, Read::Number(_)));
    let numbers = numbers.map(|column| (column.quantity, column.unit));
    std::iter::once((TIME, ResultUnit::US))
        .chain(numbers)
        .collect()
}
