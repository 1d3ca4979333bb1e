//! Table of the fragments at the end of a run.

use percuss::{fragments::FragmentRecord, units::significant};
use percuss_report::table::Table;

use crate::{table::blocks, terminal::bold};

/// Largest number of listed fragments; the rest is counted.
const MAX_FRAGMENTS: usize = 12;

/// Table of the fragments; empty when there is only the projectile.
pub fn text(fragments: &[FragmentRecord]) -> String {
    if fragments.len() < 2 {
        return String::new();
    }
    let shown = &fragments[..fragments.len().min(MAX_FRAGMENTS)];
    let number = |value: f64| significant(value, 4);
    let table = Table::of(shown)
        .words("origin", |fragment| fragment.origin.clone())
        .numbers("from", "mm", |fragment| number(fragment.initial_from_mm))
        .numbers("to", "mm", |fragment| number(fragment.initial_to_mm))
        .numbers("mass", "g", |fragment| number(fragment.mass_g))
        .numbers("velocity", "m/s", |fragment| number(fragment.velocity_m_s))
        .numbers("length", "mm", |fragment| number(fragment.length_mm))
        .numbers("diameter", "mm", |fragment| number(fragment.diameter_mm))
        .table();
    let mut text = format!("\n{}\n{}", bold("free fragments"), blocks(&table));
    // The next block starts with an empty line of its own.
    text.pop();
    if fragments.len() > MAX_FRAGMENTS {
        let more = fragments.len() - MAX_FRAGMENTS;
        text += &format!("and {more} more, which `--json` and `--out` list\n");
    }
    text
}
