//! The answers of commands as data, for callers that have no use for a terminal.

use std::{
    collections::HashMap,
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use percuss::{Error, calibrate::Calibrated, case::Document, uncertainty::Uncertainty};
use serde::Serialize;

use crate::{failure::Failure, output, ran::Ran};

/// Hears how far a command has come: part done, 0 to 1, and a few words; [`ControlFlow::Break`] ends it.
pub type Hear<'a> = &'a mut (dyn FnMut(f64, &str) -> ControlFlow<()> + Send);

/// Texts that stand in the place of files, by the names that a command line gives them.
#[derive(Debug, Clone, Default)]
pub struct AtHand(HashMap<PathBuf, Document>);

impl AtHand {
    /// Lets a text stand in the place of a file.
    pub fn put(&mut self, name: impl Into<PathBuf>, document: Document) {
        self.0.insert(name.into(), document);
    }

    /// What is at hand under a name, otherwise the file.
    pub(crate) fn read(&self, path: &Path) -> Result<Document, Error> {
        match self.0.get(path) {
            Some(document) => Ok(document.clone()),
            None => Document::read(path),
        }
    }
}

/// What a command found out, and the files that it wrote.
#[derive(Debug)]
pub struct Answer {
    /// What it found out.
    pub found: Found,
    /// What it wrote, in the order of writing.
    pub files: Vec<PathBuf>,
}

/// What a command found out.
#[derive(Debug)]
pub enum Found {
    /// All of it is in the JSON.
    Json(String),
    /// A run, with its histories.
    Run(Box<Ran>),
    /// What uncertain numbers do, with the sample that it rests on.
    Uncertainty(Box<Uncertainty>),
    /// A calibration, with the sample of its posterior.
    Calibration(Box<Calibrated>),
}

impl Answer {
    /// An answer that is JSON.
    pub(crate) fn json_of(value: &impl Serialize, files: Vec<PathBuf>) -> Result<Self, Failure> {
        Ok(Self {
            found: Found::Json(output::json(value)?),
            files,
        })
    }

    /// What the command prints with `--json`.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn json(&self) -> Result<String, Failure> {
        match &self.found {
            Found::Json(text) => Ok(text.clone()),
            Found::Run(ran) => output::json(&ran.results()),
            Found::Uncertainty(found) => output::json(found),
            Found::Calibration(found) => output::json(found),
        }
    }
}
