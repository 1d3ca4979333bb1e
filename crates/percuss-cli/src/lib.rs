//! The program `percuss` as a library, for its binary and for callers that need the result of a command as data.

mod by_models;
mod cli;
mod commands;
mod diagnostic;
mod failure;
mod file_list;
mod fragment_table;
mod material_card;
mod output;
mod progress;
mod response;
mod result_table;
mod run_folder;
mod run_output;
mod shot_data;
mod speeds;
mod table;
mod terminal;
mod validation_table;
mod workers;

use std::{ffi::OsString, process::ExitCode};

use clap::CommandFactory;

pub use cli::execute;
pub use failure::Failure;
pub use response::{ProgressCallback, Response, ResponseData, VirtualFiles};
pub use run_output::RunOutput;

/// Definition of the command line, for reference pages.
pub fn command() -> clap::Command {
    cli::Cli::command()
}

/// Runs a command line, whose first word is the name of the program; returns the exit code.
pub fn main(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match cli::Cli::parse_line(words) {
        Ok(cli) => cli,
        Err(error) => {
            // A failure to print cannot be reported.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    match cli.command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.report();
            failure.exit_code()
        }
    }
}
