//! The answers of commands as data, for callers that have no use for a terminal.

use std::{
    collections::HashMap,
    ffi::OsString,
    ops::ControlFlow,
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
};

use clap::Parser;
use percuss::{Error, calibrate::Calibrated, case::Document, uncertainty::Uncertainty};
use serde::Serialize;

use crate::{
    cli::{Cli, Command},
    commands::Ran,
    failure::Failure,
    terminal,
};

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
            found: Found::Json(terminal::json(value)?),
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
            Found::Run(ran) => terminal::json(&ran.results()),
            Found::Uncertainty(found) => terminal::json(found),
            Found::Calibration(found) => terminal::json(found),
        }
    }
}

/// What a command line with `--json` finds out; with `--out` it writes what the command writes. It ends when `stop` becomes true, or
/// when `hear` says so.
///
/// # Errors
/// Those of the command, and [`Failure::CommandLine`].
pub fn answer(
    words: impl IntoIterator<Item = OsString>,
    at_hand: &AtHand,
    stop: &AtomicBool,
    hear: Hear<'_>,
) -> Result<Answer, Failure> {
    let cli = Cli::try_parse_from(words).map_err(Failure::CommandLine)?;
    match cli.command {
        Command::Run(command) => command.answer(at_hand, stop, hear),
        Command::Compare(command) => command.answer(at_hand, hear),
        Command::Limit(command) => command.answer(at_hand, hear),
        Command::Sweep(command) => command.answer(),
        Command::Calibrate(command) => command.answer(at_hand, hear),
        Command::Uncertainty(command) => command.answer(at_hand, stop, hear),
        Command::Converge(command) => command.answer(at_hand, hear),
        Command::Validate(command) => command.answer(hear),
        Command::Judge(command) => command.answer(stop, hear),
        Command::New(command) => command.answer(),
        Command::Models(command) => command.answer(),
        Command::Materials(command) => command.answer(at_hand),
        Command::Schema(command) => command.answer(),
        Command::Reproduce(command) => command.answer(hear),
        Command::Serve(_) | Command::Completions(_) | Command::Man(_) => Err(Failure::no_answer()),
    }
}
