//! Command line: the list of commands and their common help.

use std::{ffi::OsString, sync::atomic::AtomicBool};

use clap::{
    CommandFactory, Parser, Subcommand,
    builder::StyledStr,
    error::{ContextKind, ContextValue, ErrorKind},
};

use percuss::units::Length;
use percuss_report::with_figure_width;

use crate::{
    commands::{
        Benchmark, Calibrate, Compare, Completions, Converge, Export, Limit, Man, Materials,
        Models, New, Reproduce, Run, Schema, Serve, Sweep, Uncertainty, Validate,
    },
    failure::Failure,
    memory::limit_memory,
    response::{ProgressCallback, Response, VirtualFiles},
};

const ABOUT: &str = "First-order impact and penetration mechanics";

const LONG_ABOUT: &str = "\
First-order impact and penetration mechanics: estimates of the depth of
penetration, residual velocity and ballistic limit, with an estimated model
error.

A case is a TOML file in which every dimensional number carries its unit. A run
reports the depth of penetration and all other results, its energy and momentum
balance, and the assumptions behind the numbers.";

const AFTER_HELP: &str = "\
Examples:
  percuss new my-case                      write my-case/scenario.toml
  percuss run my-case/scenario.toml        run it, with the axisymmetric depth
  percuss run CASE.toml --model axi        run by the axisymmetric model alone
  percuss run CASE.toml --json             print one JSON object for scripts
  percuss compare my-case/scenario.toml    compare the results of all models
  percuss limit CASE.toml                  find the ballistic limit of a plate
  percuss sweep my-sweep.toml --out rows   vary a case; one row per run
  percuss converge my-case/scenario.toml   check its mesh convergence
  percuss serve                            interactive page in a browser
  percuss materials show copper            show the record of a material
  percuss run --help                       explain one command

Exit codes: 0 ok, 2 bad input, 3 numerical failure, 4 a file could not be read
or written, 130 stopped by the user";

/// Examples, without the commands that this build leaves out.
fn after_help() -> String {
    let left_out = [
        ("  percuss serve ", cfg!(feature = "serve")),
        ("  percuss sweep ", cfg!(feature = "parquet")),
    ];
    let is_there = |line: &&str| {
        let mut left_out = left_out.iter();
        left_out.all(|(start, is_there)| *is_there || !line.starts_with(start))
    };
    let lines: Vec<&str> = AFTER_HELP.lines().filter(is_there).collect();
    lines.join("\n")
}

/// Parsed command line.
#[derive(Debug, Parser)]
#[command(
    name = "percuss",
    bin_name = "percuss",
    version,
    about = ABOUT,
    long_about = LONG_ABOUT,
    after_help = after_help(),
    max_term_width = 80,
    arg_required_else_help = true,
    disable_help_subcommand = true
)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

/// Former names of commands, with the names of today.
const RENAMED: [(&str, &str); 1] = [("judge", "benchmark")];

impl Cli {
    /// Reads a command line, whose first word is the name of the program. The error for a former name has the name of today.
    ///
    /// # Errors
    /// Those of the parser.
    pub fn parse_line(words: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        let words: Vec<OsString> = words.into_iter().collect();
        let command = words.get(1).and_then(|word| word.to_str());
        let command = command.unwrap_or_default().to_owned();
        Self::try_parse_from(words).map_err(|mut error| {
            let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else {
                advise(&mut error, &command);
                return error;
            };
            if let Some((former, name)) = RENAMED.into_iter().find(|(former, _)| former == word) {
                let tip = StyledStr::from(format!("the command `{former}` is now `{name}`"));
                error.remove(ContextKind::SuggestedSubcommand);
                error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
            }
            error
        })
    }
}

/// Puts what a user may have meant in place of the parser's tip on an argument that a command does not take.
fn advise(error: &mut clap::Error, command: &str) {
    let argument = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(argument)) => argument.clone(),
        Some(ContextValue::Strings(missing)) => missing.join(" "),
        _ => return,
    };
    let is_unknown = error.kind() == ErrorKind::UnknownArgument;
    let is_csv = argument.to_lowercase().ends_with(".csv");
    let tip = match (command, argument.as_str()) {
        ("run", "--velocity") if is_unknown => {
            "the case has the impact velocity; 'percuss compare CASE.toml --velocity 200..1500:14' computes several"
        }
        ("validate", _) if is_unknown && is_csv => "'--data FILE.csv' takes a file of tests",
        ("limit", missing) if !is_unknown && missing.contains("CASE.toml") => {
            "'--tests FILE.csv' needs no case"
        }
        // No argument of this program is a value that starts with dashes.
        _ if is_unknown && is_escape(error) => {
            error.remove(ContextKind::Suggested);
            return;
        }
        _ => return,
    };
    let tip = ContextValue::StyledStrs(vec![StyledStr::from(tip)]);
    error.insert(ContextKind::Suggested, tip);
}

/// Whether the parser's tip is to write dashes before the argument.
fn is_escape(error: &clap::Error) -> bool {
    let Some(ContextValue::StyledStrs(tips)) = error.get(ContextKind::Suggested) else {
        return false;
    };
    tips.iter()
        .any(|tip| tip.to_string().contains("as a value"))
}

/// All commands. Adding one is one file in `commands/` and one line in each of the lists here.
#[derive(Debug, Subcommand)]
pub enum Command {
    Run(Run),
    Compare(Compare),
    Limit(Limit),
    Sweep(Sweep),
    Calibrate(Calibrate),
    Uncertainty(Uncertainty),
    Converge(Converge),
    Validate(Validate),
    Benchmark(Benchmark),
    Serve(Serve),
    New(New),
    Models(Models),
    Materials(Materials),
    Export(Export),
    Schema(Schema),
    Reproduce(Reproduce),
    Completions(Completions),
    Man(Man),
}

impl Command {
    /// Width of the figures that the command draws, where it has an option for it.
    fn figure_width(&self) -> Option<Length> {
        match self {
            Self::Run(command) => command.figures.figure_width,
            Self::Compare(command) => command.figures.figure_width,
            Self::Limit(command) => command.figures.figure_width,
            #[cfg(feature = "parquet")]
            Self::Sweep(command) => command.figure_width(),
            Self::Calibrate(command) => command.figures.figure_width,
            Self::Uncertainty(command) => command.figures.figure_width,
            Self::Converge(command) => command.figures.figure_width,
            Self::Validate(command) => command.figures.figure_width,
            Self::Materials(command) => command.figure_width(),
            #[cfg(not(feature = "parquet"))]
            Self::Sweep(_) => None,
            Self::Benchmark(_)
            | Self::Serve(_)
            | Self::New(_)
            | Self::Models(_)
            | Self::Export(_)
            | Self::Schema(_)
            | Self::Reproduce(_)
            | Self::Completions(_)
            | Self::Man(_) => None,
        }
    }

    /// Runs with figures of the width that is asked for.
    fn in_width<T>(&self, run: impl FnOnce(&Self) -> T) -> T {
        match self.figure_width() {
            Some(width) => with_figure_width(width, || run(self)),
            None => run(self),
        }
    }

    pub fn run(&self) -> Result<(), Failure> {
        self.in_width(Self::run_in_width)
    }

    fn run_in_width(&self) -> Result<(), Failure> {
        match self {
            Self::Run(command) => command.run(),
            Self::Compare(command) => command.run(),
            Self::Limit(command) => command.run(),
            Self::Sweep(command) => command.run(),
            Self::Calibrate(command) => command.run(),
            Self::Uncertainty(command) => command.run(),
            Self::Converge(command) => command.run(),
            Self::Validate(command) => command.run(),
            Self::Benchmark(command) => command.run(),
            Self::Serve(command) => command.run(),
            Self::New(command) => command.run(),
            Self::Models(command) => command.run(),
            Self::Materials(command) => command.run(),
            Self::Export(command) => command.run(),
            Self::Schema(command) => command.run(),
            Self::Reproduce(command) => command.run(),
            Self::Completions(command) => command.run(Cli::command()),
            Self::Man(command) => command.run(Cli::command()),
        }
    }
}

/// Executes a command line with `--json`; with `--out` it writes the files of the command. It ends when `stop` becomes true, or when
/// `on_progress` returns [`ControlFlow::Break`](std::ops::ControlFlow::Break).
///
/// # Errors
/// Those of the command, and [`Failure::CommandLine`].
pub fn execute(
    words: impl IntoIterator<Item = OsString>,
    virtual_files: &VirtualFiles,
    stop: &AtomicBool,
    on_progress: ProgressCallback<'_>,
) -> Result<Response, Failure> {
    limit_memory()?;
    let cli = Cli::parse_line(words).map_err(Failure::CommandLine)?;
    cli.command.in_width(|command| match command {
        Command::Run(command) => command.execute(virtual_files, stop, on_progress),
        Command::Compare(command) => command.execute(virtual_files, on_progress),
        Command::Limit(command) => command.execute(virtual_files, on_progress),
        Command::Sweep(command) => command.execute(),
        Command::Calibrate(command) => command.execute(virtual_files, on_progress),
        Command::Uncertainty(command) => command.execute(virtual_files, stop, on_progress),
        Command::Converge(command) => command.execute(virtual_files, on_progress),
        Command::Validate(command) => command.execute(on_progress),
        Command::Benchmark(command) => command.execute(stop, on_progress),
        Command::New(command) => command.execute(),
        Command::Models(command) => command.execute(),
        Command::Materials(command) => command.execute(virtual_files),
        Command::Export(command) => command.execute(virtual_files),
        Command::Schema(command) => command.execute(),
        Command::Reproduce(command) => command.execute(on_progress),
        Command::Serve(_) | Command::Completions(_) | Command::Man(_) => {
            Err(Failure::no_response())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Longer lines of a text that is wrapped by hand would be broken into ragged ones.
    #[test]
    fn lines_of_help_texts_fit_a_terminal_of_80_columns() {
        let mut commands = vec![Cli::command()];
        while let Some(command) = commands.pop() {
            let texts = [command.get_long_about(), command.get_after_help()];
            for text in texts.into_iter().flatten() {
                for line in text.to_string().lines() {
                    let name = command.get_name();
                    assert!(line.chars().count() <= 80, "{name}: {line}");
                }
            }
            commands.extend(command.get_subcommands().cloned());
        }
    }
}
