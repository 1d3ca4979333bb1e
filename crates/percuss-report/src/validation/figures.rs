//! Parity plots and residuals, one each per kind of test and model.

use std::collections::{BTreeMap, BTreeSet};

use percuss::{
    experiments::Kind,
    model::label,
    validate::{Prediction, Standing, Validation},
};

use crate::{Axis, Figure, LineChart, Mark, Series, Style, names, palette};

/// Smallest number of points of a figure.
const FEWEST: usize = 3;
/// Largest number of points that are drawn at full size.
const FEW: usize = 60;
/// Half width of the band that is drawn around perfect agreement.
const BAND: f64 = 0.1;

/// Figure with its kind of test and model.
pub(super) struct ModelFigure {
    pub(super) kind: Kind,
    pub(super) model: &'static str,
    pub(super) drawing: Figure,
}

/// Draws all figures, in the order of kinds and models.
pub(super) fn draw(validation: &Validation) -> Vec<ModelFigure> {
    let mut drawn = Vec::new();
    for kind in Kind::ALL {
        let symbols = symbols(validation, kind);
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
                parity(validation, kind, model, &groups, &symbols),
                residuals(validation, kind, model, &groups, &symbols),
            ] {
                drawn.push(ModelFigure {
                    kind,
                    model,
                    drawing,
                });
            }
        }
    }
    drawn
}

/// Begins with a space to be drawn first, below the others.
const FLAGGED: &str = " suspect, not counted";

type Groups<'a> = BTreeMap<String, Vec<&'a Prediction>>;

/// Names of groups in the order of their symbols, the same in all figures of a kind of test.
type Symbols = BTreeSet<String>;

/// Group of a prediction: the material record of a Taylor rod, otherwise the projectile.
fn group(validation: &Validation, prediction: &Prediction) -> Option<String> {
    let test = validation.test(prediction);
    match prediction.standing {
        Standing::Flagged => Some(FLAGGED.to_owned()),
        Standing::Counted if test.kind == Kind::Taylor => Some(prediction.record.clone()),
        Standing::Counted if prediction.main_record => Some(test.projectile_class.clone()),
        _ => None,
    }
}

fn of_kind(validation: &Validation, kind: Kind) -> impl Iterator<Item = (String, &Prediction)> {
    let predictions = validation.predictions.iter();
    predictions
        .filter(move |prediction| validation.test(prediction).kind == kind)
        .filter_map(|prediction| Some((group(validation, prediction)?, prediction)))
}

fn symbols(validation: &Validation, kind: Kind) -> Symbols {
    of_kind(validation, kind)
        .map(|(name, _)| name)
        .filter(|name| name != FLAGGED)
        .collect()
}

fn groups<'a>(validation: &'a Validation, kind: Kind, model: &str) -> Groups<'a> {
    let mut groups = Groups::new();
    for (name, prediction) in of_kind(validation, kind) {
        if prediction.model == model {
            groups.entry(name).or_default().push(prediction);
        }
    }
    groups
}

fn series<'a>(
    kind: Kind,
    groups: &Groups<'a>,
    symbols: &Symbols,
    point: impl Fn(&Prediction) -> (f64, f64),
) -> Vec<Series> {
    let style = match groups.values().map(Vec::len).sum::<usize>() <= FEW {
        true => Style::Markers,
        false => Style::Cloud,
    };
    let series = groups.iter().map(|(name, group)| {
        let points = group.iter().map(|prediction| point(prediction));
        let index = symbols.iter().position(|symbol| symbol == name);
        let shown = match kind {
            Kind::Taylor => names::library_material(name.trim()),
            _ => name.trim(),
        };
        let series = Series::new(shown, points)
            .style(style)
            .symbol(index.unwrap_or(0));
        match name.as_str() {
            FLAGGED => series.color(palette::NO_VALUE),
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

/// Scale of a prediction: the initial length of a Taylor rod, otherwise 1.
fn scale(validation: &Validation, prediction: &Prediction) -> f64 {
    let test = validation.test(prediction);
    match (test.kind, test.length) {
        (Kind::Taylor, Some(length)) => test.kind.shown(length),
        _ => 1.0,
    }
}

fn parity(
    validation: &Validation,
    kind: Kind,
    model: &str,
    groups: &Groups<'_>,
    symbols: &Symbols,
) -> Figure {
    let (stem, title) = what(kind);
    let unit = match kind {
        Kind::Taylor => "final length / initial length".to_owned(),
        _ => format!("({})", kind.unit()),
    };
    let point = |p: &Prediction| {
        let scale = scale(validation, p);
        (p.measured / scale, p.predicted.unwrap_or(f64::NAN) / scale)
    };
    let points: Vec<(f64, f64)> = groups.values().flatten().map(|p| point(p)).collect();
    let values = points.iter().flat_map(|(x, y)| [*x, *y]);
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        });
    let margin = 0.04 * (high - low).max(0.01 * high);
    let (low, high) = ((low - margin).max(0.0), high + margin);
    let axis = |label: String| Axis::new(label).range(low, high);
    let line = |factor: f64, style| {
        // Clipped to the square.
        let ends = [low.max(low / factor), high.min(high / factor)];
        Series::new("", ends.map(|x| (x, factor * x)))
            .style(style)
            .width(1.0)
            .color(palette::MARK)
    };
    let chart = LineChart::new(
        format!("parity-{stem}-{}", model.replace('_', "-")),
        format!("{title}, model {} versus measurement", label(model)),
        axis(format!("Measured {unit}")),
        axis(format!("Predicted {unit}")),
    )
    .caption("dashed lines: ±10 %")
    .series(line(1.0, Style::Line))
    .series(line(1.0 + BAND, Style::Dashed))
    .series(line(1.0 - BAND, Style::Dashed));
    let chart = series(kind, groups, symbols, point)
        .into_iter()
        .fold(chart, LineChart::series);
    chart.square().draw()
}

fn residuals(
    validation: &Validation,
    kind: Kind,
    model: &str,
    groups: &Groups<'_>,
    symbols: &Symbols,
) -> Figure {
    let (stem, title) = what(kind);
    // The abscissa of a ballistic limit is the measured limit.
    let speed = match kind {
        Kind::BallisticLimit => "Measured limit",
        _ => "Impact velocity",
    };
    let chart = LineChart::new(
        format!("residuals-{stem}-{}", model.replace('_', "-")),
        format!("{title}, relative error of model {}", label(model)),
        Axis::new(format!("{speed} (m/s)")),
        Axis::new("Predicted / measured - 1 (%)"),
    )
    .mark(Mark::horizontal("", 0.0))
    .mark(Mark::horizontal("", 100.0 * BAND))
    .mark(Mark::horizontal("", -100.0 * BAND));
    let point = |p: &Prediction| {
        let error = p.relative_error.unwrap_or(f64::NAN);
        (validation.test(p).impact_velocity, 100.0 * error)
    };
    let chart = series(kind, groups, symbols, point)
        .into_iter()
        .fold(chart, LineChart::series);
    chart.caption("lines: 0 and ±10 %").draw()
}
