//! Parity plots and residuals, one of each a kind of shot and model.

use std::collections::BTreeMap;

use percuss::{
    shots::Kind,
    validate::{Prediction, Standing, Validation},
};

use crate::{Axis, Figure, LineChart, Mark, Series, Style, palette};

/// Fewest points that are worth a figure.
const FEWEST: usize = 3;
/// Half width of the band that is drawn around perfect agreement.
const BAND: f64 = 0.1;

/// A figure and what it is of.
pub(super) struct Drawn {
    pub(super) kind: Kind,
    pub(super) model: &'static str,
    pub(super) drawing: Figure,
}

/// Draws all figures, in the order of kinds and models.
pub(super) fn draw(validation: &Validation) -> Vec<Drawn> {
    let mut drawn = Vec::new();
    for kind in Kind::ALL {
        for &model in &validation.models {
            let groups = groups(validation, kind, model);
            let counted: usize = groups
                .iter()
                .filter(|(name, _)| name.as_str() != FLAGGED)
                .map(|(_, group)| group.len())
                .sum();
            if counted < FEWEST {
                continue;
            }
            for drawing in [
                parity(kind, model, &groups),
                residuals(validation, kind, model, &groups),
            ] {
                drawn.push(Drawn {
                    kind,
                    model,
                    drawing,
                });
            }
        }
    }
    drawn
}

const FLAGGED: &str = "suspect, not counted";

type Groups<'a> = BTreeMap<String, Vec<&'a Prediction>>;

/// Predictions of a model by what tells most about them: the material record of a Taylor rod, otherwise the projectile.
fn groups<'a>(validation: &'a Validation, kind: Kind, model: &str) -> Groups<'a> {
    let mut groups = Groups::new();
    for prediction in &validation.predictions {
        let shot = validation.shot(prediction);
        let name = match prediction.standing {
            Standing::Flagged => FLAGGED.to_owned(),
            Standing::Counted if kind == Kind::Taylor => prediction.record.clone(),
            Standing::Counted if prediction.main_record => shot.projectile_class.clone(),
            _ => continue,
        };
        if shot.kind == kind && prediction.model == model {
            groups.entry(name).or_default().push(prediction);
        }
    }
    groups
}

fn series<'a>(groups: &Groups<'a>, point: impl Fn(&Prediction) -> (f64, f64)) -> Vec<Series> {
    let series = groups.iter().map(|(name, group)| {
        let points = group.iter().map(|prediction| point(prediction));
        let series = Series::new(name.clone(), points).style(Style::Cloud);
        match name.as_str() {
            FLAGGED => series.color(palette::MARK),
            _ => series,
        }
    });
    series.collect()
}

fn what(kind: Kind) -> (&'static str, &'static str) {
    match kind {
        Kind::Taylor => ("taylor", "Final length of Taylor rods"),
        Kind::BallisticLimit => ("ballistic-limit", "Ballistic limit"),
        Kind::Depth => ("depth", "Depth of penetration"),
        Kind::ResidualVelocity => ("residual-velocity", "Residual velocity"),
    }
}

fn parity(kind: Kind, model: &str, groups: &Groups<'_>) -> Figure {
    let (stem, title) = what(kind);
    let unit = kind.unit();
    let predicted = |p: &Prediction| p.predicted.unwrap_or(f64::NAN);
    let points = groups.values().flatten();
    let (low, high) = points.fold((f64::INFINITY, 0.0_f64), |(low, high), p| {
        (low.min(p.measured), high.max(p.measured))
    });
    let line = |name: &str, factor: f64, style| {
        Series::new(name, [(low, factor * low), (high, factor * high)])
            .style(style)
            .width(1.0)
            .color(palette::MARK)
    };
    let chart = LineChart::new(
        format!("parity-{stem}-{}", model.replace('_', "-")),
        format!("{title}: {model} against measurement"),
        Axis::new(format!("measured [{unit}]")),
        Axis::new(format!("predicted by {model} [{unit}]")),
    )
    .caption("dashed: 10 % above and below")
    .true_to_scale()
    .series(line("", 1.0, Style::Line))
    .series(line("", 1.0 + BAND, Style::Dashed))
    .series(line("", 1.0 - BAND, Style::Dashed));
    let chart = series(groups, |p| (p.measured, predicted(p)))
        .into_iter()
        .fold(chart, LineChart::series);
    chart.draw()
}

fn residuals(validation: &Validation, kind: Kind, model: &str, groups: &Groups<'_>) -> Figure {
    let (stem, title) = what(kind);
    let chart = LineChart::new(
        format!("residuals-{stem}-{}", model.replace('_', "-")),
        format!("{title}: error of {model} against impact speed"),
        Axis::new("impact speed [m/s]"),
        Axis::new("predicted over measured, less 1 [%]"),
    )
    .mark(Mark::horizontal("", 0.0))
    .mark(Mark::horizontal("", 100.0 * BAND))
    .mark(Mark::horizontal("", -100.0 * BAND));
    let point = |p: &Prediction| {
        let error = p.relative_error.unwrap_or(f64::NAN);
        (validation.shot(p).impact_velocity, 100.0 * error)
    };
    let chart = series(groups, point)
        .into_iter()
        .fold(chart, LineChart::series);
    chart
        .caption("lines: agreement, 10 % above and below")
        .draw()
}
