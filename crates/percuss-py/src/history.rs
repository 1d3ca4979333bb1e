//! Histories and samples as arrays of NumPy that are views of the memory of a result: nothing is copied.

use std::{any::Any, mem::size_of, sync::Arc};

use percuss::{
    history::{ELEMENT_COLUMNS, HistoryColumn, Read, SAMPLE_COLUMNS},
    outcome::RunResult,
};
use pyo3::{prelude::*, types::PyDict};

/// A column that NumPy can look at; it keeps the result alive for as long as an array does.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct Column {
    _owner: Arc<dyn Any + Send + Sync>,
    address: usize,
    stride: usize,
    count: usize,
    kind: &'static str,
}

impl Column {
    /// A column of the history by its name in SI units.
    pub fn of_samples(result: &Arc<RunResult>, si_name: &str) -> Option<Self> {
        let history = result.history.as_ref()?;
        Self::new(result, SAMPLE_COLUMNS, si_name, &history.samples)
    }

    /// A column of a state along the axis by its name in SI units.
    pub fn of_elements(result: &Arc<RunResult>, index: usize, si_name: &str) -> Option<Self> {
        let profile = result.history.as_ref()?.profiles.get(index)?;
        Self::new(result, ELEMENT_COLUMNS, si_name, &profile.elements)
    }

    /// A column of the state at a gauge by its name in SI units.
    pub fn of_gauge(result: &Arc<RunResult>, index: usize, si_name: &str) -> Option<Self> {
        let gauge = result.history.as_ref()?.gauges.get(index)?;
        Self::new(result, ELEMENT_COLUMNS, si_name, &gauge.states)
    }

    /// A column that stands by itself; `values` belong to `owner`.
    pub fn of_numbers<O: Any + Send + Sync>(owner: &Arc<O>, values: &[f64]) -> Self {
        Self {
            _owner: owner.clone(),
            address: values.as_ptr() as usize,
            stride: size_of::<f64>(),
            count: values.len(),
            kind: "f8",
        }
    }

    fn new<R>(
        owner: &Arc<RunResult>,
        columns: &[HistoryColumn<R>],
        si_name: &str,
        rows: &[R],
    ) -> Option<Self> {
        let column = columns.iter().find(|column| column.si_name() == si_name)?;
        Some(Self {
            _owner: owner.clone(),
            address: rows.as_ptr() as usize + column.offset,
            stride: size_of::<R>(),
            count: rows.len(),
            kind: match column.read {
                Read::Number(_) => "f8",
                Read::Whole(_) => "u8",
                Read::Size(_) if size_of::<usize>() == 8 => "u8",
                Read::Size(_) => "u4",
            },
        })
    }
}

#[pymethods]
impl Column {
    /// What NumPy asks of memory that it is to look at: a result is never written to again, so the array is read-only.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let order = if cfg!(target_endian = "little") {
            "<"
        } else {
            ">"
        };
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("shape", (self.count,))?;
        interface.set_item("typestr", format!("{order}{}", self.kind))?;
        interface.set_item("data", (self.address, true))?;
        interface.set_item("strides", (self.stride,))?;
        Ok(interface)
    }
}
