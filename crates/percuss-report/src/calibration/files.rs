//! Tables of a calibration.

use std::path::{Path, PathBuf};

use percuss::calibrate::{Calibration, CurvePoints, CurvePrediction, ParameterRecord, Prediction};

use crate::{
    ReportError,
    column::{self, Column},
    replace_file::replace_files,
};

/// A state of the sample with the place that it was drawn at.
struct State {
    ensemble: i64,
    step: i64,
    walker: i64,
    values: Vec<f64>,
}

/// A point of a curve.
struct CurvePoint<'a> {
    curve: &'a CurvePrediction,
    index: usize,
}

/// Writes `parameters.csv`, `predictions.csv`, `curves.csv` where there are any and, of a sample, `sample.parquet`.
///
/// # Errors
/// [`ReportError::Write`]; [`ReportError::Table`].
pub fn write(folder: &Path, calibration: &Calibration) -> Result<Vec<PathBuf>, ReportError> {
    let mut files = tables(calibration)?;
    if let Some(states) = states(calibration) {
        let columns = state_columns(calibration);
        files.extend(column::parquet("sample.parquet", &columns, &states)?);
    }
    replace_files(folder, files)
}

/// The tables that [`write`] writes as CSV: name and content of each.
///
/// # Errors
/// [`ReportError::Table`].
pub fn tables(calibration: &Calibration) -> Result<Vec<(&'static str, Vec<u8>)>, ReportError> {
    let (parameters, predictions, curves) = ("parameters.csv", "predictions.csv", "curves.csv");
    let of_parameters = column::csv(parameters, &parameter_columns(), &calibration.parameters)?;
    let of_predictions = column::csv(predictions, &prediction_columns(), &calibration.predictions)?;
    let mut tables = vec![(parameters, of_parameters), (predictions, of_predictions)];
    if !calibration.curves.is_empty() {
        let points: Vec<CurvePoint<'_>> = calibration.curves.iter().flat_map(points_of).collect();
        tables.push((curves, column::csv(curves, &curve_columns(), &points)?));
    }
    Ok(tables)
}

fn parameter_columns() -> Vec<Column<ParameterRecord>> {
    let marginal = |name: &str, of: fn(&percuss::calibrate::Marginal) -> f64| {
        Column::optional(name, move |p: &ParameterRecord| {
            p.posterior.as_ref().map(of)
        })
    };
    vec![
        Column::text("key", |p: &ParameterRecord| p.key.clone()),
        Column::text("unit", |p: &ParameterRecord| p.unit.clone()),
        Column::float("prior_2_5", |p: &ParameterRecord| p.prior[0]),
        Column::float("prior_97_5", |p: &ParameterRecord| p.prior[2]),
        Column::float("best", |p: &ParameterRecord| p.best),
        Column::optional("standard_error", |p: &ParameterRecord| p.standard_error),
        marginal("mean", |m| m.mean),
        marginal("standard_deviation", |m| m.standard_deviation),
        marginal("quantile_2_5", |m| m.quantiles[0]),
        marginal("quantile_50", |m| m.quantiles[1]),
        marginal("quantile_97_5", |m| m.quantiles[2]),
        marginal("r_hat", |m| m.r_hat),
        marginal("bulk_effective_size", |m| m.bulk_effective_size),
        marginal("tail_effective_size", |m| m.tail_effective_size),
    ]
}

fn prediction_columns() -> Vec<Column<Prediction>> {
    let end = |name: &str, of: fn(&Prediction) -> Option<f64>| Column::optional(name, of);
    vec![
        Column::text("id", |p: &Prediction| p.id.clone()),
        Column::text("sources", |p: &Prediction| p.sources.join(" ")),
        Column::text("part", |p: &Prediction| {
            if p.held_out { "hold-out" } else { "training" }.to_owned()
        }),
        Column::text("quantity", |p: &Prediction| {
            p.quantity.describe().to_owned()
        }),
        Column::text("unit", |p: &Prediction| p.unit.to_owned()),
        Column::float("impact_velocity_m_s", |p: &Prediction| {
            p.impact_velocity_m_s
        }),
        Column::float("measured", |p: &Prediction| p.measured),
        end("uncertainty", |p| p.uncertainty),
        end("before", |p| p.before),
        end("best", |p| p.best),
        end("axisymmetric", |p| p.axisymmetric.map(|[value, _]| value)),
        end("axisymmetric_uncertainty", |p| {
            p.axisymmetric.map(|[_, uncertainty]| uncertainty)
        }),
        end("relative_error", |p| p.relative_error),
        end("model_2_5", |p| p.model_band.map(|band| band[0])),
        end("model_97_5", |p| p.model_band.map(|band| band[1])),
        end("predictive_2_5", |p| p.predictive_band.map(|band| band[0])),
        end("predictive_50", |p| p.predictive_median),
        end("predictive_97_5", |p| p.predictive_band.map(|band| band[1])),
    ]
}

fn points_of(curve: &CurvePrediction) -> impl Iterator<Item = CurvePoint<'_>> {
    (0..curve.values).map(move |index| CurvePoint { curve, index })
}

fn curve_columns<'a>() -> Vec<Column<CurvePoint<'a>>> {
    let end = |name: &str, end: usize, of: fn(&CurvePoints) -> &Option<[Vec<f64>; 2]>| {
        Column::optional(name, move |p: &CurvePoint<'_>| {
            let band = of(&p.curve.points).as_ref();
            band.map(|band| band[end][p.index])
        })
    };
    vec![
        Column::text("id", |p: &CurvePoint<'_>| p.curve.id.clone()),
        Column::text("part", |p: &CurvePoint<'_>| {
            if p.curve.held_out {
                "hold-out"
            } else {
                "training"
            }
            .to_owned()
        }),
        Column::text("quantity", |p: &CurvePoint<'_>| p.curve.quantity.to_owned()),
        Column::text("unit", |p: &CurvePoint<'_>| p.curve.unit.to_owned()),
        Column::float("time_us", |p: &CurvePoint<'_>| {
            p.curve.points.time_us[p.index]
        }),
        Column::float("measured", |p: &CurvePoint<'_>| {
            p.curve.points.measured[p.index]
        }),
        Column::optional("before", |p: &CurvePoint<'_>| {
            p.curve.points.before.as_ref().map(|all| all[p.index])
        }),
        Column::optional("best", |p: &CurvePoint<'_>| {
            p.curve.points.best.as_ref().map(|all| all[p.index])
        }),
        end("model_2_5", 0, |points| &points.model_band),
        end("model_97_5", 1, |points| &points.model_band),
        end("predictive_2_5", 0, |points| &points.predictive_band),
        end("predictive_97_5", 1, |points| &points.predictive_band),
    ]
}

fn state_columns(calibration: &Calibration) -> Vec<Column<State>> {
    let mut columns = vec![
        Column::integer("ensemble", |s: &State| s.ensemble),
        Column::integer("step", |s: &State| s.step),
        Column::integer("walker", |s: &State| s.walker),
    ];
    for (i, parameter) in calibration.parameters.iter().enumerate() {
        columns.push(Column::float(parameter.column(), move |s: &State| {
            s.values[i]
        }));
    }
    if calibration.scatter.estimated {
        let last = calibration.parameters.len();
        columns.push(Column::float("scatter", move |s: &State| {
            s.values[last].exp()
        }));
    }
    columns
}

fn states(calibration: &Calibration) -> Option<Vec<State>> {
    let sample = calibration.sample.as_ref()?;
    let (steps, walkers) = (sample.sampling.steps, sample.sampling.walkers);
    let state = |(i, values): (usize, &[f64])| State {
        ensemble: (i / (steps * walkers)) as i64,
        step: (i / walkers % steps) as i64,
        walker: (i % walkers) as i64,
        values: values.to_vec(),
    };
    Some(sample.kept().enumerate().map(state).collect())
}
