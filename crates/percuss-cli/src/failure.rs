//! Failures of commands, with message and exit code.

use std::{
    io,
    path::{Path, PathBuf},
    process::ExitCode,
};

use percuss::{
    Error, Subject,
    quote::{shorten_words, shown},
};
use percuss_report::ReportError;

use crate::{
    by_models::by_models,
    diagnostic::{self, Look},
    terminal,
};

/// Any failure of a command.
#[derive(Debug)]
pub enum Failure {
    /// The library refused or failed.
    Library(Error),
    /// Figures or histories could not be made or written.
    Report(ReportError),
    /// A file or folder could not be written.
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Reason.
        reason: String,
        /// Remedy; may be empty.
        help: String,
    },
    /// No model gave a result: the reasons, one per model.
    NoResult(Vec<String>),
    /// Standard output could not be written.
    Output(io::Error),
    /// The user stopped a run, which left a checkpoint [us].
    Stopped {
        /// Time reached [us].
        time_us: f64,
    },
    /// The user stopped a sweep.
    SweepStopped {
        /// Completed runs.
        done: u64,
        /// All runs.
        runs: u64,
    },
    /// The user stopped a computation without output: its name.
    Interrupted(&'static str),
    /// The user stopped the axisymmetric runs; the result of the model is there.
    AxisymmetricStopped,
    /// The user stopped a study after its first run; the results of those that are complete are there.
    StudyStopped {
        /// How many are complete.
        complete: usize,
        /// How many were wanted.
        wanted: u32,
        /// What they differ in.
        runs: &'static str,
    },
    /// The user stopped the axisymmetric answers of a sweep; its rows and the answers that are complete are there.
    AnswersStopped {
        /// How many are complete.
        complete: usize,
        /// How many were wanted.
        wanted: usize,
    },
    /// The command line asks for something that does not exist.
    Usage {
        /// Message.
        message: String,
        /// Remedy; may be empty.
        help: String,
    },
    /// The command line asks for a material that does not exist.
    Material {
        /// Message.
        message: String,
        /// Remedy; may be empty.
        help: String,
    },
    /// The command line cannot be read.
    CommandLine(clap::Error),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Library(error)
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Write { path, source } => Self::write(&path)(source),
            ReportError::Sweep { ref remedy, .. } => {
                let help = remedy.clone();
                let message = error.to_string();
                Self::Usage { message, help }
            }
            ReportError::Read { path, reason } => Self::Library(Error::Read {
                path,
                reason,
                remedy: String::new(),
                source: None,
            }),
            other => Self::Report(other),
        }
    }
}

impl Failure {
    /// A failure to write a file or folder.
    pub fn write(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |error| Self::Write {
            path,
            reason: error.to_string(),
            help: String::new(),
        }
    }

    /// Failure of a command that has no result as data.
    pub(crate) fn no_response() -> Self {
        Self::Usage {
            message: "this command has no result as data".to_owned(),
            help: "run it in a terminal".to_owned(),
        }
    }

    /// The exit code of the program.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Usage { .. }
            | Self::Material { .. }
            | Self::CommandLine(_)
            | Self::NoResult(_) => 2,
            // Exit code of shells for a program that Ctrl-C ended.
            Self::Stopped { .. }
            | Self::SweepStopped { .. }
            | Self::Interrupted(_)
            | Self::AxisymmetricStopped
            | Self::AnswersStopped { .. }
            | Self::StudyStopped { .. } => 130,
            Self::Library(Error::Numerical(_) | Error::Cancelled { .. }) | Self::Report(_) => 3,
            Self::Library(Error::Read { .. }) | Self::Write { .. } | Self::Output(_) => 4,
            Self::Library(Error::Input(error)) => match error.subject {
                Subject::MaterialFile | Subject::CaseFile => 4,
                Subject::Material | Subject::Case => 2,
            },
            Self::Library(_) => 2,
        })
    }

    /// Prints the message to standard error.
    pub fn report(&self) {
        diagnostic::print(&self.text(Look::of_stderr()));
    }

    /// Message without colours.
    pub fn plain_text(&self) -> String {
        self.text(Look::PLAIN)
    }

    fn text(&self, look: Look) -> String {
        let message = |what: &str, help: &str| diagnostic::message(look, what, help);
        match self {
            Self::Library(error @ Error::NoModelApplies { reasons, .. }) => {
                let (what, _) = error.message_and_help();
                let reasons = reasons.iter();
                let reasons = by_models(reasons.map(|(name, reason)| (*name, reason.clone())));
                message(&what, "") + &lines(&reasons)
            }
            Self::Library(Error::Input(error)) => diagnostic::input_error(look, error),
            Self::Library(error @ Error::Read { path, source, .. }) => {
                let missing = source
                    .as_ref()
                    .is_some_and(|error| error.kind() == io::ErrorKind::NotFound);
                let (what, remedy) = error.message_and_help();
                let ending = path.extension().and_then(|ending| ending.to_str());
                let help = match remedy.as_str() {
                    "" if missing && ending == Some("csv") => {
                        "give the path of a CSV file that exists"
                    }
                    "" if missing && ending.is_some_and(|ending| ending != "toml") => {
                        "give the path of a file that exists"
                    }
                    "" if missing => {
                        "give the path of a file that exists; `percuss new NAME` writes a starter case"
                    }
                    remedy => remedy,
                };
                message(&what, help)
            }
            Self::Library(error) => {
                let (what, help) = error.message_and_help();
                message(&what, &help)
            }
            Self::Report(error) => message(&error.to_string(), ""),
            Self::Write { path, reason, help } => {
                let what = format!("cannot write `{}`: {reason}", shown(path));
                message(&what, help)
            }
            Self::Output(error) => message(&format!("cannot write the output: {error}"), ""),
            Self::NoResult(reasons) => {
                message("no model gives a result for this case", "") + &lines(reasons)
            }
            Self::Stopped { time_us: 0.0 } => message(
                "the run was stopped before its first step: it left no checkpoint",
                "",
            ),
            Self::Stopped { time_us } => {
                let what = format!("the run was stopped at {time_us:.1} us and left a checkpoint");
                message(
                    &what,
                    "the same command with `--resume` continues from there",
                )
            }
            Self::SweepStopped { done, runs } => message(
                &format!("the sweep was stopped with {done} of {runs} runs done"),
                "the same command with `--resume` continues from there",
            ),
            Self::Interrupted(what) => {
                message(&format!("{what} was stopped and left no result"), "")
            }
            Self::AxisymmetricStopped => message(
                "the axisymmetric runs were stopped; the result of the model stands",
                "`--fast` leaves them out",
            ),
            Self::StudyStopped {
                complete,
                wanted,
                runs,
            } => message(
                &format!(
                    "the study was stopped after {complete} of {wanted} {runs}; their results stand"
                ),
                "",
            ),
            Self::AnswersStopped { complete, wanted } => message(
                &format!(
                    "the sweep is complete; its axisymmetric answers were stopped with {complete} of {wanted} done"
                ),
                "the same command with `--resume` continues from there",
            ),
            Self::Usage {
                message: what,
                help,
            }
            | Self::Material {
                message: what,
                help,
            } => message(what, help),
            Self::CommandLine(error) => shorten_words(&error.render().to_string()),
        }
    }
}

/// Reasons below an error, one per line.
fn lines(reasons: &[String]) -> String {
    let line = |reason: &String| {
        let reason = terminal::wrap(reason, terminal::width() - 2, 4);
        format!("  {reason}\n")
    };
    reasons.iter().map(line).collect()
}
