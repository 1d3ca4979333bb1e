//! Text files of users: reading, and the name of a case in messages.

use std::{fs::File, io::Read, path::Path};

use crate::error::Error;

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
    let fail_with = |reason: String, remedy: String, source| Error::Read {
        path: path.to_path_buf(),
        reason,
        remedy,
        source,
    };
    let fail = |reason: String, source| fail_with(reason, String::new(), source);
    let metadata = std::fs::metadata(path).map_err(|error| {
        let reason = match error.kind() {
            std::io::ErrorKind::NotFound if path.is_symlink() => {
                "it is a symbolic link to a file that does not exist".to_owned()
            }
            std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
            _ => error.to_string(),
        };
        fail(reason, Some(error))
    })?;
    if metadata.is_dir() {
        let scenario = path.join("scenario.toml");
        let remedy = match scenario.is_file() {
            true => format!("did you mean `{}`?", scenario.display()),
            false => String::new(),
        };
        return Err(fail_with("it is a directory".to_owned(), remedy, None));
    }
    if !metadata.is_file() {
        return Err(fail("it is not a regular file".to_owned(), None));
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes))
        .map_err(|error| fail(error.to_string(), Some(error)))?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        let reason = format!(
            "it is larger than {} KiB, the limit for a text file",
            MAX_FILE_BYTES / 1024
        );
        return Err(fail(reason, None));
    }
    String::from_utf8(bytes).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..offset]
            .iter()
            .filter(|&&b| b == b'\n')
            .count();
        let reason = format!("byte {offset} in line {line} is not UTF-8 text");
        fail_with(reason, "save the file as UTF-8".to_owned(), None)
    })
}
