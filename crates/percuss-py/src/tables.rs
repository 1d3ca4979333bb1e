//! Values of Python as tables of TOML.

use pyo3::{
    exceptions::{PyTypeError, PyValueError},
    prelude::*,
    types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple},
};
use toml::{Table, Value};

/// Deepest nesting of tables and lists; a case has four levels.
const DEEPEST: u32 = 32;
/// Most values of a dictionary, those inside others included.
const MOST: u32 = 1_000_000;

/// The table of a dictionary; a key whose value is `None` is left out.
///
/// A dictionary that is nested too deeply, as one that holds itself is, or that has too many values, is an error.
pub fn to_toml(dict: &Bound<'_, PyDict>) -> PyResult<Table> {
    Reader { left: MOST }.table(dict, 0)
}

/// The text of a dictionary as a TOML file.
#[pyfunction]
pub fn toml_text(dict: &Bound<'_, PyDict>) -> PyResult<String> {
    Ok(to_toml(dict)?.to_string())
}

/// Values that may still be read.
struct Reader {
    left: u32,
}

impl Reader {
    fn table(&mut self, dict: &Bound<'_, PyDict>, depth: u32) -> PyResult<Table> {
        let mut table = Table::new();
        for (key, item) in dict {
            let key: String = key.extract()?;
            if !item.is_none() {
                let value = self.value(&key, &item, depth + 1)?;
                table.insert(key, value);
            }
        }
        Ok(table)
    }

    fn value(&mut self, key: &str, item: &Bound<'_, PyAny>, depth: u32) -> PyResult<Value> {
        if depth > DEEPEST {
            return Err(PyValueError::new_err(format!(
                "`{key}` is nested more than {DEEPEST} levels deep; a dict or a list may not hold itself"
            )));
        }
        self.left = self.left.checked_sub(1).ok_or_else(|| {
            PyValueError::new_err(format!("`{key}`: more than {MOST} values in all"))
        })?;

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
            return Ok(Value::Table(self.table(dict, depth)?));
        }
        if item.is_instance_of::<PyList>() || item.is_instance_of::<PyTuple>() {
            let items = item
                .try_iter()?
                .map(|item| self.value(key, &item?, depth + 1));
            return Ok(Value::Array(items.collect::<PyResult<_>>()?));
        }
        // Quantities of pint and astropy, whose lists would lose their unit.
        let quantity = item
            .py()
            .import("percuss.quantities")?
            .call_method1("text", (item,));
        let quantity = quantity.map_err(|error| {
            PyValueError::new_err(format!("`{key}`: {}", error.value(item.py())))
        })?;
        if !quantity.is_none() {
            return self.value(key, &quantity, depth);
        }
        // Arrays and numbers of NumPy, and whatever else knows how to become Python's own.
        if let Ok(own) = item.call_method0("tolist") {
            return self.value(key, &own, depth + 1);
        }
        if let Ok(path) = item.call_method0("__fspath__") {
            return self.value(key, &path, depth + 1);
        }
        Err(PyTypeError::new_err(format!(
            "`{key}`: a {} has no place in a case; give a number, a text such as \"4.8 mm\", a list or a dict",
            item.get_type().name()?
        )))
    }
}
