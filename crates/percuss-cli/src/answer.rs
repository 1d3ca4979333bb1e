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

use crate::{
    cli::{Cli, Command},
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

/// What a command found out.
#[derive(Debug)]
pub enum Answer {
    /// All of it is in the JSON.
    Json(String),
    /// What uncertain numbers do, with the sample that it rests on.
    Uncertainty(Box<Uncertainty>),
    /// A calibration, with the sample of its posterior.
    Calibration(Box<Calibrated>),
}

impl Answer {
    /// What the command prints with `--json`.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn json(&self) -> Result<String, Failure> {
        match self {
            Self::Json(text) => Ok(text.clone()),
            Self::Uncertainty(found) => terminal::json(found),
            Self::Calibration(found) => terminal::json(found),
        }
    }
}

/// What a command line with `--json` finds out. It ends when `stop` becomes true, or when `hear` says so.
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
    let json = match cli.command {
        Command::Compare(command) => command.answer(at_hand, hear),
        Command::Limit(command) => command.answer(at_hand, hear),
        Command::Converge(command) => command.answer(at_hand, hear),
        Command::Validate(command) => command.answer(hear),
        Command::Materials(command) => command.answer(),
        Command::Models(command) => command.answer(),
        Command::Uncertainty(command) => {
            let found = command.answer(at_hand, stop, hear)?;
            return Ok(Answer::Uncertainty(Box::new(found)));
        }
        Command::Calibrate(command) => {
            let found = command.answer(at_hand, hear)?;
            return Ok(Answer::Calibration(Box::new(found)));
        }
        _ => Err(Failure::Usage {
            message: "this command has no answer as data".to_owned(),
            help: "run it as a command".to_owned(),
        }),
    };
    json.map(Answer::Json)
}
