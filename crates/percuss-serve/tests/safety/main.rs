//! Requests that no page of this server makes.

#[path = "../support/mod.rs"]
mod support;

mod bounds;
mod gate;
mod requests;

use serde_json::json;
use support::PAPER;

/// A request that is answered.
fn body() -> Vec<u8> {
    json!({ "case": PAPER, "model": "chain" })
        .to_string()
        .into_bytes()
}
