//! The numbers of a validation as CSV and Parquet.

use percuss::validate::{Group, PredictionRecord, Validation};

use crate::{
    ReportError,
    column::{self, Column, word},
};

/// Names and contents of the files.
pub(super) fn files(validation: &Validation) -> Result<Vec<(&'static str, Vec<u8>)>, ReportError> {
    let names = ["predictions.csv", "predictions.parquet"];
    let mut files = column::files(names, &prediction_columns(), &validation.records())?;
    let names = ["statistics.csv", "statistics.parquet"];
    let groups = validation.all_statistics();
    files.extend(column::files(names, &group_columns(), &groups)?);
    Ok(files)
}

fn prediction_columns() -> Vec<Column<PredictionRecord>> {
    type Row = PredictionRecord;
    let or_empty = |text: &Option<String>| text.clone().unwrap_or_default();
    vec![
        Column::text("test", |p: &Row| p.test.clone()),
        Column::text("source", |p: &Row| p.source.clone()),
        Column::text("citation", |p: &Row| p.citation.clone()),
        Column::text("read_at", |p: &Row| p.read_at.clone()),
        Column::text("licence", |p: &Row| p.licence.clone()),
        Column::text("kind", |p: &Row| p.kind.name().to_owned()),
        Column::text("split", |p: &Row| p.split.name().to_owned()),
        Column::text("trust", |p: &Row| p.trust.letter().to_owned()),
        Column::text("projectile", |p: &Row| p.projectile.clone()),
        Column::text("record", |p: &Row| p.record.clone()),
        Column::integer("main_record", |p: &Row| i64::from(p.main_record)),
        Column::text("target", |p: &Row| p.target.clone()),
        Column::optional("thickness_mm", |p: &Row| p.thickness_mm),
        Column::float("obliquity_deg", |p: &Row| p.obliquity_deg),
        Column::optional("temperature_k", |p: &Row| p.temperature_k),
        Column::float("impact_velocity_m_s", |p: &Row| p.impact_velocity_m_s),
        Column::text("model", |p: &Row| p.model.to_owned()),
        Column::float("measured", |p: &Row| p.measured),
        Column::optional("predicted", |p: &Row| p.predicted),
        Column::text("unit", |p: &Row| p.unit.to_owned()),
        Column::optional("uncertainty", |p: &Row| p.uncertainty),
        Column::optional("relative_error", |p: &Row| p.relative_error),
        Column::text("standing", |p: &Row| p.standing.to_owned()),
        Column::text("reason", move |p: &Row| or_empty(&p.reason)),
        Column::text("flag", move |p: &Row| or_empty(&p.flag)),
        Column::text("duplicate_of", move |p: &Row| or_empty(&p.duplicate_of)),
        Column::text("regime", |p: &Row| p.regime.clone()),
        Column::text("outcome", |p: &Row| word(&p.outcome)),
        Column::integer("warnings", |p: &Row| p.warnings as i64),
    ]
}

fn group_columns() -> Vec<Column<Group>> {
    vec![
        Column::text("model", |g: &Group| g.model.to_owned()),
        Column::text("kind", |g: &Group| g.kind.name().to_owned()),
        Column::text("grouping", |g: &Group| g.grouping.name().to_owned()),
        Column::text("value", |g: &Group| g.value.clone()),
        Column::integer("count", |g: &Group| g.errors.count as i64),
        Column::float("bias", |g: &Group| g.errors.bias),
        Column::float("rms", |g: &Group| g.errors.rms),
        Column::float("median_absolute", |g: &Group| g.errors.median_absolute),
        Column::float("worst", |g: &Group| g.errors.worst),
        Column::text("worst_test", |g: &Group| g.errors.worst_id.clone()),
    ]
}
