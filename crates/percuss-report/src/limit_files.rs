//! Files of ballistic limits.

use std::path::{Path, PathBuf};

use percuss::limit::{CurvePoint, ExpectedLimitError, LambertJonasFit, Limits, ModelLimit};

use crate::{
    ReportError,
    column::{self, Column},
    replace_file::replace_file,
};

/// A point of a model's curve.
struct Point {
    model: &'static str,
    point: CurvePoint,
    fit: Option<LambertJonasFit>,
}

/// Writes `limit.csv`, one row per model, and `curve.csv`, one row per residual velocity, to a folder, which is made if it does not exist.
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
            column::csv(models, &model_columns(), &limits.results)?,
        ),
        (curve, column::csv(curve, &curve_columns(), &points)?),
    ])
}

fn model_columns() -> Vec<Column<ModelLimit>> {
    let fit = |name: &str, of: fn(&LambertJonasFit) -> f64| {
        Column::optional(name, move |l: &ModelLimit| l.fit.as_ref().map(of))
    };
    let expected = |name: &str, of: fn(&ExpectedLimitError) -> f64| {
        Column::optional(name, move |l: &ModelLimit| {
            l.expected_error.as_ref().map(of)
        })
    };
    vec![
        Column::text("model", |l: &ModelLimit| l.model.to_owned()),
        Column::text("outcome", |l: &ModelLimit| l.outcome.describe().to_owned()),
        Column::optional("ballistic_limit_m_s", |l: &ModelLimit| {
            l.ballistic_limit_m_s
        }),
        Column::optional("stated_limit_m_s", |l: &ModelLimit| l.stated_limit_m_s),
        Column::optional("input_limit_m_s", |l: &ModelLimit| {
            l.input_limit.map(|input| input.ballistic_limit_m_s)
        }),
        expected("expected_error_median", |e| e.errors.median),
        expected("expected_error_low", |e| e.errors.low),
        expected("expected_error_high", |e| e.errors.high),
        Column::optional("stopped_m_s", |l: &ModelLimit| {
            l.bracket.map(|bracket| bracket.stopped_m_s)
        }),
        Column::optional("perforated_m_s", |l: &ModelLimit| {
            l.bracket.map(|bracket| bracket.perforated_m_s)
        }),
        Column::integer("runs", |l: &ModelLimit| l.runs as i64),
        fit("fitted_a", |fit| fit.a),
        fit("fitted_p", |fit| fit.p),
        fit("fitted_limit_m_s", |fit| fit.ballistic_limit_m_s),
        fit("fit_rms_m_s", |fit| fit.rms_m_s),
        Column::integer("warnings", |l: &ModelLimit| l.warnings.len() as i64),
        Column::text("reason", |l: &ModelLimit| {
            l.reason.clone().unwrap_or_default()
        }),
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
