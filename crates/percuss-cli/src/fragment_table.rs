//! The pieces that fly at the end of a run, as text for people.

use percuss::{fragments::FragmentRecord, units::significant};

use crate::{
    table::{Column, blocks},
    terminal::bold,
};

/// Most pieces that the table lists; a run with more says how many there are.
const MOST_PIECES: usize = 12;

/// A table of the pieces, when there are more than the projectile.
pub fn text(pieces: &[FragmentRecord]) -> String {
    if pieces.len() < 2 {
        return String::new();
    }
    let shown = &pieces[..pieces.len().min(MOST_PIECES)];
    let first = Column {
        heading: "origin".to_owned(),
        cells: shown.iter().map(|piece| piece.origin.clone()).collect(),
        numbers: false,
    };
    let numbers = |heading: &str, value: fn(&FragmentRecord) -> f64| Column {
        heading: heading.to_owned(),
        cells: shown
            .iter()
            .map(|piece| significant(value(piece), 4))
            .collect(),
        numbers: true,
    };
    let columns = vec![
        numbers("from\nmm", |piece| piece.initial_from_mm),
        numbers("to\nmm", |piece| piece.initial_to_mm),
        numbers("mass\ng", |piece| piece.mass_g),
        numbers("velocity\nm/s", |piece| piece.velocity_m_s),
        numbers("length\nmm", |piece| piece.length_mm),
        numbers("diameter\nmm", |piece| piece.diameter_mm),
    ];
    let mut text = format!(
        "\n{}\n{}",
        bold("free pieces, from tail to back"),
        blocks(&first, columns)
    );
    // The next block starts with an empty line of its own.
    text.pop();
    if pieces.len() > MOST_PIECES {
        let more = pieces.len() - MOST_PIECES;
        text += &format!("and {more} more, which `--json` and `--out` list\n");
    }
    text
}
