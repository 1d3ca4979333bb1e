//! Results of a calibration.

use serde::{Serialize, Serializer};

use super::{
    CalibratedRecord, Calibration, Observer, Problem, Settings, problem::refuse, record::records,
    run,
};
use crate::Error;

/// A calibration with the materials that come of it.
#[derive(Debug, Serialize)]
pub struct Calibrated {
    /// The calibration.
    #[serde(flatten)]
    pub calibration: Calibration,
    /// The materials, by their ids.
    #[serde(rename = "materials", serialize_with = "as_table")]
    pub records: Vec<CalibratedRecord>,
}

fn as_table<S: Serializer>(records: &[CalibratedRecord], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(records.iter().map(|record| (&record.id, &record.material)))
}

impl Calibrated {
    /// Solves a problem and makes its materials; `name` is as in [`records`].
    ///
    /// # Errors
    /// Those of [`run`], and [`Error::Calibration`] when the best values make no material.
    pub fn of(
        problem: &Problem,
        settings: &Settings,
        name: Option<&str>,
        observer: Observer<'_>,
    ) -> Result<Self, Error> {
        let calibration = run(problem, settings, observer)?;
        let records = records(problem, &calibration, name).map_err(|reason| {
            refuse(
                format!("the best values make no material: {reason}"),
                "narrow the ranges".to_owned(),
            )
        })?;
        Ok(Self {
            calibration,
            records,
        })
    }

    /// The materials as a file that cases and commands take; `None` where no constant of a material was fitted.
    pub fn toml(&self) -> Option<String> {
        let text: String = self.records.iter().map(CalibratedRecord::toml).collect();
        (!self.records.is_empty()).then_some(text)
    }
}
