//! Files that are complete or absent: a reader never sees half of one.

use std::{
    fs,
    path::{Path, PathBuf},
    process,
    sync::atomic::{AtomicU64, Ordering},
};

use crate::ReportError;

/// Writes a file in a folder, which is made if need be, under a temporary name and then renames it.
pub(crate) fn replace_file(
    folder: &Path,
    name: &str,
    content: &[u8],
) -> Result<PathBuf, ReportError> {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    fs::create_dir_all(folder).map_err(|source| ReportError::Write {
        path: folder.to_owned(),
        source,
    })?;
    let path = folder.join(name);
    let number = COUNTER.fetch_add(1, Ordering::Relaxed);
    let temporary = folder.join(format!(".{name}.{}-{number}.tmp", process::id()));
    fs::write(&temporary, content)
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
