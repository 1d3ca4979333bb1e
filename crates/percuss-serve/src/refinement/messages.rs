//! Streamed response of binary messages, from a background computation that is cancelled with its request.
//!
//! A message is the length of its head and of its body in bytes (two 32-bit integers, the lower byte first), the head, which is JSON filled
//! up with spaces to a multiple of four bytes, and the body.

use std::{cell::RefCell, ops::ControlFlow, thread, time::Duration};

use axum::{
    body::Bytes,
    response::{IntoResponse, Response},
};
use serde::Serialize;
use serde_json::Value;
use tokio::sync::mpsc::{Sender, error::TrySendError};

use crate::{
    job::{BackgroundPlace, Stop, Workers},
    problem::Problem,
    stream,
};

/// Time between two attempts to queue a message.
const ATTEMPT: Duration = Duration::from_millis(2);
/// Multiple of bytes at which a body begins.
const ALIGNMENT: usize = 4;

/// Sender of messages to a client; a computation waits for one that reads more slowly.
pub(super) struct MessageSender {
    sender: Sender<Bytes>,
    stop: Stop,
    place: RefCell<BackgroundPlace>,
}

impl MessageSender {
    /// Whether the computation continues; meanwhile its place is left to other requests.
    pub(super) fn go_on(&self) -> ControlFlow<()> {
        self.place.borrow_mut().give_way(|| self.flow())
    }

    fn flow(&self) -> ControlFlow<()> {
        if self.sender.is_closed() {
            self.stop.cancel();
        }
        self.stop.flow()
    }

    /// Queues a message without a body, unless the queue is full.
    pub(super) fn offer(&self, head: &impl Serialize) {
        let _ = self.sender.try_send(message(head, &[]));
    }

    /// Queues a message.
    pub(super) fn send(&self, head: &impl Serialize, body: &[u8]) -> ControlFlow<()> {
        let mut bytes = message(head, body);
        loop {
            self.go_on()?;
            match self.sender.try_send(bytes) {
                Ok(()) => return ControlFlow::Continue(()),
                Err(TrySendError::Full(unsent)) => bytes = unsent,
                Err(TrySendError::Closed(_)) => return ControlFlow::Break(()),
            }
            thread::sleep(ATTEMPT);
        }
    }

    /// The problem of a computation that failed with an error.
    pub(super) fn problem(&self, error: percuss::Error) -> Problem {
        self.stop.problem(error)
    }

    /// Problem of a stopped computation.
    pub(super) fn ended(&self) -> Problem {
        self.stop.ended()
    }
}

fn message(head: &impl Serialize, body: &[u8]) -> Bytes {
    // Every head has text keys and can be serialised.
    let mut head = serde_json::to_vec(head).unwrap_or_default();
    head.resize(head.len().next_multiple_of(ALIGNMENT), b' ');
    let mut bytes = Vec::with_capacity(2 * ALIGNMENT + head.len() + body.len());
    for length in [head.len(), body.len()] {
        bytes.extend((length as u32).to_le_bytes());
    }
    bytes.extend(head);
    bytes.extend(body);
    bytes.into()
}

/// Computes in the background and streams messages; the last one is `done` or a problem.
pub(super) async fn respond(
    workers: &Workers,
    work: impl FnOnce(&MessageSender) -> Result<(), Problem> + Send + 'static,
) -> Response {
    let place = match workers.background_place().await {
        Ok(place) => place,
        Err(problem) => return problem.into_response(),
    };
    let end = |value: &Value| message(value, &[]);
    stream::respond(
        workers,
        "application/octet-stream",
        end,
        move |sender, stop| {
            work(&MessageSender {
                sender,
                stop,
                place: RefCell::new(place),
            })?;
            Ok(Value::Bool(true))
        },
    )
}

#[cfg(test)]
mod tests {
    use super::message;

    #[test]
    fn a_body_begins_at_a_multiple_of_four_bytes() {
        for words in ["", "a", "ab", "abc", "abcd"] {
            let bytes = message(&words, &[1, 2, 3]);
            let length = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
            let (head, body) = (length(0) as usize, length(4) as usize);
            assert_eq!((head % 4, body), (0, 3));
            let text: String = serde_json::from_slice(&bytes[8..8 + head]).unwrap();
            assert_eq!(text, words);
            assert_eq!(bytes[8 + head..], [1, 2, 3]);
        }
    }
}
