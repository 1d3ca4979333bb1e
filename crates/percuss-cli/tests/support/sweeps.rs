//! Folders of sweeps.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Child,
};

use tempfile::TempDir;

use super::{Said, percuss};

pub fn sweep(folder: &TempDir, arguments: &[&str]) -> Said {
    percuss(folder.path(), [&["sweep"], arguments].concat())
}

#[track_caller]
pub fn ok(folder: &TempDir, arguments: &[&str]) -> String {
    sweep(folder, arguments).ok()
}

/// Starts a sweep and goes on.
pub fn spawn(folder: &TempDir, arguments: &[&str]) -> Child {
    super::spawn(folder.path(), &[&["sweep"], arguments].concat())
}

/// The merged rows of folders.
pub fn merged(folder: &TempDir, parts: &[&str]) -> Vec<u8> {
    let arguments = [&["merge"], parts, &["--out", "rows.parquet"]].concat();
    ok(folder, &arguments);
    fs::read(folder.path().join("rows.parquet")).unwrap()
}

/// A block of a sweep that was written to `out`.
pub fn block(folder: &TempDir, out: &str, number: u32) -> PathBuf {
    let name = format!("{out}/block-{number:06}.parquet");
    folder.path().join(name)
}

/// How many blocks a folder holds; none where there is no folder yet.
pub fn count_blocks(path: &Path) -> usize {
    let Ok(entries) = fs::read_dir(path) else {
        return 0;
    };
    let names = entries.map(|entry| entry.unwrap().file_name());
    names
        .filter(|name| name.to_string_lossy().starts_with("block-"))
        .count()
}
