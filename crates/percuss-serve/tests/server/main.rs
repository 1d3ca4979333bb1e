//! A server on a free port, asked by its own page and by others.

mod calibrations;
mod connections;
mod host_guard;
mod limits;
mod refinement;
mod requests;
mod responses;
mod studies;
mod support;
mod sweeps;

use serde_json::json;
use support::PAPER;

/// A request that is answered.
fn body() -> Vec<u8> {
    json!({ "case": PAPER, "model": "chain" })
        .to_string()
        .into_bytes()
}
