//! A prediction as one flat record with its test and its citation: what `--json`, CSV and Parquet hold.

use serde::Serialize;

use super::{Group, Grouping, Validation};
use crate::{
    experiments::{Kind, Split},
    material::{Trust, references},
    outcome::Outcome,
};

/// A prediction with its test. The names are stable; a number that does not exist is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PredictionRecord {
    /// Id of the test.
    pub test: String,
    /// Source of the test.
    pub source: String,
    /// Authors and year of the source, where it is a key of the bibliography.
    pub citation: String,
    /// The public place where the test was read.
    pub read_at: String,
    /// Licence of the row.
    pub licence: String,
    /// Kind of test.
    pub kind: Kind,
    /// Whether the prediction is blind.
    pub split: Split,
    /// How far the row can be trusted.
    pub trust: Trust,
    /// Class of the projectile.
    pub projectile: String,
    /// Material record that stood for the projectile.
    pub record: String,
    /// Whether that is the test's main record.
    pub main_record: bool,
    /// Material of the target.
    pub target: String,
    /// Thickness of the target [mm].
    pub thickness_mm: Option<f64>,
    /// Angle to the normal \[deg\].
    pub obliquity_deg: f64,
    /// Temperature of the projectile [K].
    pub temperature_k: Option<f64>,
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Name of the model.
    pub model: &'static str,
    /// What was measured.
    pub measured: f64,
    /// What the model gives.
    pub predicted: Option<f64>,
    /// Unit of both.
    pub unit: &'static str,
    /// Standard deviation of the measured value.
    pub uncertainty: Option<f64>,
    /// `(predicted − measured)/measured`.
    pub relative_error: Option<f64>,
    /// Whether statistics count it, and if not, why.
    pub standing: &'static str,
    /// Why there is no prediction.
    pub reason: Option<String>,
    /// Why the row is suspect.
    pub flag: Option<String>,
    /// Id of the test that it repeats.
    pub duplicate_of: Option<String>,
    /// Regime of the case.
    pub regime: String,
    /// How the test ended in the model.
    pub outcome: Outcome,
    /// Warnings that came with the prediction.
    pub warnings: usize,
}

impl Validation {
    /// All predictions as flat records.
    pub fn records(&self) -> Vec<PredictionRecord> {
        self.predictions
            .iter()
            .map(|prediction| {
                let test = self.test(prediction);
                PredictionRecord {
                    test: test.id.clone(),
                    source: test.source.clone(),
                    citation: references()
                        .get(&test.source)
                        .map_or_else(String::new, |reference| reference.label.clone()),
                    read_at: test.read_at.clone(),
                    licence: test.licence.clone(),
                    kind: test.kind,
                    split: prediction.split,
                    trust: test.trust,
                    projectile: test.projectile_class.clone(),
                    record: prediction.record.clone(),
                    main_record: prediction.main_record,
                    target: test.target.name().to_owned(),
                    thickness_mm: test.target.thickness().map(|thickness| thickness * 1e3),
                    obliquity_deg: test.obliquity_deg,
                    temperature_k: test.temperature,
                    impact_velocity_m_s: test.impact_velocity,
                    model: prediction.model,
                    measured: prediction.measured,
                    predicted: prediction.predicted,
                    unit: test.kind.unit(),
                    uncertainty: test.uncertainty.map(|value| test.kind.shown(value)),
                    relative_error: prediction.relative_error,
                    standing: prediction.standing.name(),
                    reason: prediction.reason.clone(),
                    flag: test.flag.clone(),
                    duplicate_of: test.duplicate_of.clone(),
                    regime: prediction.regime.clone(),
                    outcome: prediction.outcome,
                    warnings: prediction.warnings,
                }
            })
            .collect()
    }

    /// Statistics of all groups of all groupings.
    pub fn all_statistics(&self) -> Vec<Group> {
        Grouping::ALL
            .into_iter()
            .flat_map(|grouping| super::statistics(self, grouping))
            .collect()
    }
}
