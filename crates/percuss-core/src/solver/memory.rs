//! Memory that a run may take: estimated before it allocates, and refused above a limit.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::{Refusal, input_file::size};

/// Limit unless another one is set: 4 GiB.
pub const DEFAULT_MEMORY_LIMIT: u64 = 4 << 30;
/// Variable of the environment that sets the limit, unless [`set_memory_limit`] does.
pub const MEMORY_VARIABLE: &str = "PERCUSS_MEMORY_LIMIT";

/// The limit [bytes]; 0 until it is asked for.
static LIMIT: AtomicU64 = AtomicU64::new(0);

/// Largest memory that a run may take [bytes].
pub fn memory_limit() -> u64 {
    match LIMIT.load(Ordering::Relaxed) {
        0 => {
            let given = std::env::var(MEMORY_VARIABLE).ok();
            let limit = given.and_then(|text| parse_size(&text));
            let limit = limit.unwrap_or(DEFAULT_MEMORY_LIMIT);
            // Another thread may have set it meanwhile.
            let before = LIMIT.compare_exchange(0, limit, Ordering::Relaxed, Ordering::Relaxed);
            before.map_or_else(|set| set, |_| limit)
        }
        limit => limit,
    }
}

/// Sets the largest memory that a run may take, for all runs of the process [bytes].
pub fn set_memory_limit(bytes: u64) {
    LIMIT.store(bytes, Ordering::Relaxed);
}

/// Reads a size with its unit, such as `16 GiB` or `500 MiB`.
pub fn parse_size(text: &str) -> Option<u64> {
    let text = text.trim();
    let start = text.find(|c: char| c.is_ascii_alphabetic());
    let (number, unit) = text.split_at(start.unwrap_or(text.len()));
    let factor = match unit.trim() {
        "B" => 1.0,
        "KiB" => 1024.0,
        "MiB" => 1_048_576.0,
        "GiB" => 1_073_741_824.0,
        "TiB" => 1_099_511_627_776.0,
        _ => return None,
    };
    let bytes = number.trim().parse::<f64>().ok()? * factor;
    // Up to 2^53 a number of bytes is exact.
    (1.0..=9.007e15).contains(&bytes).then_some(bytes as u64)
}

/// Why a run that takes so many bytes is refused, if it is.
pub fn refusal(bytes: f64) -> Option<Refusal> {
    let limit = memory_limit();
    (bytes > limit as f64).then(|| {
        Refusal::new(format!(
            "a run takes about {} of memory, more than the limit of {}",
            size(bytes as u64),
            size(limit)
        ))
        .with_remedy(format!(
            "take a coarser mesh or a smaller target, or set {MEMORY_VARIABLE}, such as \"{}\"",
            size(
                (bytes as u64)
                    .checked_next_power_of_two()
                    .unwrap_or(u64::MAX)
            )
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_with_their_units() {
        for (text, bytes) in [
            ("16 GiB", 16 << 30),
            ("1.5GiB", 3 << 29),
            ("500 MiB", 500 << 20),
            (" 4096 B ", 4096),
        ] {
            assert_eq!(parse_size(text), Some(bytes), "{text}");
        }
        for text in [
            "", "8", "GiB", "0 GiB", "-1 GiB", "16 GB", "inf", "nan GiB", "1e9 TiB",
        ] {
            assert_eq!(parse_size(text), None, "{text}");
        }
    }

    #[test]
    fn above_the_limit_a_run_is_refused_with_a_limit_that_allows_it() {
        assert_eq!(refusal(DEFAULT_MEMORY_LIMIT as f64), None);
        let words = refusal(5.4e9).unwrap().to_string();
        assert_eq!(
            words,
            "a run takes about 5 GiB of memory, more than the limit of 4 GiB; take a coarser mesh or a smaller target, or set \
             PERCUSS_MEMORY_LIMIT, such as \"8 GiB\""
        );
        assert!(refusal(f64::INFINITY).is_some());
    }
}
