//! What can go wrong in a command, how it is said and which exit code it has.

use std::{
    io,
    path::{Path, PathBuf},
    process::ExitCode,
};

use percuss::Error;
use percuss_report::ReportError;

use crate::{diagnostic, terminal};

/// Help for a model that does not apply and names no remedy.
const WHICH_APPLY: &str = "`percuss compare CASE.toml` names the models that apply";

/// Any failure of a command.
#[derive(Debug)]
pub enum Failure {
    /// The library refused or failed.
    Library(Error),
    /// Figures or histories could not be made or written.
    Report(ReportError),
    /// A file or folder could not be written.
    Write {
        path: PathBuf,
        reason: String,
        help: String,
    },
    /// No model gave a result: the reasons, one a model.
    NoResult(Vec<String>),
    /// Standard output could not be written.
    Output(io::Error),
    /// The user stopped a run, which left a checkpoint [us].
    Stopped { time_us: f64 },
    /// The user stopped a sweep.
    SweepStopped { done: u64, shots: u64 },
    /// The user stopped something that leaves nothing behind: its name.
    Interrupted(&'static str),
    /// The command line asks for something that does not exist.
    Usage { message: String, help: String },
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

    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Usage { .. } | Self::NoResult(_) => 2,
            // What shells report of a program that Ctrl-C ended.
            Self::Stopped { .. } | Self::SweepStopped { .. } | Self::Interrupted(_) => 130,
            Self::Library(Error::Numerical(_) | Error::Cancelled { .. }) | Self::Report(_) => 3,
            Self::Library(Error::Read { .. }) | Self::Write { .. } | Self::Output(_) => 4,
            Self::Library(_) => 2,
        })
    }

    /// Says on standard error what is wrong.
    pub fn report(&self) {
        let text = match self {
            Self::Library(Error::Input(error)) => diagnostic::input_error(error),
            Self::Library(Error::NotApplicable { model, reason }) => {
                let (reason, help) = reason.split_once("; ").unwrap_or((reason, WHICH_APPLY));
                let message = format!("model `{model}` does not apply to this case: {reason}");
                diagnostic::message(&message, help)
            }
            Self::Library(Error::UnknownModel {
                name,
                suggestion,
                known,
            }) => {
                let near = suggestion
                    .as_ref()
                    .map_or_else(String::new, |near| format!("did you mean `{near}`? "));
                diagnostic::message(
                    &format!("no model is named `{name}`"),
                    &format!("{near}models: {}", known.join(", ")),
                )
            }
            Self::Library(Error::Numerical(error)) => {
                let mut error = (**error).clone();
                let remedy = std::mem::take(&mut error.remedy);
                let message = error.to_string();
                diagnostic::message(message.trim_end_matches([':', ' ']), &remedy)
            }
            Self::Library(Error::Read {
                path,
                reason,
                source,
            }) => {
                let missing = source
                    .as_ref()
                    .is_some_and(|error| error.kind() == io::ErrorKind::NotFound);
                let (reason, help) = match reason.split_once("; ") {
                    Some(parts) => parts,
                    None if missing && path.extension().is_some_and(|end| end == "csv") => {
                        (&**reason, "give the path of a CSV file that exists")
                    }
                    None if missing => (&**reason, "`percuss new NAME` writes a starter case"),
                    None => (&**reason, ""),
                };
                let message = format!("cannot read `{}`: {reason}", path.display());
                diagnostic::message(&message, help)
            }
            Self::Library(error @ Error::Checkpoint { remedy, .. }) => {
                diagnostic::message(&error.to_string(), remedy)
            }
            Self::Library(Error::Calibration { reason, remedy }) => {
                diagnostic::message(reason, remedy)
            }
            Self::Library(error) => diagnostic::message(&error.to_string(), ""),
            Self::Report(error) => diagnostic::message(&error.to_string(), ""),
            Self::Write { path, reason, help } => {
                let message = format!("cannot write `{}`: {reason}", path.display());
                diagnostic::message(&message, help)
            }
            Self::Output(error) => {
                diagnostic::message(&format!("cannot write the output: {error}"), "")
            }
            Self::NoResult(reasons) => {
                let message = diagnostic::message("no model gives a result for this case", "");
                let reason = |reason: &String| {
                    format!("  {}\n", terminal::wrap(reason, terminal::width() - 2, 4))
                };
                message + &reasons.iter().map(reason).collect::<String>()
            }
            Self::Stopped { time_us } => {
                let message =
                    format!("the run was stopped at {time_us:.1} us and left a checkpoint");
                diagnostic::message(
                    &message,
                    "the same command with `--resume` goes on from there",
                )
            }
            Self::SweepStopped { done, shots } => diagnostic::message(
                &format!("the sweep was stopped with {done} of {shots} shots done"),
                "the same command with `--resume` goes on from there",
            ),
            Self::Interrupted(what) => {
                diagnostic::message(&format!("{what} was stopped and left no result"), "")
            }
            Self::Usage { message, help } => diagnostic::message(message, help),
        };
        diagnostic::print(&text);
    }
}
