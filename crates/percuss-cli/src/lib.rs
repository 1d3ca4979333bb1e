//! The program `percuss`, as a library: what the binary calls, and what other programs ask for a command's answer as data.

mod answer;
mod by_models;
mod cli;
mod commands;
mod diagnostic;
mod failure;
mod fragment_table;
mod material_card;
mod output;
mod progress;
mod ran;
mod result_table;
mod run_folder;
mod shot_data;
mod speeds;
mod table;
mod terminal;
mod validation_table;
mod workers;
mod written;

use std::{ffi::OsString, process::ExitCode};

use clap::CommandFactory;

pub use answer::{Answer, AtHand, Found, Hear};
pub use cli::answer;
pub use failure::Failure;
pub use ran::Ran;

/// What the command line holds, for pages that explain it.
pub fn command() -> clap::Command {
    cli::Cli::command()
}

/// Runs a command line, whose first word is the name of the program; returns the exit code.
pub fn main(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match cli::Cli::parse_line(words) {
        Ok(cli) => cli,
        Err(error) => {
            // There is nowhere left to say that this failed.
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
