//! Streamed response of a computation on a worker thread.

use std::{
    convert::Infallible,
    pin::Pin,
    task::{Context, Poll},
};

use axum::{
    body::{Body, Bytes},
    http::StatusCode,
    response::Response,
};
use http_body::Frame;
use serde_json::{Value, json};
use tokio::{
    sync::mpsc::{self, Receiver, Sender},
    task,
};

use crate::{
    http,
    job::{Stop, Workers},
    problem::Problem,
};

/// Largest number of queued pieces.
const WAITING: usize = 8;

/// Computes on a worker thread, which sends pieces of the response; the last one, by `encode`, is `done` with the result or a `problem`.
pub(crate) fn respond(
    workers: &Workers,
    content_type: &'static str,
    encode: fn(&Value) -> Bytes,
    work: impl FnOnce(Sender<Bytes>, Stop) -> Result<Value, Problem> + Send + 'static,
) -> Response {
    let stop = Stop::after(workers.bounds().time());
    let (sender, receiver) = mpsc::channel(WAITING);
    let last = sender.clone();
    let computed = task::spawn_blocking(move || on_own_threads(move || work(sender, stop)));
    task::spawn(async move {
        let end = match computed.await {
            Ok(Ok(done)) => json!({ "done": done }),
            Ok(Err(problem)) => json!({ "problem": problem }),
            Err(_) => json!({ "problem": Problem::fault() }),
        };
        // A disconnected client needs no response.
        let _ = last.send(encode(&end)).await;
    });
    http::respond(StatusCode::OK, content_type, Body::new(Chunks(receiver)))
}

/// Works on threads of its own: on shared ones a run in parallel would wait behind all that a sweep has queued, and keep its place.
fn on_own_threads<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().build() {
        Ok(pool) => pool.install(work),
        // The system has no more threads: those that all share are there.
        Err(_) => work(),
    }
}

/// Body of a streamed response.
struct Chunks(Receiver<Bytes>);

impl http_body::Body for Chunks {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        let chunk = self.0.poll_recv(context);
        chunk.map(|chunk| chunk.map(|chunk| Ok(Frame::data(chunk))))
    }
}
