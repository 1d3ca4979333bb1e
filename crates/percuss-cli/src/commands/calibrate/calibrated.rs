//! What comes of a calibration.

use std::path::PathBuf;

use percuss::calibrate::{Calibration, Record};
use serde::{Serialize, Serializer};

use crate::{failure::Failure, run_folder::RunFolder, terminal};

/// A calibration with the materials that come of it.
#[derive(Debug, Serialize)]
pub struct Calibrated {
    /// The calibration.
    #[serde(flatten)]
    pub calibration: Calibration,
    /// The materials, by their ids.
    #[serde(rename = "materials", serialize_with = "as_table")]
    pub records: Vec<Record>,
}

fn as_table<S: Serializer>(records: &[Record], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(records.iter().map(|record| (&record.id, &record.material)))
}

impl Calibrated {
    /// Writes numbers, materials and figures.
    pub(super) fn write(&self, mut folder: RunFolder) -> Result<Vec<PathBuf>, Failure> {
        folder.put("calibration.json", terminal::json(self)?.as_bytes())?;
        folder.add(percuss_report::calibration::write(
            folder.path(),
            &self.calibration,
        )?);
        if !self.records.is_empty() {
            let text: String = self.records.iter().map(Record::toml).collect();
            folder.put("material.toml", text.as_bytes())?;
        }
        for figure in percuss_report::calibration::figures(&self.calibration) {
            folder.add(figure.write(folder.path())?);
        }
        Ok(folder.written())
    }
}
