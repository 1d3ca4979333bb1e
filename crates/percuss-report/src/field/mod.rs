//! Fields of a run: files for ParaView, and in two dimensions a picture and an animation.

#[cfg(feature = "png")]
mod animation;
#[cfg(feature = "png")]
mod colors;
#[cfg(feature = "png")]
mod drawing;
mod dump;
#[cfg(feature = "png")]
mod layer;
#[cfg(feature = "png")]
mod picture;
mod quantity;
#[cfg(feature = "png")]
mod raster;
mod selection;
mod series;
#[cfg(feature = "png")]
mod span;
mod vtp;
mod vtp_points;

use std::{
    fs,
    path::{Path, PathBuf},
};

use percuss::{
    Scenario,
    frames::Frame,
    input_file::{self, MAX_OWN_BYTES},
};

use crate::{ReportError, replace_file::replace_file};

#[cfg(feature = "png")]
pub use colors::Colors as FieldColors;
#[cfg(feature = "png")]
pub use drawing::animate;
pub use dump::write_dumps;
pub use quantity::FieldQuantity;
#[cfg(feature = "png")]
pub use raster::View as FieldView;
pub use selection::FrameSelection;
pub use series::FieldSeries;
#[cfg(feature = "png")]
pub use span::{FieldSpan, usual_range};

/// Removes the frames of an earlier run from a folder, whose names have an ending.
fn clear(folder: &Path, ending: &str) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with("frame-") && name.ends_with(ending) {
            // One too many does no harm.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// The bytes of a field file.
fn read(file: &Path) -> Result<Vec<u8>, ReportError> {
    input_file::bytes(file, MAX_OWN_BYTES).map_err(|error| ReportError::Read {
        path: file.to_owned(),
        reason: error.to_string(),
    })
}

/// That a file has no fields.
fn damaged(file: &Path) -> ReportError {
    ReportError::Read {
        path: file.to_owned(),
        reason: "it is damaged or of another program".to_owned(),
    }
}

/// Stem of the names of the field at the end.
const FIELD: &str = "field";

/// The field at the end of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct FinalField {
    file: Vec<u8>,
}

impl FinalField {
    /// That of a frame.
    pub fn of(frame: &Frame<'_>) -> Self {
        Self {
            file: vtp::encode(frame),
        }
    }

    /// Writes it for ParaView as `field.vtp` and, in a build with the feature `png`, a picture of one quantity as `field.png`; returns the
    /// files.
    ///
    /// # Errors
    /// [`ReportError::Write`]; [`ReportError::Figure`].
    pub fn write(
        &self,
        folder: &Path,
        scenario: &Scenario,
        quantity: FieldQuantity,
    ) -> Result<Vec<PathBuf>, ReportError> {
        self.write_as(folder, FIELD, "", scenario, quantity)
    }

    /// The same with another stem of the file names, and a note below the depth in the picture, such as `now, on 6 cells`.
    ///
    /// # Errors
    /// Those of [`Self::write`].
    #[cfg_attr(not(feature = "png"), expect(unused_variables))]
    pub fn write_as(
        &self,
        folder: &Path,
        stem: &str,
        note: &str,
        scenario: &Scenario,
        quantity: FieldQuantity,
    ) -> Result<Vec<PathBuf>, ReportError> {
        let written = vec![replace_file(folder, &format!("{stem}.vtp"), &self.file)?];
        #[cfg(feature = "png")]
        let written = {
            let picture = drawing::write(&written[0], &self.file, note, scenario, quantity)?;
            [written, vec![picture]].concat()
        };
        Ok(written)
    }
}
