//! `percuss`, the command line of the library of the same name.

mod cli;
mod commands;
mod diagnostic;
mod failure;
mod fragment_table;
mod judgement_table;
mod material_card;
mod progress;
mod result_table;
mod run_folder;
mod shot_data;
mod speeds;
mod table;
mod terminal;
mod validation_table;
mod workers;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match cli::Cli::parse().command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.report();
            failure.exit_code()
        }
    }
}
