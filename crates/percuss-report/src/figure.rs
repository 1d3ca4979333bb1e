//! A figure: an SVG drawing, its name and caption.

use std::{
    path::{Path, PathBuf},
    sync::atomic::{AtomicUsize, Ordering},
};

use rayon::prelude::*;

use crate::{ReportError, replace_file::replace_file};

/// The kind of pictures that pages in Markdown show.
pub const IN_PAGES: &str = if cfg!(feature = "png") { "png" } else { "svg" };

/// A finished drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File stem.
    pub name: String,
    /// One line caption.
    pub title: String,
    /// The drawing.
    pub svg: String,
}

impl Figure {
    /// Writes `NAME.svg` and, in a build with the feature `png`, `NAME.png` to a folder, which is made if it does not exist. Files of these
    /// names are replaced.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Figure`].
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, ReportError> {
        let svg = format!("{}.svg", self.name);
        let written = vec![replace_file(folder, &svg, self.svg.as_bytes())?];
        #[cfg(feature = "png")]
        let written = [written, vec![self.write_for_page(folder)?]].concat();
        Ok(written)
    }

    /// Writes the picture that pages in Markdown show.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Figure`].
    pub fn write_for_page(&self, folder: &Path) -> Result<PathBuf, ReportError> {
        #[cfg(feature = "png")]
        let picture = &self.png()?;
        #[cfg(not(feature = "png"))]
        let picture = self.svg.as_bytes();
        replace_file(folder, &format!("{}.{IN_PAGES}", self.name), picture)
    }
}

/// Writes figures as [`Figure::write`] does, side by side; the files are in the order of the figures. `finished` is told how many are done
/// and the name of the last one.
///
/// # Errors
/// Those of [`Figure::write`]; all other figures are written.
pub fn write_figures(
    folder: &Path,
    figures: &[Figure],
    finished: &(dyn Fn(usize, &str) + Sync),
) -> Result<Vec<PathBuf>, ReportError> {
    let done = AtomicUsize::new(0);
    let written: Vec<_> = figures
        .par_iter()
        .map(|figure| {
            let files = figure.write(folder);
            finished(done.fetch_add(1, Ordering::Relaxed) + 1, &figure.name);
            files
        })
        .collect();
    let files: Result<Vec<_>, _> = written.into_iter().collect();
    Ok(files?.concat())
}
