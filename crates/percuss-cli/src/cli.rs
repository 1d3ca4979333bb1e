//! The commands and what they have in common.

use std::{ffi::OsString, sync::atomic::AtomicBool};

use clap::{
    CommandFactory, Parser, Subcommand,
    builder::StyledStr,
    error::{ContextKind, ContextValue},
};

use crate::{
    answer::{Answer, AtHand, Hear},
    commands::{
        Benchmark, Calibrate, Compare, Completions, Converge, Limit, Man, Materials, Models, New,
        Reproduce, Run, Schema, Serve, Sweep, Uncertainty, Validate,
    },
    failure::Failure,
};

const ABOUT: &str = "First-order impact and penetration mechanics";

const LONG_ABOUT: &str = "\
First-order impact and penetration mechanics: what strikes what, how fast, how
deep it goes, and how far to trust that.

A case is a TOML file in which every dimensional number carries its unit. A run
gives the depth of penetration and the rest of the shot, balances the books of
energy and momentum, and says what its numbers rest on.";

const AFTER_HELP: &str = "\
Examples:
  percuss new my-shot                      write my-shot/scenario.toml
  percuss run my-shot/scenario.toml        run it
  percuss compare my-shot/scenario.toml    see what every model says of it
  percuss limit my-shot/scenario.toml      find the speed that perforates it
  percuss sweep my-sweep.toml --out rows   vary a case and keep a row a shot
  percuss converge my-shot/scenario.toml   see whether its mesh is fine enough
  percuss serve                            answer in a browser while you drag
  percuss materials show copper            show what is known of a material
  percuss run --help                       explain one command

Exit codes: 0 ok, 2 bad input, 3 numerical failure, 4 a file could not be read
or written";

/// Without the lines on commands that this build leaves out.
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

/// What the command line holds.
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
        Self::try_parse_from(words).map_err(|mut error| {
            let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else {
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
    Schema(Schema),
    Reproduce(Reproduce),
    Completions(Completions),
    Man(Man),
}

impl Command {
    pub fn run(&self) -> Result<(), Failure> {
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
            Self::Schema(command) => command.run(),
            Self::Reproduce(command) => command.run(),
            Self::Completions(command) => command.run(Cli::command()),
            Self::Man(command) => command.run(Cli::command()),
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
    let cli = Cli::parse_line(words).map_err(Failure::CommandLine)?;
    match cli.command {
        Command::Run(command) => command.answer(at_hand, stop, hear),
        Command::Compare(command) => command.answer(at_hand, hear),
        Command::Limit(command) => command.answer(at_hand, hear),
        Command::Sweep(command) => command.answer(),
        Command::Calibrate(command) => command.answer(at_hand, hear),
        Command::Uncertainty(command) => command.answer(at_hand, stop, hear),
        Command::Converge(command) => command.answer(at_hand, hear),
        Command::Validate(command) => command.answer(hear),
        Command::Benchmark(command) => command.answer(stop, hear),
        Command::New(command) => command.answer(),
        Command::Models(command) => command.answer(),
        Command::Materials(command) => command.answer(at_hand),
        Command::Schema(command) => command.answer(),
        Command::Reproduce(command) => command.answer(hear),
        Command::Serve(_) | Command::Completions(_) | Command::Man(_) => Err(Failure::no_answer()),
    }
}
