//! Answers that take a while: lines of JSON, each with how far it is, the last one with what it came to. Who stops reading cancels.

use std::{
    convert::Infallible,
    pin::Pin,
    task::{Context, Poll},
};

use axum::{
    body::{Body, Bytes},
    http::StatusCode,
    response::{IntoResponse, Response},
};
use http_body::Frame;
use serde::Serialize;
use serde_json::{Value, json};
use tokio::{
    sync::mpsc::{self, Receiver, Sender},
    task,
};

use crate::{
    http,
    problem::Problem,
    worker::{Stop, Workers},
};

/// Lines that may wait to be sent; of more progress than a client reads, some is left out.
const WAITING: usize = 8;

/// Tells a client how far a computation is.
pub(crate) struct Tell(Sender<Bytes>);

impl Tell {
    /// Part done, 0 to 1, and a few words.
    pub(crate) fn progress(&self, fraction: f64, words: &str) {
        let line = json!({ "progress": { "fraction": fraction.clamp(0.0, 1.0), "words": words } });
        let _ = self.0.try_send(line_of(&line));
    }

    /// Whether nobody listens any more.
    pub(crate) fn is_alone(&self) -> bool {
        self.0.is_closed()
    }
}

fn line_of(value: &impl Serialize) -> Bytes {
    // Every value that is answered has text keys and so can be written.
    let mut line = serde_json::to_vec(value).unwrap_or_default();
    line.push(b'\n');
    line.into()
}

/// Computes on a thread of its own and answers as it goes.
pub(crate) async fn respond<T: Serialize>(
    workers: &Workers,
    work: impl FnOnce(&Stop, &Tell) -> Result<T, Problem> + Send + 'static,
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
        let tell = Tell(sender);
        work(&stop, &tell).map(|done| line_of(&json!({ "done": done })))
    });
    task::spawn(async move {
        let line = match computed.await {
            Ok(Ok(line)) => line,
            Ok(Err(problem)) => line_of(&json!({ "problem": problem })),
            Err(_) => line_of(&json!({ "problem": Problem::fault() })),
        };
        // A client that has gone needs no answer.
        let _ = last.send(line).await;
    });
    http::respond(
        StatusCode::OK,
        "application/x-ndjson",
        Body::new(Lines(receiver)),
    )
}

/// The lines as the body of a response.
struct Lines(Receiver<Bytes>);

impl http_body::Body for Lines {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        let line = self.0.poll_recv(context);
        line.map(|line| line.map(|line| Ok(Frame::data(line))))
    }
}

/// A value as JSON, for a file.
pub(crate) fn pretty(value: &impl Serialize) -> String {
    let value: Value = serde_json::to_value(value).unwrap_or_default();
    format!("{value:#}\n")
}
