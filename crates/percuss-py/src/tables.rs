//! Values of Python as tables of TOML.

use pyo3::{
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
    types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple},
};
use toml::{Table, Value};

/// The table of a dictionary; a key whose value is `None` is left out.
pub fn to_toml(dict: &Bound<'_, PyDict>) -> PyResult<Table> {
    let mut table = Table::new();
    for (key, item) in dict {
        let key: String = key.extract()?;
        if !item.is_none() {
            table.insert(key.clone(), value(&key, &item)?);
        }
    }
    Ok(table)
}

/// The text of a dictionary as a TOML file.
#[pyfunction]
pub fn toml_text(dict: &Bound<'_, PyDict>) -> PyResult<String> {
    Ok(to_toml(dict)?.to_string())
}

fn value(key: &str, item: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(flag) = item.cast::<PyBool>() {
        return Ok(Value::Boolean(flag.is_true()));
    }
    if let Ok(text) = item.cast::<PyString>() {
        return Ok(Value::String(text.to_str()?.to_owned()));
    }
    if item.is_instance_of::<PyInt>() {
        let number = item.extract().map_err(|_| {
            PyValueError::new_err(format!("`{key}`: the whole number is too large"))
        })?;
        return Ok(Value::Integer(number));
    }
    if let Ok(number) = item.cast::<PyFloat>() {
        return Ok(Value::Float(number.value()));
    }
    if let Ok(dict) = item.cast::<PyDict>() {
        return Ok(Value::Table(to_toml(dict)?));
    }
    if item.is_instance_of::<PyList>() || item.is_instance_of::<PyTuple>() {
        let items = item.try_iter()?.map(|item| value(key, &item?));
        return Ok(Value::Array(items.collect::<PyResult<_>>()?));
    }
    // Arrays and numbers of NumPy, and whatever else knows how to become Python's own.
    if let Ok(own) = item.call_method0("tolist") {
        return value(key, &own);
    }
    if let Ok(path) = item.call_method0("__fspath__") {
        return value(key, &path);
    }
    Err(PyTypeError::new_err(format!(
        "`{key}`: a {} has no place in a case; give a number, a text such as \"4.8 mm\", a list or a dict",
        item.get_type().name()?
    )))
}
