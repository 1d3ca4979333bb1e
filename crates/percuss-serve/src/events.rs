//! Streamed responses: lines of JSON with the progress, the last one with the result. A disconnected client cancels the run.

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
pub(crate) struct EventSender(Sender<Bytes>);

impl EventSender {
    /// Sends the progress, 0 to 1, and a short text.
    pub(crate) fn progress(&self, fraction: f64, words: &str) {
        let line = json!({ "progress": { "fraction": fraction.clamp(0.0, 1.0), "words": words } });
        let _ = self.0.try_send(line_of(&line));
    }

    /// Whether the client has disconnected.
    pub(crate) fn is_disconnected(&self) -> bool {
        self.0.is_closed()
    }
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
            let done = work(&stop, &EventSender(sender))?;
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
