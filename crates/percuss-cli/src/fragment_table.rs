//! The pieces that fly at the end of a run, as text for people.

use percuss::{fragments::FragmentRecord, units::significant};
use percuss_report::table::Table;

use crate::{table::blocks, terminal::bold};

/// Most pieces that the table lists; a run with more says how many there are.
const MOST_PIECES: usize = 12;

/// A table of the pieces, when there are more than the projectile.
pub fn text(pieces: &[FragmentRecord]) -> String {
    if pieces.len() < 2 {
        return String::new();
    }
    let shown = &pieces[..pieces.len().min(MOST_PIECES)];
    let number = |value: f64| significant(value, 4);
    let table = Table::of(shown)
        .words("origin", |piece| piece.origin.clone())
        .numbers("from", "mm", |piece| number(piece.initial_from_mm))
        .numbers("to", "mm", |piece| number(piece.initial_to_mm))
        .numbers("mass", "g", |piece| number(piece.mass_g))
        .numbers("velocity", "m/s", |piece| number(piece.velocity_m_s))
        .numbers("length", "mm", |piece| number(piece.length_mm))
        .numbers("diameter", "mm", |piece| number(piece.diameter_mm))
        .table();
    let mut text = format!(
        "\n{}\n{}",
        bold("free pieces, from tail to back"),
        blocks(&table)
    );
    // The next block starts with an empty line of its own.
    text.pop();
    if pieces.len() > MOST_PIECES {
        let more = pieces.len() - MOST_PIECES;
        text += &format!("and {more} more, which `--json` and `--out` list\n");
    }
    text
}
