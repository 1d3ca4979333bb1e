//! Comparison of a page of the documentation with what the program writes.

use std::{fs, path::Path};

/// Words are compared as words, numbers as numbers: the last digits may differ between C libraries. A percentage has one decimal.
#[track_caller]
pub fn assert_page(place: &str, new: &str, command: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(place);
    let old = fs::read_to_string(path).unwrap();
    let words = |text: &str| -> Vec<String> {
        text.replace('\u{2212}', "-")
            .split(|c: char| c.is_whitespace() || "|(;,:".contains(c))
            .filter(|word| !word.is_empty())
            .map(ToOwned::to_owned)
            .collect()
    };
    let (old, new) = (words(&old), words(new));
    for (i, (a, b)) in old.iter().zip(&new).enumerate() {
        let least = match new.get(i + 1).map(String::as_str) {
            Some("%") => 0.11,
            _ => 2e-4,
        };
        let same = match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(x), Ok(y)) => (x - y).abs() <= 0.02 * x.abs().max(y.abs()) + least,
            _ => a == b,
        };
        assert!(
            same,
            "{place} has `{a}` where `{b}` comes out: run `{command}`"
        );
    }
    assert_eq!(old.len(), new.len());
}
