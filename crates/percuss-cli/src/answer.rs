//! The answers of commands as data, for callers that have no use for a terminal.

use std::{ffi::OsString, ops::ControlFlow};

use clap::Parser;
use percuss::Scenario;

use crate::{
    cli::{Cli, Command},
    failure::Failure,
};

/// Hears how far a command has come: part done, 0 to 1, and a few words; [`ControlFlow::Break`] ends it.
pub type Hear<'a> = &'a mut (dyn FnMut(f64, &str) -> ControlFlow<()> + Send);

/// What a command line prints with `--json`. A case that is at hand takes the place of the file that the command line names.
///
/// # Errors
/// Those of the command, and [`Failure::CommandLine`].
pub fn answer(
    words: impl IntoIterator<Item = OsString>,
    case: Option<&Scenario>,
    hear: Hear<'_>,
) -> Result<String, Failure> {
    let cli = Cli::try_parse_from(words).map_err(Failure::CommandLine)?;
    match cli.command {
        Command::Compare(command) => command.answer(case, hear),
        Command::Limit(command) => command.answer(case, hear),
        Command::Converge(command) => command.answer(case, hear),
        Command::Validate(command) => command.answer(hear),
        Command::Materials(command) => command.answer(),
        Command::Models(command) => command.answer(),
        _ => Err(Failure::Usage {
            message: "this command has no answer as data".to_owned(),
            help: "run it as a command".to_owned(),
        }),
    }
}
