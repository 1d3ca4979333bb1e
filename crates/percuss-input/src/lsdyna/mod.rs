//! Material cards of LS-DYNA decks: read as records of the library, and written from them.
//!
//! `*MAT_JOHNSON_COOK` (015), `*MAT_SIMPLIFIED_JOHNSON_COOK` (098) and `*EOS_GRUNEISEN`, joined by `*PART` or by equal numbers. Decks carry
//! no units: the caller names a [`UnitSystem`].
//!
//! ```
//! use percuss::lsdyna::{self, UnitSystem};
//!
//! let deck = "*MAT_JOHNSON_COOK_TITLE
//! 4340 steel
//! 1,7.83e-6,80.,208.,0.3
//! 0.792,0.51,0.26,0.014,1.03,1793.,298.,0.001
//! 477.
//! ";
//! let units = UnitSystem::named("mm-kg-ms").unwrap();
//! let found = lsdyna::read("plate.k", deck, units)?;
//! assert_eq!(found.records["4340-steel"].density.si(), 7830.0);
//! # Ok::<(), percuss::Error>(())
//! ```

mod deck;
mod equation_of_state;
mod johnson_cook;
mod record;
#[cfg(test)]
mod tests;
mod write;

use std::path::Path;

use crate::{
    error::Error,
    input_file::{self, MAX_TABLE_BYTES},
    material::{Material, MaterialTable},
};

pub use crate::units::UnitSystem;
pub use write::write;

/// What was read from a deck.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Imported {
    /// The records by their ids, which come from the titles.
    pub records: MaterialTable,
    /// What the records leave out, a line each.
    pub warnings: Vec<String>,
}

impl Imported {
    /// Adds a record; without a name of its own it has that of its id, as in a case.
    pub(crate) fn add(&mut self, id: String, mut material: Material) {
        if material.name.is_empty() {
            material.name.clone_from(&id);
        }
        self.records.insert(id, material);
    }
}

/// Reads the materials of a file.
///
/// # Errors
/// [`Error::Read`] when it cannot be read, also where it has more than [`MAX_TABLE_BYTES`]; those of [`read`].
pub fn read_file(path: &Path, units: UnitSystem) -> Result<Imported, Error> {
    let text = input_file::text(path, MAX_TABLE_BYTES);
    let text = text.map_err(|error| input_file::unreadable(path, error))?;
    read(&path.display().to_string(), &text, units)
}

/// Reads the materials of a deck; `file` stands for it in messages.
///
/// # Errors
/// [`Error::Input`] with the place of a card that cannot be read, or whose values no material has; also where a deck has no material
/// that can be read.
pub fn read(file: &str, text: &str, units: UnitSystem) -> Result<Imported, Error> {
    record::read(&deck::Deck::parse(file, text), units)
}
