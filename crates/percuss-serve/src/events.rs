//! Streamed responses: lines of JSON with the progress, the last one with the result. A disconnected client cancels the run.

use axum::{
    body::{Body, Bytes},
    http::StatusCode,
    response::{IntoResponse, Response},
};
use serde::Serialize;
use serde_json::{Value, json};
use tokio::{
    sync::mpsc::{self, Sender},
    task,
};

use crate::{
    http,
    job::{Stop, Workers},
    problem::Problem,
};

/// Largest number of queued lines; further progress is left out.
const WAITING: usize = 8;

/// Sender of progress to a client.
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

fn line_of(value: &impl Serialize) -> Bytes {
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
    let stop = Stop::after(workers.bounds().time());
    let (sender, receiver) = mpsc::channel(WAITING);
    let last = sender.clone();
    let computed = task::spawn_blocking(move || {
        let _place = place;
        let events = EventSender(sender);
        work(&stop, &events).map(|done| line_of(&json!({ "done": done })))
    });
    task::spawn(async move {
        let line = match computed.await {
            Ok(Ok(line)) => line,
            Ok(Err(problem)) => line_of(&json!({ "problem": problem })),
            Err(_) => line_of(&json!({ "problem": Problem::fault() })),
        };
        // A disconnected client needs no response.
        let _ = last.send(line).await;
    });
    http::respond(
        StatusCode::OK,
        "application/x-ndjson",
        Body::new(http::Chunks(receiver)),
    )
}

/// A value as JSON, for a file.
pub(crate) fn pretty(value: &impl Serialize) -> String {
    let value: Value = serde_json::to_value(value).unwrap_or_default();
    format!("{value:#}\n")
}
