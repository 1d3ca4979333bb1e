//! Results of commands as data, for callers without a terminal.

use std::{
    collections::HashMap,
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use percuss::{
    Error,
    calibrate::Calibrated,
    case::{Document, ScenarioChange},
    uncertainty::Uncertainty,
};
use serde::Serialize;

use crate::{failure::Failure, output, run_output::RunOutput};

/// Callback with the progress of a command, 0 to 1, and a short text; [`ControlFlow::Break`] ends the command.
pub type ProgressCallback<'a> = &'a mut (dyn FnMut(f64, &str) -> ControlFlow<()> + Send);

/// What a caller brings along: texts that replace files, by their names on the command line, and laws that no file can hold.
#[derive(Debug, Clone, Default)]
pub struct VirtualFiles {
    texts: HashMap<PathBuf, Document>,
    /// A change of every case of `percuss uncertainty`, the one command that takes it.
    pub change: Option<ScenarioChange>,
}

impl VirtualFiles {
    /// Replaces a file by a text.
    pub fn put(&mut self, name: impl Into<PathBuf>, document: Document) {
        self.texts.insert(name.into(), document);
    }

    /// Reads the text of this name, otherwise the file.
    pub(crate) fn read(&self, path: &Path) -> Result<Document, Error> {
        match self.texts.get(path) {
            Some(document) => Ok(document.clone()),
            None => Document::read(path),
        }
    }
}

/// Result of a command and the files that it wrote.
#[derive(Debug)]
pub struct Response {
    /// Result.
    pub data: ResponseData,
    /// Files, in the order of writing.
    pub files: Vec<PathBuf>,
}

/// Result of a command.
#[derive(Debug)]
pub enum ResponseData {
    /// Result that is JSON only.
    Json(String),
    /// Run with its histories.
    Run(Box<RunOutput>),
    /// Uncertainty analysis with its sample.
    Uncertainty(Box<Uncertainty>),
    /// Calibration with the sample of its posterior.
    Calibration(Box<Calibrated>),
}

impl Response {
    /// Response that is JSON only.
    pub(crate) fn json_of(value: &impl Serialize, files: Vec<PathBuf>) -> Result<Self, Failure> {
        Ok(Self {
            data: ResponseData::Json(output::json(value)?),
            files,
        })
    }

    /// Output of `--json`.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn json(&self) -> Result<String, Failure> {
        match &self.data {
            ResponseData::Json(text) => Ok(text.clone()),
            ResponseData::Run(run_output) => output::json(&run_output.results()),
            ResponseData::Uncertainty(found) => output::json(found),
            ResponseData::Calibration(found) => output::json(found),
        }
    }
}
