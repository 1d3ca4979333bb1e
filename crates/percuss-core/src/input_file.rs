//! Input files: one way to open whatever a user names or a folder holds.
//!
//! Only regular files of limited size are opened, or links to them: a pipe would block, a device would never end.

#[cfg(test)]
#[path = "input_file_tests.rs"]
mod tests;

use std::{
    fs::{File, OpenOptions},
    io::{self, ErrorKind, Read},
    path::Path,
};

use crate::error::Error;

/// Largest table of tests or reference results, and largest deck of another program, that is read: 64 MiB.
pub const MAX_TABLE_BYTES: u64 = 1 << 26;
/// Largest file of the program's own that is opened, not read as a whole: 16 GiB.
pub const MAX_OWN_BYTES: u64 = 1 << 34;

/// Largest block of rows of a sweep: 256 MiB.
pub const MAX_BLOCK_BYTES: u64 = 1 << 28;

/// Opens a regular file of at most `limit` bytes.
///
/// # Errors
/// Those of the system; [`ErrorKind::InvalidInput`] for anything but a regular file; [`ErrorKind::FileTooLarge`].
pub fn open(path: &Path, limit: u64) -> io::Result<File> {
    regular(&std::fs::metadata(path)?, limit)?;
    let file = options().open(path)?;
    // Another file may have taken its place.
    regular(&file.metadata()?, limit)?;
    Ok(file)
}

/// Options that read and never wait: a pipe may take the place of the file after the first check, and some files of the system
/// have no end.
fn options() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(rustix::fs::OFlags::NONBLOCK.bits().cast_signed());
    }
    options
}

fn regular(metadata: &std::fs::Metadata, limit: u64) -> io::Result<()> {
    if metadata.is_dir() {
        return Err(io::Error::new(ErrorKind::IsADirectory, "it is a directory"));
    }
    if !metadata.is_file() {
        let reason = "it is not a regular file";
        return Err(io::Error::new(ErrorKind::InvalidInput, reason));
    }
    if metadata.len() > limit {
        return Err(too_large(limit));
    }
    Ok(())
}

fn too_large(limit: u64) -> io::Error {
    let reason = format!(
        "it is larger than {}, the limit for such a file",
        size(limit)
    );
    io::Error::new(ErrorKind::FileTooLarge, reason)
}

/// A size in bytes as `1 MiB` or `1.5 GiB`.
pub fn size(bytes: u64) -> String {
    let units = [(1_u64 << 30, "GiB"), (1 << 20, "MiB"), (1 << 10, "KiB")];
    let found = units.into_iter().find(|(unit, _)| bytes >= *unit);
    let (unit, name) = found.unwrap_or((1, "bytes"));
    let number = bytes as f64 / unit as f64;
    let rounded = format!("{number:.1}");
    format!("{} {name}", rounded.strip_suffix(".0").unwrap_or(&rounded))
}

/// Bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// As [`open`].
pub fn bytes(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // It may grow while it is read.
    let read = open(path, limit)?
        .take(limit.saturating_add(1))
        .read_to_end(&mut bytes)?;
    match read as u64 > limit {
        true => Err(too_large(limit)),
        false => Ok(bytes),
    }
}

/// Bytes of a regular file of at most `limit` bytes; its first ones alone where they are not `start`.
///
/// # Errors
/// As [`open`].
pub fn bytes_after(start: &[u8], path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let file = open(path, limit)?;
    let mut bytes = Vec::new();
    (&file).take(start.len() as u64).read_to_end(&mut bytes)?;
    if bytes == start {
        let rest = limit.saturating_add(1).saturating_sub(bytes.len() as u64);
        (&file).take(rest).read_to_end(&mut bytes)?;
    }
    match bytes.len() as u64 > limit {
        true => Err(too_large(limit)),
        false => Ok(bytes),
    }
}

/// UTF-8 text of a regular file of at most `limit` bytes.
///
/// # Errors
/// As [`open`]; [`ErrorKind::InvalidData`] with the place of a byte that is no text.
pub fn text(path: &Path, limit: u64) -> io::Result<String> {
    String::from_utf8(bytes(path, limit)?).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let before = &error.as_bytes()[..offset];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        let reason = format!("byte {offset} in line {line} is not UTF-8 text");
        io::Error::new(ErrorKind::InvalidData, reason)
    })
}

/// The error for a file that cannot be read: its reason, and the remedy where there is one.
pub fn unreadable(path: &Path, error: io::Error) -> Error {
    let mut remedy = String::new();
    let reason = match error.kind() {
        ErrorKind::NotFound if path.is_symlink() => {
            "it is a symbolic link to a file that does not exist".to_owned()
        }
        ErrorKind::NotFound => "there is no such file".to_owned(),
        ErrorKind::IsADirectory => {
            let scenario = path.join("scenario.toml");
            if scenario.is_file() {
                remedy = format!("did you mean `{}`?", scenario.display());
            }
            "it is a directory".to_owned()
        }
        ErrorKind::InvalidData => {
            remedy = "save the file as UTF-8".to_owned();
            error.to_string()
        }
        _ => error.to_string(),
    };
    Error::Read {
        path: path.to_path_buf(),
        reason,
        remedy,
        source: Some(error),
    }
}
