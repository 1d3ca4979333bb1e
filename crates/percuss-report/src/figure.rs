//! A figure: an SVG drawing, its name and caption.

use std::{
    borrow::Cow,
    path::{Path, PathBuf},
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
};

use rayon::prelude::*;

use crate::{ReportError, replace_file::replace_file};

/// The kind of pictures that pages in Markdown show.
pub const IN_PAGES: &str = if cfg!(feature = "png") { "png" } else { "svg" };

/// Kind of file of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FigureFormat {
    /// Lines, areas and texts, for pages.
    Svg,
    /// Pixels: two per SVG user unit, 240 per inch.
    #[cfg(feature = "png")]
    Png,
    /// Lines, areas and outlines of texts, for print: 0.6 points per SVG user unit.
    #[cfg(feature = "png")]
    Pdf,
}

impl FigureFormat {
    /// All formats of this build.
    pub const ALL: &[Self] = &[
        Self::Svg,
        #[cfg(feature = "png")]
        Self::Png,
        #[cfg(feature = "png")]
        Self::Pdf,
    ];

    /// What is written where nothing else is asked for.
    pub const DEFAULT: &[Self] = &[
        Self::Svg,
        #[cfg(feature = "png")]
        Self::Png,
    ];

    /// End of the file's name.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            #[cfg(feature = "png")]
            Self::Png => "png",
            #[cfg(feature = "png")]
            Self::Pdf => "pdf",
        }
    }
}

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
    /// Writes files of these formats, such as `NAME.svg`, to a folder, which is made if it does not exist. Files of these names are replaced.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Figure`].
    pub fn write(
        &self,
        folder: &Path,
        formats: &[FigureFormat],
    ) -> Result<Vec<PathBuf>, ReportError> {
        self.write_from(folder, formats, &SpareMemory::default())
    }

    /// The same in memory of other figures.
    fn write_from(
        &self,
        folder: &Path,
        formats: &[FigureFormat],
        spare: &SpareMemory,
    ) -> Result<Vec<PathBuf>, ReportError> {
        let files = formats.iter().map(|format| {
            let name = format!("{}.{}", self.name, format.suffix());
            replace_file(folder, &name, &self.file(*format, spare)?)
        });
        files.collect()
    }

    /// Content of a file.
    #[cfg_attr(not(feature = "png"), allow(unused_variables))]
    fn file(
        &self,
        format: FigureFormat,
        spare: &SpareMemory,
    ) -> Result<Cow<'_, [u8]>, ReportError> {
        Ok(match format {
            FigureFormat::Svg => Cow::Borrowed(self.svg.as_bytes()),
            #[cfg(feature = "png")]
            FigureFormat::Png => Cow::Owned(self.png_from(spare)?),
            #[cfg(feature = "png")]
            FigureFormat::Pdf => Cow::Owned(self.pdf()?),
        })
    }

    /// Writes the picture that pages in Markdown show.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Figure`].
    pub fn write_for_page(&self, folder: &Path) -> Result<PathBuf, ReportError> {
        #[cfg(feature = "png")]
        let format = FigureFormat::Png;
        #[cfg(not(feature = "png"))]
        let format = FigureFormat::Svg;
        replace_file(
            folder,
            &format!("{}.{IN_PAGES}", self.name),
            &self.file(format, &SpareMemory::default())?,
        )
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
    formats: &[FigureFormat],
    finished: &(dyn Fn(usize, &str) + Sync),
) -> Result<Vec<PathBuf>, ReportError> {
    let (done, spare) = (AtomicUsize::new(0), SpareMemory::default());
    let written: Vec<_> = figures
        .par_iter()
        .map(|figure| {
            let files = figure.write_from(folder, formats, &spare);
            finished(done.fetch_add(1, Ordering::Relaxed) + 1, &figure.name);
            files
        })
        .collect();
    let files: Result<Vec<_>, _> = written.into_iter().collect();
    Ok(files?.concat())
}

/// Memory of pictures that are complete, for the next ones.
#[derive(Debug, Default)]
pub(crate) struct SpareMemory(Mutex<Vec<Vec<u8>>>);

impl SpareMemory {
    /// Memory of a number of bytes, of any content.
    pub(crate) fn take(&self, bytes: usize) -> Vec<u8> {
        let spare = self.0.lock().ok().and_then(|mut all| all.pop());
        match spare {
            Some(mut spare) => {
                spare.resize(bytes, 0);
                spare
            }
            None => vec![0; bytes],
        }
    }

    /// Gives memory back.
    pub(crate) fn give(&self, memory: Vec<u8>) {
        if let Ok(mut all) = self.0.lock() {
            all.push(memory);
        }
    }
}
