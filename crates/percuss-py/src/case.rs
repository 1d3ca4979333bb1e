//! Case from a file or from values.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use percuss::{Error, Scenario, case::Document, model};
use pyo3::{
    prelude::*,
    types::{PyDict, PyType},
};

use crate::{errors::raise, tables};

/// A case with its materials looked up.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct Case {
    pub scenario: Arc<Scenario>,
    pub document: Document,
    path: Option<PathBuf>,
}

#[pymethods]
impl Case {
    /// Reads a case file.
    #[classmethod]
    fn load(class: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        let document = Document::read(&path).map_err(|error| raise(class.py(), error))?;
        Self::new(class, document, Some(path))
    }

    /// Reads a case from a text, in which paths are relative to a folder.
    #[classmethod]
    fn from_text(
        class: &Bound<'_, PyType>,
        name: &str,
        text: String,
        folder: PathBuf,
    ) -> PyResult<Self> {
        let document = Document::new(name, text).in_folder(folder);
        Self::new(class, document, None)
    }

    /// Reads a case from tables as a file has them; a plain number where a quantity is due is refused.
    #[classmethod]
    fn from_tables(
        class: &Bound<'_, PyType>,
        name: &str,
        tables: &Bound<'_, PyDict>,
        folder: PathBuf,
    ) -> PyResult<Self> {
        let table = tables::to_toml(tables)?;
        Self::from_text(class, name, table.to_string(), folder)
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

    /// Impact velocity [m/s].
    #[getter]
    fn impact_velocity_m_s(&self) -> f64 {
        self.scenario.impact_velocity
    }

    /// What the file says.
    #[getter]
    fn text(&self) -> &str {
        self.document.text()
    }

    /// What a file says that has the same case in every folder: records and curves of other files stand in it.
    fn self_contained(&self, py: Python<'_>) -> PyResult<String> {
        percuss::case::self_contained(&self.document).map_err(|error| raise(py, error))
    }

    /// The folder that paths in it are relative to.
    #[getter]
    fn folder(&self) -> PathBuf {
        self.document.folder().unwrap_or(Path::new("")).to_owned()
    }

    /// Estimated cost of a run: memory [bytes], time steps and processor time [s].
    fn estimate(&self, py: Python<'_>, model: Option<&str>) -> PyResult<(f64, f64, f64)> {
        let failed = |error| raise(py, error);
        let model = model::choose(model, &self.scenario).map_err(failed)?.model;
        model::applicability(model, &self.scenario)
            .map_err(|refusal| failed(Error::not_applicable(model.name(), refusal)))?;
        let cost = model.estimate(&self.scenario);
        Ok((cost.memory, cost.steps, cost.seconds))
    }

    /// The file; `None` for a case that comes from none.
    #[getter]
    fn path(&self) -> Option<PathBuf> {
        self.path.clone()
    }
}

impl Case {
    fn new(class: &Bound<'_, PyType>, document: Document, path: Option<PathBuf>) -> PyResult<Self> {
        let scenario = percuss::case::scenario(&document);
        Ok(Self {
            scenario: Arc::new(scenario.map_err(|error| raise(class.py(), error))?),
            document,
            path,
        })
    }
}
