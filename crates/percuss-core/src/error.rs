//! Errors: what went wrong, where, what is allowed and what to do.

use std::{fmt, io, ops::Range, path::PathBuf};

use crate::{
    Refusal,
    quote::{shorten_words, shown},
};

/// Any failure of the library.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A case or material file, or a case built in code, is not valid.
    #[error(transparent)]
    Input(Box<InputError>),
    /// The model does not apply to this case.
    #[error("model `{model}` does not apply to this case: {refusal}")]
    NotApplicable {
        /// Name of the model.
        model: &'static str,
        /// Why, and the remedy.
        refusal: Refusal,
    },
    /// No quick model applies to this case.
    #[error("{}: {}", no_model_message(.by_name), in_one_line(.reasons))]
    NoModelApplies {
        /// Names of the models, and why each of them does not apply.
        reasons: Vec<(&'static str, String)>,
        /// Models that apply, and that are run where they are named only.
        by_name: Vec<&'static str>,
    },
    /// No model has this name.
    #[error("no model is named `{name}`{}; models: {}", did_you_mean(.suggestion), .known.join(", "))]
    UnknownModel {
        /// The name asked for.
        name: String,
        /// The nearest name, if one is near.
        suggestion: Option<String>,
        /// All names.
        known: Vec<&'static str>,
    },
    /// The numerical solution failed.
    #[error(transparent)]
    Numerical(#[from] Box<NumericalError>),
    /// The run was stopped from outside.
    #[error("the run was cancelled at step {step}, {time_us:.3} us")]
    Cancelled {
        /// Steps taken.
        step: u64,
        /// Time reached [us].
        time_us: f64,
    },
    /// A model panicked: a fault of the program.
    #[error("{0}")]
    Fault(String),
    /// A checkpoint cannot be used.
    #[error("cannot continue from the checkpoint: {reason}")]
    Checkpoint {
        /// Why, in words.
        reason: String,
        /// What to do.
        remedy: String,
    },
    /// A calibration cannot be set up, or finds nothing.
    #[error("{reason}; {remedy}")]
    Calibration {
        /// Why, in words.
        reason: String,
        /// What to do.
        remedy: String,
    },
    /// A file could not be read.
    #[error("cannot read `{}`: {}", shown(.path), with_remedy(.reason, .remedy))]
    Read {
        /// The file.
        path: PathBuf,
        /// Why, in words.
        reason: String,
        /// What to do; may be empty.
        remedy: String,
        /// The system's error, where there is one.
        #[source]
        source: Option<io::Error>,
    },
}

/// Help for a model that does not apply and names no remedy.
const WHICH_APPLY: &str = "`percuss compare CASE.toml` names the models that apply";

impl Error {
    /// The refusal of a model.
    pub fn not_applicable(model: &'static str, refusal: impl Into<Refusal>) -> Self {
        Self::NotApplicable {
            model,
            refusal: refusal.into(),
        }
    }

    /// What is wrong, and what to do about it; the latter may be empty.
    pub fn message_and_help(&self) -> (String, String) {
        match self {
            Self::Input(error) => (error.message.clone(), error.help.clone()),
            Self::NotApplicable { model, refusal } => {
                let reason = &refusal.reason;
                let message = format!("model `{model}` does not apply to this case: {reason}");
                let remedy = refusal.remedy.as_deref().unwrap_or(WHICH_APPLY);
                (message, remedy.to_owned())
            }
            Self::NoModelApplies { reasons, by_name } => {
                (no_model_message(by_name), in_one_line(reasons))
            }
            Self::UnknownModel {
                name,
                suggestion,
                known,
            } => {
                let near = suggestion
                    .as_ref()
                    .map_or_else(String::new, |near| format!("did you mean `{near}`? "));
                (
                    format!("no model is named `{name}`"),
                    format!("{near}models: {}", known.join(", ")),
                )
            }
            Self::Numerical(error) => {
                let mut error = (**error).clone();
                let remedy = std::mem::take(&mut error.remedy);
                let message = error.to_string();
                (message.trim_end_matches([':', ' ']).to_owned(), remedy)
            }
            Self::Checkpoint { remedy, .. } => (self.to_string(), remedy.clone()),
            Self::Calibration { reason, remedy } => (reason.clone(), remedy.clone()),
            Self::Read {
                path,
                reason,
                remedy,
                ..
            } => (
                format!("cannot read `{}`: {reason}", shown(path)),
                remedy.clone(),
            ),
            other => (other.to_string(), String::new()),
        }
    }
}

/// Reason and remedy in one line.
fn with_remedy(reason: &str, remedy: &str) -> String {
    match remedy {
        "" => reason.to_owned(),
        remedy => format!("{reason}; {remedy}"),
    }
}

impl From<Box<InputError>> for Error {
    fn from(error: Box<InputError>) -> Self {
        (*error).into()
    }
}

impl From<InputError> for Error {
    fn from(error: InputError) -> Self {
        Self::Input(Box::new(error.abridged()))
    }
}

impl From<NumericalError> for Error {
    fn from(error: NumericalError) -> Self {
        Self::Numerical(Box::new(error))
    }
}

/// What is wrong where no quick model applies.
fn no_model_message(by_name: &[&str]) -> String {
    match by_name.is_empty() {
        true => "no model applies to this case".to_owned(),
        false => format!(
            "no quick model applies to this case; these apply if named by `--model`: {}",
            by_name.join(", ")
        ),
    }
}

fn in_one_line(reasons: &[(&'static str, String)]) -> String {
    let lines: Vec<String> = reasons
        .iter()
        .map(|(model, reason)| format!("{model}: {reason}"))
        .collect();
    lines.join("; ")
}

/// What an error of input is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Subject {
    /// What a file describes: a case, a sweep, tests.
    #[default]
    Case,
    /// A material, or the name of one.
    Material,
    /// A file of materials that cannot be read.
    MaterialFile,
    /// A case file that another file names and that cannot be read.
    CaseFile,
}

/// What is wrong in a case or material file, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputError {
    /// What it is about.
    pub subject: Subject,
    /// The file, or a name for a text that came from no file.
    pub file: String,
    /// The text of the file.
    pub text: String,
    /// Bytes of `text` that the error is about; empty when it is about the file as a whole.
    pub span: Range<usize>,
    /// The key in dotted form, for example `projectile.diameter`; empty when there is none.
    pub key: String,
    /// What is wrong: one line.
    pub message: String,
    /// What is allowed and what to do; may be empty.
    pub help: String,
}

impl InputError {
    /// The same with at most so much of what a file holds in its words that a message stays one.
    fn abridged(self) -> Self {
        const MOST: usize = 2500;
        let short = |text: String| -> String { shorten_words(&text).chars().take(MOST).collect() };
        Self {
            key: short(self.key),
            message: short(self.message),
            help: short(self.help),
            ..self
        }
    }

    /// Line of the error, counted from 1.
    pub fn line(&self) -> usize {
        let end = self.span.start.min(self.text.len());
        1 + self.text.as_bytes()[..end]
            .iter()
            .filter(|&&byte| byte == b'\n')
            .count()
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A case that is built in code has no lines.
        match self.text.is_empty() {
            true => write!(f, "{}: ", self.file)?,
            false => write!(f, "{}:{}: ", self.file, self.line())?,
        }
        if !self.key.is_empty() {
            write!(f, "`{}`: ", self.key)?;
        }
        f.write_str(&self.message)?;
        if !self.help.is_empty() {
            write!(f, " ({})", self.help)?;
        }
        Ok(())
    }
}

impl std::error::Error for InputError {}

/// A numerical failure, with the place in time and space where it was seen.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{what} at step {step}, time {time_us:.4} us{}: {remedy}", in_element(.element))]
pub struct NumericalError {
    /// What failed.
    pub what: String,
    /// Time step.
    pub step: u64,
    /// Time [us].
    pub time_us: f64,
    /// Element, counted from the tail of the projectile, if one can be named.
    pub element: Option<usize>,
    /// What to do.
    pub remedy: String,
}

fn in_element(element: &Option<usize>) -> String {
    element.map_or_else(String::new, |index| format!(", element {index}"))
}

pub(crate) fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion
        .as_ref()
        .map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

/// Length of a name above which no candidate is looked for: the time for it grows with the length [bytes].
const LONGEST_MISTYPED: usize = 200;

/// The candidate nearest to a mistyped name, if one is near enough to be meant.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    if name.len() > LONGEST_MISTYPED {
        return None;
    }
    let name = name.to_lowercase();
    candidates
        .into_iter()
        .map(|candidate| {
            let distance = strsim::damerau_levenshtein(&name, &candidate.to_lowercase());
            (distance, candidate)
        })
        .filter(|(distance, candidate)| {
            *distance <= (candidate.len() / 3).max(1)
                || (name.len() >= 3 && candidate.to_lowercase().contains(&name))
                || common_start(&name, &candidate.to_lowercase())
                    >= (2 * candidate.len() / 3).max(4)
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate.to_owned())
}

/// The name that another one is with a letter or two wrong; `None` for short names, of which every word is a neighbour.
pub fn misspelt<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > LONGEST_MISTYPED {
        return None;
    }
    let distances = candidates.into_iter().map(|candidate| {
        let distance = strsim::damerau_levenshtein(name, candidate);
        (distance, candidate)
    });
    let near = distances.filter(|(distance, candidate)| *distance <= candidate.len() / 5);
    let nearest = near.min_by_key(|(distance, _)| *distance);
    nearest.map(|(_, candidate)| candidate)
}

/// Bytes that two names have in common at their start.
fn common_start(a: &str, b: &str) -> usize {
    a.bytes().zip(b.bytes()).take_while(|(a, b)| a == b).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_name_is_no_mistyped_one() {
        let nearest_to = |name: &str| nearest(name, ["copper", "steel"]);
        assert_eq!(nearest_to("coper").as_deref(), Some("copper"));
        let start = std::time::Instant::now();
        assert_eq!(nearest_to(&"copper".repeat(1 << 20)), None);
        assert!(start.elapsed().as_secs() < 5);
    }
}
