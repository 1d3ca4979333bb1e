//! The program `percuss` as a library, for its binary and for callers that need the result of a command as data.

mod by_models;
mod cli;
mod commands;
mod cost;
mod diagnostic;
mod failure;
mod figure_formats;
mod file_list;
mod fragment_table;
mod material_card;
mod memory;
mod output;
mod progress;
mod response;
mod result_table;
mod run_folder;
mod run_output;
mod speeds;
mod table;
mod terminal;
mod test_data;
mod unit_system;
mod validation_table;
mod whole_numbers;
mod workers;

use std::{
    ffi::OsString,
    io::{self, Write},
    process::ExitCode,
};

use clap::CommandFactory;
use percuss::quote::shorten_words;

pub use cli::execute;
pub use failure::Failure;
pub use memory::limit_memory;
pub use response::{ProgressCallback, Response, ResponseData, VirtualFiles};
pub use run_output::RunOutput;
pub use workers::{MOST_THREADS, pool as thread_pool, start as start_threads};

/// Definition of the command line, for reference pages.
pub fn command() -> clap::Command {
    cli::Cli::command()
}

/// Runs a command line, whose first word is the name of the program; returns the exit code.
pub fn main(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match cli::Cli::parse_line(words) {
        Ok(cli) => cli,
        Err(error) => {
            return answer_of_parser(&error);
        }
    };
    let ready = limit_memory().and_then(|()| start_threads());
    match ready.and_then(|()| cli.command.run()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.report();
            failure.exit_code()
        }
    }
}

/// Prints the help or the error of the parser; returns the exit code.
fn answer_of_parser(error: &clap::Error) -> ExitCode {
    let whole = error.render().to_string();
    let short = shorten_words(&whole);
    let print = || match short == whole {
        true => error.print(),
        false => {
            diagnostic::print(&short);
            Ok(())
        }
    };
    let printed = print().and_then(|()| io::stdout().flush());
    match printed {
        Err(failure) if !error.use_stderr() && failure.kind() != io::ErrorKind::BrokenPipe => {
            let failure = Failure::Output(failure);
            failure.report();
            failure.exit_code()
        }
        _ => ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2)),
    }
}
