//! A case that was read, from a file or from values.

use std::{path::PathBuf, sync::Arc};

use percuss::{Scenario, case};
use pyo3::{
    prelude::*,
    types::{PyDict, PyType},
};

use crate::{errors::raise, si, tables};

/// A case with its materials looked up.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct Case {
    pub scenario: Arc<Scenario>,
    text: String,
    path: Option<PathBuf>,
}

#[pymethods]
impl Case {
    /// Reads a case file.
    #[classmethod]
    fn load(class: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        let py = class.py();
        let scenario = case::load(&path).map_err(|error| raise(py, error))?;
        Ok(Self {
            scenario: Arc::new(scenario),
            text: std::fs::read_to_string(&path)?,
            path: Some(path),
        })
    }

    /// Reads a case from a text.
    #[classmethod]
    fn from_text(class: &Bound<'_, PyType>, name: &str, text: String) -> PyResult<Self> {
        let scenario = case::load_str(name, &text).map_err(|error| raise(class.py(), error))?;
        Ok(Self {
            scenario: Arc::new(scenario),
            text,
            path: None,
        })
    }

    /// Reads a case from tables as a file has them; a plain number where a quantity is due is in SI units.
    #[classmethod]
    fn from_tables(
        class: &Bound<'_, PyType>,
        name: &str,
        tables: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let mut table = tables::to_toml(tables)?;
        si::add_units(&mut table);
        Self::from_text(class, name, table.to_string())
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.scenario.name
    }

    /// One line that says what it is.
    #[getter]
    fn title(&self) -> &str {
        &self.scenario.title
    }

    /// Its impact speed [m/s].
    #[getter]
    fn impact_velocity_m_s(&self) -> f64 {
        self.scenario.impact_speed
    }

    /// What the file says.
    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// The file; `None` for a case that comes from none.
    #[getter]
    fn path(&self) -> Option<PathBuf> {
        self.path.clone()
    }

    /// The same case at another impact speed [m/s].
    fn at_speed(&self, speed: f64) -> Self {
        Self {
            scenario: Arc::new(self.scenario.at_speed(speed)),
            text: self.text.clone(),
            path: self.path.clone(),
        }
    }
}
