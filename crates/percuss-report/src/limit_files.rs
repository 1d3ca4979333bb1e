//! Files of ballistic limits.

use std::path::{Path, PathBuf};

use percuss::{
    axisymmetric::MODEL,
    limit::{
        Bracket, CurvePoint, ExpectedLimitError, LambertJonasFit, LimitOutcome, Limits, ModelLimit,
    },
};

use crate::{
    ReportError,
    column::{self, Column},
    replace_file::replace_file,
};

/// A model with its limit.
struct Row {
    model: &'static str,
    recommended: bool,
    outcome: Option<LimitOutcome>,
    limit: Option<f64>,
    uncertainty: Option<f64>,
    bracket: Option<Bracket>,
    runs: usize,
    warnings: usize,
    reason: Option<String>,
    /// What `axi` does not have.
    entry: Option<ModelLimit>,
}

/// A point of a model's curve.
struct Point {
    model: &'static str,
    point: CurvePoint,
    fit: Option<LambertJonasFit>,
}

/// Writes `limit.csv`, one row per model with the axisymmetric one, and `curve.csv`, one row per residual velocity, to a folder, which is made if it does not exist.
/// Files of these names are replaced. What a model does not give is empty.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Table`].
pub fn write_limits(folder: &Path, limits: &Limits) -> Result<Vec<PathBuf>, ReportError> {
    limit_files(limits)?
        .into_iter()
        .map(|(name, content)| replace_file(folder, name, &content))
        .collect()
}

/// The files that [`write_limits`] writes: name and content of each.
///
/// # Errors
/// [`ReportError::Table`].
pub fn limit_files(limits: &Limits) -> Result<[(&'static str, Vec<u8>); 2], ReportError> {
    let points: Vec<Point> = limits
        .results
        .iter()
        .flat_map(|limit| {
            limit.curve.iter().map(|point| Point {
                model: limit.model,
                point: *point,
                fit: limit.fit,
            })
        })
        .collect();
    let (models, curve) = ("limit.csv", "curve.csv");
    Ok([
        (
            models,
            column::csv(models, &model_columns(), &rows(limits))?,
        ),
        (curve, column::csv(curve, &curve_columns(), &points)?),
    ])
}

/// The rows of the models, and that of the axisymmetric limit: its bracket is that of the finest mesh.
fn rows(limits: &Limits) -> Vec<Row> {
    let own = limits.results.iter().map(|entry| Row {
        model: entry.model,
        recommended: limits.is_recommended(entry.model),
        outcome: Some(entry.outcome),
        limit: entry.ballistic_limit_m_s,
        uncertainty: None,
        bracket: entry.bracket,
        runs: entry.runs,
        warnings: entry.warnings.len(),
        reason: entry.reason.clone(),
        entry: Some(entry.clone()),
    });
    let axisymmetric = limits.axisymmetric.iter().map(|limit| Row {
        model: MODEL,
        recommended: limits.is_recommended(MODEL),
        outcome: limit.meshes.last().map(|mesh| mesh.outcome),
        limit: limit.ballistic_limit_m_s,
        uncertainty: limit.uncertainty_m_s,
        bracket: limit.meshes.last().and_then(|mesh| mesh.bracket),
        runs: limit.meshes.iter().map(|mesh| mesh.runs).sum(),
        warnings: limit.warnings.len(),
        reason: limit.reason.clone(),
        entry: None,
    });
    own.chain(axisymmetric).collect()
}

fn model_columns() -> Vec<Column<Row>> {
    let of = |name: &str, of: fn(&ModelLimit) -> Option<f64>| {
        Column::optional(name, move |row: &Row| row.entry.as_ref().and_then(of))
    };
    let fit = |name: &str, of: fn(&LambertJonasFit) -> f64| {
        Column::optional(name, move |row: &Row| {
            row.entry.as_ref()?.fit.as_ref().map(of)
        })
    };
    let expected = |name: &str, of: fn(&ExpectedLimitError) -> f64| {
        Column::optional(name, move |row: &Row| {
            row.entry.as_ref()?.expected_error.as_ref().map(of)
        })
    };
    vec![
        Column::text("model", |row: &Row| row.model.to_owned()),
        Column::text("outcome", |row: &Row| {
            row.outcome.map_or("", LimitOutcome::describe).to_owned()
        }),
        Column::optional("ballistic_limit_m_s", |row: &Row| row.limit),
        Column::optional("uncertainty_m_s", |row: &Row| row.uncertainty),
        Column::text("recommended", |row: &Row| row.recommended.to_string()),
        of("stated_limit_m_s", |l| l.stated_limit_m_s),
        of("input_limit_m_s", |l| {
            l.input_limit.map(|input| input.ballistic_limit_m_s)
        }),
        expected("expected_error_median", |e| e.errors.median),
        expected("expected_error_low", |e| e.errors.low),
        expected("expected_error_high", |e| e.errors.high),
        Column::optional("stopped_m_s", |row: &Row| {
            row.bracket.map(|bracket| bracket.stopped_m_s)
        }),
        Column::optional("perforated_m_s", |row: &Row| {
            row.bracket.map(|bracket| bracket.perforated_m_s)
        }),
        Column::integer("runs", |row: &Row| row.runs as i64),
        fit("fitted_a", |fit| fit.a),
        fit("fitted_p", |fit| fit.p),
        fit("fitted_limit_m_s", |fit| fit.ballistic_limit_m_s),
        fit("fit_rms_m_s", |fit| fit.rms_m_s),
        Column::integer("warnings", |row: &Row| row.warnings as i64),
        Column::text("reason", |row: &Row| row.reason.clone().unwrap_or_default()),
    ]
}

fn curve_columns() -> Vec<Column<Point>> {
    vec![
        Column::text("model", |p: &Point| p.model.to_owned()),
        Column::float("impact_velocity_m_s", |p: &Point| {
            p.point.impact_velocity_m_s
        }),
        Column::float("residual_velocity_m_s", |p: &Point| {
            p.point.residual_velocity_m_s
        }),
        Column::optional("fitted_residual_velocity_m_s", |p: &Point| {
            p.fit.map(|fit| fit.at(p.point.impact_velocity_m_s))
        }),
    ]
}

#[cfg(test)]
mod tests {
    use percuss::{
        axisymmetric::ReferenceMeshes,
        compare::Choice,
        limit::{AxisymmetricLimit, LimitOnMesh},
    };

    use super::*;
    use crate::limit_figure::tests::limits_by;

    /// The limit to use is in the table, whichever model it is of.
    #[test]
    fn the_table_has_the_axisymmetric_limit() {
        let (_, mut found) = limits_by(&["plugging"]);
        let mesh = |cells_per_radius: u32| LimitOnMesh {
            cells_per_radius,
            outcome: LimitOutcome::Found,
            ballistic_limit_m_s: Some(210.5),
            bracket: Some(Bracket {
                stopped_m_s: 210.0,
                perforated_m_s: 211.0,
            }),
            runs: 9,
        };
        found.axisymmetric = Some(AxisymmetricLimit {
            reference: ReferenceMeshes::Standard,
            reason: None,
            ballistic_limit_m_s: Some(210.25),
            uncertainty_m_s: Some(15.5),
            order: None,
            meshes: vec![mesh(4), mesh(6)],
            warnings: vec!["one".to_owned()],
        });
        found.recommended = vec![Choice {
            model: MODEL,
            because: "it is a test",
        }];
        let [(_, table), _] = limit_files(&found).unwrap();
        let table = String::from_utf8(table).unwrap();
        let rows: Vec<&str> = table.lines().collect();
        assert!(
            rows[0].starts_with("model,outcome,ballistic_limit_m_s,uncertainty_m_s,recommended,")
        );
        assert!(
            rows[1].starts_with("plugging,found,") && rows[1].contains(",,false,"),
            "{table}"
        );
        assert_eq!(
            rows[2],
            "axi,found,210.25,15.5,true,,,,,,210.0,211.0,18,,,,,1,"
        );
    }
}
