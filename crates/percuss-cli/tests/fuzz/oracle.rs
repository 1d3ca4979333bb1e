//! What has to hold for every input: a result or a short typed error, in limited time.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    time::{Duration, Instant},
};

use super::targets::{BROKEN, Target};

/// Longest time of an input.
const LONGEST: Duration = Duration::from_secs(30);
/// Longest message of an error [bytes].
const LONGEST_MESSAGE: usize = 6000;

/// How a target ends with an input, or what is wrong with that.
pub fn tried(target: &Target, bytes: &[u8]) -> Result<&'static str, String> {
    let start = Instant::now();
    let end = catch_unwind(AssertUnwindSafe(|| (target.run)(bytes)));
    let end = end.map_err(|panic| {
        let words = panic.downcast_ref::<String>().cloned();
        let words = words.or_else(|| panic.downcast_ref::<&str>().map(|&text| text.to_owned()));
        format!("it panicked: {}", words.unwrap_or_default())
    })?;
    if start.elapsed() > LONGEST {
        return Err(format!("it took {:?}", start.elapsed()));
    }
    match end {
        Ok(kind) => Ok(kind),
        Err(message) if message.is_empty() => Err("an error without a message".to_owned()),
        Err(message) if message.len() > LONGEST_MESSAGE => {
            let start: String = message.chars().take(300).collect();
            Err(format!("a message of {} bytes: {start}", message.len()))
        }
        Err(message) => match message.strip_prefix(BROKEN) {
            Some(what) => Err(what.to_owned()),
            None => Ok("refused"),
        },
    }
}
