//! Output folder of a calibration.

use std::path::PathBuf;

use percuss::calibrate::Calibrated;

use crate::{failure::Failure, output, run_folder::RunFolder};

/// Writes numbers, materials and figures.
pub(super) fn write(found: &Calibrated, mut folder: RunFolder) -> Result<Vec<PathBuf>, Failure> {
    folder.put("calibration.json", output::json(found)?.as_bytes())?;
    folder.add(percuss_report::calibration::write(
        folder.path(),
        &found.calibration,
    )?);
    if let Some(text) = found.toml() {
        folder.put("material.toml", text.as_bytes())?;
    }
    folder.add_figures(&percuss_report::calibration::figures(&found.calibration))?;
    Ok(folder.written())
}
