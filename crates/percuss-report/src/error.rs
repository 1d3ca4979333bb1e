//! Errors of drawing and writing results.

use std::{io, path::PathBuf};

use percuss::{history::History, outcome::RunResult, quote::shown};

/// Any failure of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The result was computed without keeping its time history.
    #[error(
        "the result of model `{model}` holds no time history; run it with `Control::recording()` to keep one"
    )]
    NoHistory {
        /// Name of the model.
        model: &'static str,
    },
    /// A file or folder could not be written.
    #[error("cannot write `{}`: {source}", shown(.path))]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        #[source]
        source: io::Error,
    },
    /// A file that belongs to a series of fields could not be read.
    #[error("cannot read `{}`: {reason}", shown(.path))]
    Read {
        /// The file.
        path: PathBuf,
        /// Why, in words.
        reason: String,
    },
    /// A folder of a sweep is not what it should be.
    #[error("`{}`: {reason}", shown(.path))]
    Sweep {
        /// The folder or file.
        path: PathBuf,
        /// Reason.
        reason: String,
        /// Remedy.
        remedy: String,
    },
    /// A figure could not be turned into pixels.
    #[error("cannot draw figure `{name}`: {reason}")]
    Figure {
        /// File stem of the figure.
        name: String,
        /// Why, in words.
        reason: String,
    },
    /// A table could not be encoded.
    #[error("cannot encode table `{table}`: {source}")]
    Table {
        /// Name of the file it was meant for.
        table: String,
        /// The encoder's error.
        #[source]
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

/// The history of a result.
pub(crate) fn history_of(result: &RunResult) -> Result<&History, ReportError> {
    result
        .history
        .as_ref()
        .filter(|history| !history.samples.is_empty())
        .ok_or(ReportError::NoHistory {
            model: result.model,
        })
}
