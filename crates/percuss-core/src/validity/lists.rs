//! Lists in words.

use crate::{material::MaterialClass, regime::TargetKind};

/// `, of metal` behind a list of targets; nothing where none of them is made of anything.
pub fn of_material(targets: &[TargetKind], classes: &[MaterialClass]) -> String {
    match targets.iter().any(|kind| kind.has_material()) {
        true => format!(
            ", of {}",
            list(classes.iter().map(|class| class.describe()))
        ),
        false => String::new(),
    }
}

/// `a`, `a or b`, `a, b or c`.
pub fn list(words: impl Iterator<Item = &'static str>) -> String {
    joined(words, "or")
}

/// `a`, `a and b`, `a, b and c`.
pub(super) fn conjunction(words: impl Iterator<Item = &'static str>) -> String {
    joined(words, "and")
}

fn joined(words: impl Iterator<Item = &'static str>, last_word: &str) -> String {
    let words: Vec<&str> = words.collect();
    match words.as_slice() {
        [] => "nothing".to_owned(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} {last_word} {last}", first.join(", ")),
    }
}
