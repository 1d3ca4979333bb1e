//! Text files of users: reading, and the name of a case in messages.

use std::path::Path;

use crate::{error::Error, input_file};

/// Largest case or material file that is read.
pub const MAX_FILE_BYTES: u64 = 1 << 20;

/// Cases live as `NAME/scenario.toml`; a file with another name is called after itself.
pub(super) fn case_name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let folder = std::path::absolute(path).ok().and_then(|path| {
        let folder = path.parent()?.file_name()?;
        Some(folder.to_string_lossy().into_owned())
    });
    match folder {
        Some(folder) if stem == "scenario" => folder,
        _ => stem.into_owned(),
    }
}

/// Reads a text file of limited size.
///
/// # Errors
/// [`Error::Read`] with the reason, and the remedy where there is one.
pub fn read_text(path: &Path) -> Result<String, Error> {
    input_file::text(path, MAX_FILE_BYTES).map_err(|error| input_file::unreadable(path, error))
}
