//! Atomic replacement of files.

use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
    process,
    sync::atomic::{AtomicU64, Ordering},
};

use crate::{ReportError, column::File};

/// Writes a file in a folder, which is made if need be, under a temporary name and then renames it.
///
/// # Errors
/// [`ReportError::Write`].
pub fn replace_file(folder: &Path, name: &str, content: &[u8]) -> Result<PathBuf, ReportError> {
    fs::create_dir_all(folder).map_err(|source| ReportError::Write {
        path: folder.to_owned(),
        source,
    })?;
    replace(folder, name, |file| file.write_all(content))
}

/// Writes files in a folder, which is made if need be, by their names and contents.
///
/// # Errors
/// [`ReportError::Write`].
pub fn replace_files(folder: &Path, files: Vec<File>) -> Result<Vec<PathBuf>, ReportError> {
    let files = files.into_iter();
    files
        .map(|(name, content)| replace_file(folder, name, &content))
        .collect()
}

/// Writes a file as [`replace_file`] does in a folder that is there, and it is on the disk when this returns: it outlives a loss of power.
///
/// A folder that someone removed is not made again: it would lack whatever else it held.
///
/// # Errors
/// [`ReportError::Write`].
pub fn replace_file_durably(
    folder: &Path,
    name: &str,
    write: impl FnOnce(&mut fs::File) -> io::Result<()>,
) -> Result<PathBuf, ReportError> {
    let path = replace(folder, name, write)?;
    sync_folder(folder).map_err(|source| ReportError::Write {
        path: folder.to_owned(),
        source,
    })?;
    Ok(path)
}

/// Puts the names of a folder's files on the disk.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    fs::File::open(folder)?.sync_all()
}

/// Elsewhere a folder cannot be opened as a file, and renaming is as durable as it gets.
#[cfg(not(unix))]
fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

fn replace(
    folder: &Path,
    name: &str,
    write: impl FnOnce(&mut fs::File) -> io::Result<()>,
) -> Result<PathBuf, ReportError> {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    let path = folder.join(name);
    let number = COUNTER.fetch_add(1, Ordering::Relaxed);
    let temporary = folder.join(format!(".{name}.{}-{number}.tmp", process::id()));
    // Its content is on the disk before its name: a loss of power leaves the former file or this one.
    fs::File::create(&temporary)
        .and_then(|mut file| {
            write(&mut file)?;
            file.sync_all()
        })
        .and_then(|()| fs::rename(&temporary, &path))
        .map_err(|source| {
            // Nothing more can be done when the temporary file cannot be removed either.
            let _ = fs::remove_file(&temporary);
            ReportError::Write {
                path: path.clone(),
                source,
            }
        })?;
    Ok(path)
}
