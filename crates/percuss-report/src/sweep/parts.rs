//! Folders that hold parts of one sweep.

use std::path::{Path, PathBuf};

use super::{
    block_file,
    folder::{State, manifest_of, state},
    manifest::Manifest,
};
use crate::ReportError;

/// Folders that hold parts of one sweep; a block may be in several of them.
pub(super) struct Parts<'a> {
    folders: &'a [PathBuf],
    pub(super) manifest: Manifest,
}

impl<'a> Parts<'a> {
    /// Reads what the folders hold.
    ///
    /// # Errors
    /// [`ReportError::Sweep`] when there is no folder, or one is of another sweep; [`ReportError::Read`].
    pub(super) fn open(folders: &'a [PathBuf]) -> Result<Self, ReportError> {
        let fail = |path: &Path, reason: String, remedy: &str| ReportError::Sweep {
            path: path.to_owned(),
            reason,
            remedy: remedy.to_owned(),
        };
        let Some(first) = folders.first() else {
            let reason = "no folder is given".to_owned();
            return Err(fail(Path::new(""), reason, "name at least one folder"));
        };
        let manifest = manifest_of(first)?;
        for folder in &folders[1..] {
            if let Some(difference) = manifest.difference(&manifest_of(folder)?) {
                let reason = format!(
                    "it holds another sweep than `{}`: {difference}",
                    first.display()
                );
                return Err(fail(folder, reason, "give folders of one sweep"));
            }
        }
        Ok(Self { folders, manifest })
    }

    /// The file of each block in turn; `None` where it is missing or damaged in all folders.
    pub(super) fn files(&self) -> impl Iterator<Item = Option<PathBuf>> {
        (0..self.manifest.blocks()).map(|block| {
            let whole = |folder: &&PathBuf| state(folder, &self.manifest, block) == State::Done;
            let folder = self.folders.iter().find(whole)?;
            Some(folder.join(block_file(block)))
        })
    }

    /// The folder that is named first.
    pub(super) fn first(&self) -> &Path {
        &self.folders[0]
    }
}
