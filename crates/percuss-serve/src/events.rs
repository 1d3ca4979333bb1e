//! Streamed responses: lines of JSON with the progress, the last one with the result. A disconnected client cancels the run.

use std::sync::{Mutex, MutexGuard, PoisonError};

use axum::{
    body::Bytes,
    response::{IntoResponse, Response},
};
use serde::Serialize;
use serde_json::{Value, json};
use tokio::sync::mpsc::Sender;

use crate::{
    job::{Stop, Workers},
    problem::Problem,
    stream,
};

/// Sender of progress to a client; what finds the queue full is left out.
pub(crate) struct EventSender {
    sender: Sender<Bytes>,
    /// The last progress.
    last: Mutex<Bytes>,
}

impl EventSender {
    fn new(sender: Sender<Bytes>) -> Self {
        let last = Mutex::new(progress_line(0.0, ""));
        Self { sender, last }
    }

    /// Sends the progress, 0 to 1, and a short text.
    pub(crate) fn progress(&self, fraction: f64, words: &str) {
        let line = progress_line(fraction, words);
        *self.last() = line.clone();
        let _ = self.sender.try_send(line);
    }

    /// Sends the last progress again, or that there is none: that a client has gone is seen when something is sent to it.
    pub(crate) fn repeat(&self) {
        let line = self.last().clone();
        let _ = self.sender.try_send(line);
    }

    /// Whether the client has disconnected.
    pub(crate) fn is_disconnected(&self) -> bool {
        self.sender.is_closed()
    }

    fn last(&self) -> MutexGuard<'_, Bytes> {
        // What it guards is whole after every statement.
        self.last.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn progress_line(fraction: f64, words: &str) -> Bytes {
    line_of(&json!({ "progress": { "fraction": fraction.clamp(0.0, 1.0), "words": words } }))
}

fn line_of(value: &Value) -> Bytes {
    // Every response has text keys and can be serialised.
    let mut line = serde_json::to_vec(value).unwrap_or_default();
    line.push(b'\n');
    line.into()
}

/// Computes on a worker thread and streams the progress.
pub(crate) async fn respond<T: Serialize>(
    workers: &Workers,
    work: impl FnOnce(&Stop, &EventSender) -> Result<T, Problem> + Send + 'static,
) -> Response {
    let place = match workers.place().await {
        Ok(place) => place,
        Err(problem) => return problem.into_response(),
    };
    stream::respond(
        workers,
        "application/x-ndjson",
        line_of,
        move |sender, stop| {
            let _place = place;
            let done = work(&stop, &EventSender::new(sender))?;
            // Every result has text keys and can be serialised.
            Ok(serde_json::to_value(done).unwrap_or_default())
        },
    )
}

/// A value as JSON, for a file.
pub(crate) fn pretty(value: &impl Serialize) -> String {
    let value: Value = serde_json::to_value(value).unwrap_or_default();
    format!("{value:#}\n")
}
