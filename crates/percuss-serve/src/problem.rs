//! Problem with a request, with the same messages as on the command line.

use axum::{
    http::StatusCode,
    response::{IntoResponse, Response},
};
use percuss::{Error, InputError, quote::capitalized};
use percuss_report::page::{Block, html};
use serde::Serialize;

use crate::http;

/// Characters of a line that are shown at most, and of them before the place.
const MOST: usize = 240;
const BEFORE: usize = 80;

/// Message, place and remedy.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Problem {
    #[serde(skip)]
    pub(crate) status: StatusCode,
    message: String,
    help: String,
    /// Dotted key of the case; may be empty.
    key: String,
    /// Place in the case, if it is known.
    place: Option<Box<Place>>,
}

/// A place in the text of a case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
struct Place {
    /// Counted from 1.
    line: usize,
    text: String,
    /// First character and number of characters of the marked text.
    column: usize,
    length: usize,
}

impl Problem {
    fn new(status: StatusCode, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            status,
            message: message.into(),
            help: help.into(),
            key: String::new(),
            place: None,
        }
    }

    /// Malformed request.
    pub(crate) fn bad_request(message: impl Into<String>) -> Self {
        Self::new(StatusCode::BAD_REQUEST, message, "reload the page")
    }

    /// What is wrong at a key of the case.
    pub(crate) fn at(key: &str, message: String, help: impl Into<String>) -> Self {
        Self {
            key: key.to_owned(),
            ..Self::new(StatusCode::UNPROCESSABLE_ENTITY, message, help)
        }
    }

    #[cfg(test)]
    pub(crate) fn key(&self) -> &str {
        &self.key
    }

    pub(crate) fn with_status(status: StatusCode, message: &str, help: &str) -> Self {
        Self::new(status, message, help)
    }

    /// Request that cannot be fulfilled.
    pub(crate) fn refused(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, message, help)
    }

    /// Message.
    pub(crate) fn message(&self) -> &str {
        &self.message
    }

    /// What a browser shows in place of a page.
    pub(crate) fn page(&self) -> Response {
        let words = |text: &str| capitalized(&text.replace('`', ""));
        let page = [
            Block::Title(words(&self.message)),
            Block::Text(format!("{}.", words(&self.help))),
        ];
        http::report_of(self.status, &html::render(&page))
    }

    /// Message and remedy.
    pub(crate) fn into_message_and_help(self) -> (String, String) {
        (self.message, self.help)
    }

    /// All workers are busy.
    pub(crate) fn busy(runs: usize) -> Self {
        Self::new(
            StatusCode::SERVICE_UNAVAILABLE,
            format!("{runs} runs are in progress, which is the limit"),
            "cancel one, or try again later",
        )
    }

    /// The run took too long.
    pub(crate) fn too_slow(seconds: u64) -> Self {
        Self::new(
            StatusCode::UNPROCESSABLE_ENTITY,
            format!("the run was stopped at the time limit of {seconds} s"),
            "reduce the study, use a coarser mesh, restart the page with a larger `--max-seconds`, or use the command line",
        )
    }

    /// Cancelled run.
    pub(crate) fn cancelled() -> Self {
        Self::new(StatusCode::CONFLICT, "the run was cancelled", "")
    }

    /// A fault of the program.
    pub(crate) fn fault() -> Self {
        Self::new(
            StatusCode::INTERNAL_SERVER_ERROR,
            "the program failed on this case because of an internal error",
            "please report it with the case",
        )
    }
}

impl From<Error> for Problem {
    fn from(error: Error) -> Self {
        let (message, help) = error.message_and_help();
        let mut problem = Self::new(StatusCode::UNPROCESSABLE_ENTITY, message, help);
        if let Error::Input(error) = &error {
            problem.key.clone_from(&error.key);
            problem.place = Place::of(error);
        }
        problem
    }
}

impl From<percuss_report::ReportError> for Problem {
    fn from(error: percuss_report::ReportError) -> Self {
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, error.to_string(), "")
    }
}

impl Place {
    fn of(error: &InputError) -> Option<Box<Self>> {
        if error.span.is_empty() && error.span.start == 0 {
            return None;
        }
        let text = &error.text;
        let start = text.floor_char_boundary(error.span.start.min(text.len()));
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let end = text.ceil_char_boundary(error.span.end.clamp(start, line_end));
        let line = text[line_start..line_end].trim_end_matches('\r');
        let column = text[line_start..start].chars().count();
        let length = text[start..end].trim_end().chars().count().max(1);
        // Of a long line the part about the place.
        let left = column.saturating_sub(BEFORE);
        let shown: String = line.chars().skip(left).take(MOST).collect();
        Some(Box::new(Self {
            line: error.line(),
            column: column - left,
            length: length.min(MOST - (column - left)),
            text: shown,
        }))
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = self.status;
        http::json(status, &serde_json::json!({ "problem": self }))
    }
}
