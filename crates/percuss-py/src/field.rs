//! Names, units and descriptions of results and histories for Python.

use percuss::{
    history::{ELEMENT_COLUMNS, HistoryColumn, Read, SAMPLE_COLUMNS},
    summary::{FieldKind, RESULT_FIELDS},
    units::{ResultUnit, UnitSystem},
};
use pyo3::{exceptions::PyValueError, prelude::*};

/// A value with a name, which ends with its unit.
#[pyclass(frozen, get_all, module = "percuss._percuss")]
pub struct Field {
    name: String,
    /// Its name in SI units.
    si_name: String,
    unit: &'static str,
    /// What a number in SI units is multiplied by.
    per_si: f64,
    /// Its type in Python.
    kind: &'static str,
    description: &'static str,
}

/// The values of a result, in the order of JSON.
#[pyfunction]
pub fn result_fields() -> Vec<Field> {
    let field = |field: &percuss::summary::ResultField| Field {
        name: field.name.to_owned(),
        si_name: field.name.to_owned(),
        unit: field.number.map_or("", |number| number.unit.symbol),
        per_si: 1.0,
        kind: type_of(field.kind),
        description: field.description(),
    };
    RESULT_FIELDS.iter().map(field).collect()
}

/// The columns of a history.
#[pyfunction]
pub fn sample_columns() -> Vec<Field> {
    SAMPLE_COLUMNS.iter().map(column).collect()
}

/// The columns of a state along the axis.
#[pyfunction]
pub fn element_columns() -> Vec<Field> {
    ELEMENT_COLUMNS.iter().map(column).collect()
}

/// Ends of names, each with its unit.
#[pyfunction]
pub fn units() -> Vec<(&'static str, &'static str)> {
    let named = ResultUnit::NAMED.iter();
    named.map(|unit| (unit.suffix, unit.symbol)).collect()
}

/// Name, factor and unit of a column in a unit system; `None` where it stays as it is.
#[pyfunction]
pub fn in_units(name: &str, system: &str) -> PyResult<Option<(String, f64, &'static str)>> {
    let Some(units) = UnitSystem::named(system) else {
        let names: Vec<&str> = UnitSystem::all_names().collect();
        return Err(PyValueError::new_err(format!(
            "`{system}` is no unit system; unit systems: {}",
            names.join(", ")
        )));
    };
    let (_, own) = ResultUnit::split(name);
    let converted = units.column(name);
    Ok(converted.map(|(name, factor)| (name, factor, units.unit(own).symbol)))
}

fn column<R>(column: &HistoryColumn<R>) -> Field {
    Field {
        name: column.name(),
        si_name: column.si_name(),
        unit: column.unit.symbol,
        per_si: column.unit.per_si,
        kind: match column.read {
            Read::Number(_) => "array",
            Read::Whole(_) | Read::Size(_) => "array of int",
        },
        description: column.description,
    }
}

fn type_of(kind: FieldKind) -> &'static str {
    match kind {
        FieldKind::Text => "str",
        FieldKind::OptionalText => "str or None",
        FieldKind::Texts => "list of str",
        FieldKind::Number => "float",
        FieldKind::OptionalNumber => "float or None",
        FieldKind::OptionalCount => "int or None",
        FieldKind::OptionalTable => "Record or None",
        FieldKind::Tables => "list of Record",
    }
}
