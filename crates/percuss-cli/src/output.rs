//! Standard output: text and JSON.

use std::io::{self, Write};

use percuss::summary::{ResultRecord, Role, result_numbers};
use serde::Serialize;

use crate::failure::Failure;

/// Writes to standard output. A reader that has gone away, as in `percuss materials | head -1`, is no failure.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Output(error)),
        _ => Ok(()),
    }
}

/// Writes a value to standard output as JSON.
pub fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    print(&json(value)?)
}

/// A value as JSON text that ends with a line break.
pub fn json(value: &impl Serialize) -> Result<String, Failure> {
    serde_json::to_string_pretty(value)
        .map(|text| text + "\n")
        .map_err(|error| Failure::Output(error.into()))
}

/// The main results as NAME=VALUE, `null` for what the model does not give.
pub fn main_numbers(record: &ResultRecord) -> String {
    let main = result_numbers().filter(|number| number.role == Role::Main);
    let pairs = main.map(|number| match number.of(record) {
        Some(value) => format!("{}={value}", number.name),
        None => format!("{}=null", number.name),
    });
    pairs.collect::<Vec<_>>().join(" ")
}
