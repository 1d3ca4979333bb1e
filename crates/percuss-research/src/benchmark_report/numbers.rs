//! Numbers of the benchmark report as CSV and Parquet.

use percuss::model_error::ErrorRecord;
use percuss_report::{
    ReportError,
    column::{self, Column},
};

use super::BenchmarkResults;
use crate::{
    benchmark::{self, CheckedReference, Group, Grouping},
    paper_case::variants::VariantResult,
};

/// Names and contents of the files.
pub(super) fn files(
    compared: &BenchmarkResults,
) -> Result<Vec<(&'static str, Vec<u8>)>, ReportError> {
    let verdicts = benchmark::to_csv(&compared.verdicts).map_err(|source| ReportError::Table {
        table: "verdicts.csv".to_owned(),
        source: source.into(),
    })?;
    let groups: Vec<Group> = Grouping::ALL
        .iter()
        .flat_map(|grouping| benchmark::statistics(&compared.verdicts, *grouping))
        .collect();
    let mut files = vec![("verdicts.csv", verdicts)];
    files.extend(column::parquet(
        "verdicts.parquet",
        &verdict_columns(),
        &compared.verdicts,
    )?);
    let names = ["statistics.csv", "statistics.parquet"];
    files.extend(column::files(names, &group_columns(), &groups)?);
    let names = ["variants.csv", "variants.parquet"];
    files.extend(column::files(names, &line_columns(), &compared.variants)?);
    let names = ["references.csv", "references.parquet"];
    files.extend(column::files(
        names,
        &reference_columns(),
        &compared.references,
    )?);
    Ok(files)
}

fn verdict_columns() -> Vec<Column<ErrorRecord>> {
    type Row = ErrorRecord;
    vec![
        Column::text("candidate", |v: &Row| v.candidate.clone()),
        Column::text("projectile", |v: &Row| v.projectile.clone()),
        Column::text("target", |v: &Row| v.target.clone()),
        Column::float("length_to_diameter", |v: &Row| v.length_to_diameter),
        Column::float("impact_velocity_m_s", |v: &Row| v.impact_velocity_m_s),
        Column::text("regime", |v: &Row| v.regime.describe().to_owned()),
        Column::float("depth_of_penetration_mm", |v: &Row| {
            v.depth_of_penetration_mm
        }),
        Column::float("reference_depth_mm", |v: &Row| v.reference_depth_mm),
        Column::float("reference_uncertainty_mm", |v: &Row| {
            v.reference_uncertainty_mm
        }),
        Column::float("relative_error", Row::error),
    ]
}

fn reference_columns() -> Vec<Column<CheckedReference>> {
    type Row = CheckedReference;
    vec![
        Column::text("projectile", |r: &Row| r.case.projectile.clone()),
        Column::text("target", |r: &Row| r.case.target.clone()),
        Column::float("length_to_diameter", |r: &Row| r.case.length_to_diameter),
        Column::float("impact_velocity_m_s", |r: &Row| r.case.speed),
        Column::integer("meshes", |r: &Row| r.meshes.len() as i64),
        Column::optional("finest_cells_per_radius", |r: &Row| {
            r.meshes.last().map(|mesh| mesh.cells)
        }),
        Column::optional("finest_depth_mm", |r: &Row| {
            r.meshes.last().map(|mesh| mesh.value)
        }),
        Column::optional("reference_depth_mm", |r: &Row| {
            r.estimate.ok().map(|estimate| estimate.depth_mm)
        }),
        Column::optional("reference_uncertainty_mm", |r: &Row| {
            r.estimate.ok().map(|estimate| estimate.uncertainty_mm)
        }),
        Column::text("refused", |r: &Row| {
            r.estimate
                .err()
                .map_or_else(String::new, |refusal| refusal.describe())
        }),
    ]
}

fn group_columns() -> Vec<Column<Group>> {
    vec![
        Column::text("candidate", |g: &Group| g.candidate.to_owned()),
        Column::text("grouping", |g: &Group| g.grouping.describe().to_owned()),
        Column::text("value", |g: &Group| g.value.clone()),
        Column::integer("count", |g: &Group| g.errors.count as i64),
        Column::float("median", |g: &Group| g.errors.median),
        Column::float("low", |g: &Group| g.errors.low),
        Column::float("high", |g: &Group| g.errors.high),
        Column::float("median_absolute", |g: &Group| g.errors.median_absolute),
        Column::float("within_25_percent", |g: &Group| g.errors.within_25_percent),
    ]
}

fn line_columns() -> Vec<Column<VariantResult>> {
    vec![
        Column::float("impact_velocity_m_s", |l: &VariantResult| {
            l.impact_velocity_m_s
        }),
        Column::text("variant", |l: &VariantResult| l.variant.to_owned()),
        Column::text("change", |l: &VariantResult| l.change.to_owned()),
        Column::float("depth_of_penetration_mm", |l: &VariantResult| {
            l.depth_of_penetration_mm
        }),
        Column::optional("error", |l: &VariantResult| l.error),
    ]
}
