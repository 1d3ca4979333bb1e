//! Chart of residual velocity versus impact velocity, and its figure.

use std::collections::BTreeMap;

use percuss::{
    Scenario,
    axisymmetric::MODEL,
    limit::{LimitOutcome, Limits, ModelLimit},
    model::label,
    outcome::BandQuantity,
    units::significant,
};

use crate::{
    Axis, Chart, Figure, LineChart, Mark, Series, Style, caption::caption,
    compare_figure::RECOMMENDED, measured::versus_speed, palette, result_rows::with_uncertainty,
};

/// Points of a smooth curve.
const POINTS: u32 = 200;
/// Largest relative difference of points that cannot be told from each other.
const COINCIDE: f64 = 2e-3;

/// Draws residual velocities of all models, their Lambert-Jonas curves, and measured values, as `limit`; `None` when no model has a
/// limit. Models whose limit is an input have a curve without points.
pub fn limit_figure(scenario: &Scenario, limits: &Limits) -> Option<Figure> {
    limit_chart(scenario, limits).map(|chart| chart.draw())
}

/// The chart that [`limit_figure`] draws.
pub fn limit_chart(scenario: &Scenario, limits: &Limits) -> Option<Chart> {
    let found = || {
        let results = limits.results.iter().enumerate();
        results.filter(|(_, limit)| limit.outcome == LimitOutcome::Found)
    };
    let inputs = || limits.results.iter().filter(|limit| is_input(limit));
    found().map(|(_, limit)| limit).chain(inputs()).next()?;
    let mut chart = LineChart::new(
        "limit",
        "Residual velocity and ballistic limit",
        Axis::new("Impact velocity (m/s)"),
        Axis::new("Residual velocity (m/s)"),
    )
    .values("limit", "m/s")
    .caption(match limits.recommended.is_empty() {
        true => caption(scenario, None),
        false => format!("{} ({RECOMMENDED} recommended)", caption(scenario, None)),
    });
    let symbols = symbols(limits);
    for models in coinciding(found().map(|(_, limit)| limit)) {
        chart = series(
            chart,
            &models,
            names(limits, &models),
            symbols[models[0].model],
        );
    }
    for models in coinciding(inputs()) {
        let name = format!("{} (input)", names(limits, &models));
        chart = input_curve(chart, &models, name, symbols[models[0].model]);
    }
    if let Some(measured) = versus_speed(&limits.experiments, BandQuantity::ResidualVelocity) {
        chart = chart.series(measured);
    }
    let axisymmetric = limits.axisymmetric.as_ref();
    if let Some((value, half_width)) =
        axisymmetric.and_then(|l| l.ballistic_limit_m_s.zip(l.uncertainty_m_s))
    {
        let shown = with_uncertainty(value, half_width, "m/s");
        let shown = shown.trim_end_matches(" m/s");
        chart =
            chart.mark(Mark::vertical(marked(limits, MODEL, "axisymmetric"), value).shown(shown));
    }
    if let Some((value, _)) = limits.measured() {
        let mark = Mark::vertical("measured", value);
        chart = chart.mark(mark.shown(significant(value, 4)));
    }
    Some(chart.into())
}

/// Models whose points would hide each other, together.
fn coinciding<'a>(limits: impl Iterator<Item = &'a ModelLimit>) -> Vec<Vec<&'a ModelLimit>> {
    let near = |a: f64, b: f64| (a - b).abs() <= COINCIDE * a.abs().max(b.abs());
    let at = |limit: &ModelLimit| {
        let input = limit.input_limit.map(|input| input.ballistic_limit_m_s);
        limit.ballistic_limit_m_s.or(input)
    };
    let same = |a: &ModelLimit, b: &ModelLimit| {
        let of_curves = a.curve.iter().zip(&b.curve).all(|(a, b)| {
            near(a.impact_velocity_m_s, b.impact_velocity_m_s)
                && near(a.residual_velocity_m_s, b.residual_velocity_m_s)
        });
        let of_limits = at(a).zip(at(b)).is_some_and(|(a, b)| near(a, b));
        of_limits && of_curves && a.curve.len() == b.curve.len()
    };
    let mut groups: Vec<Vec<&ModelLimit>> = Vec::new();
    for limit in limits {
        match groups.iter_mut().find(|group| same(group[0], limit)) {
            Some(group) => group.push(limit),
            None => groups.push(vec![limit]),
        }
    }
    groups
}

fn names(limits: &Limits, models: &[&ModelLimit]) -> String {
    let names: Vec<_> = models
        .iter()
        .map(|limit| marked(limits, limit.model, &label(limit.model)))
        .collect();
    names.join(" and ")
}

/// The name of a model, marked where it is recommended.
fn marked(limits: &Limits, model: &str, name: &str) -> String {
    match limits.is_recommended(model) {
        true => format!("{name} {RECOMMENDED}"),
        false => name.to_owned(),
    }
}

/// Symbols of all models.
fn symbols(limits: &Limits) -> BTreeMap<&'static str, usize> {
    let names = || limits.results.iter().map(|limit| limit.model);
    names().zip(palette::model_symbols(names())).collect()
}

/// Points and curve of models that coincide; the point at their limit is on the axis.
fn series(chart: LineChart, models: &[&ModelLimit], name: String, symbol: usize) -> LineChart {
    let limit = models[0];
    let Some(at_limit) = limit.ballistic_limit_m_s else {
        return chart;
    };
    let points = limit.curve.iter();
    let points = points.map(|p| (p.impact_velocity_m_s, p.residual_velocity_m_s));
    let points = Series::new(name, std::iter::once((at_limit, 0.0)).chain(points))
        .value(significant(at_limit, 3))
        .style(Style::Markers)
        .symbol(symbol);
    let (Some(fit), Some(last)) = (limit.fit, limit.curve.last()) else {
        return chart.series(points);
    };
    let chart = chart.series(points.joined());
    let (from, to) = (fit.ballistic_limit_m_s, last.impact_velocity_m_s);
    let curve = (0..=POINTS).map(|i| {
        // Closer to each other where the curve is steep.
        let part = f64::from(i) / f64::from(POINTS);
        let speed = from + (to - from) * part * part;
        (speed, fit.at(speed))
    });
    chart.series(Series::new("", curve).symbol(symbol))
}

fn is_input(limit: &ModelLimit) -> bool {
    limit.outcome == LimitOutcome::Input && !limit.curve.is_empty()
}

/// Residual velocities of models whose limit is an input and that coincide.
fn input_curve(chart: LineChart, models: &[&ModelLimit], name: String, symbol: usize) -> LineChart {
    let limit = models[0];
    let Some(input) = limit.input_limit else {
        return chart;
    };
    let at = input.ballistic_limit_m_s;
    let points = limit.curve.iter();
    let points = points.map(|p| (p.impact_velocity_m_s, p.residual_velocity_m_s));
    let curve = Series::new(name, std::iter::once((at, 0.0)).chain(points));
    chart.series(curve.value(significant(at, 4)).symbol(symbol))
}

#[cfg(test)]
pub(crate) mod tests {
    use percuss::{
        Scenario, case,
        limit::{Limits, Observer, Search, limits},
        model,
    };

    use super::{Chart, limit_chart, limit_figure};

    /// Limits of a steel cylinder against a plate by some models.
    pub(crate) fn limits_by(names: &[&str]) -> (Scenario, Limits) {
        let text = "projectile = { material = '4340-johnson-cook', length = '40 mm', diameter = '20 mm', impact_velocity = '300 m/s' }\n\
                    target = { material = 'weldox-460-e-borvik', thickness = '8 mm', back_face = 'free' }\n";
        let scenario = case::load_str("case.toml", text).unwrap();
        let models = names.iter().map(|name| model::model(name).unwrap());
        let models: Vec<_> = models.collect();
        let (search, mut observer) = (Search::default(), Observer::default());
        let found = limits(&models, &scenario, &search, &mut observer).unwrap();
        (scenario, found)
    }

    #[test]
    fn models_whose_points_coincide_share_an_entry() {
        let (scenario, mut found) = limits_by(&["plugging"]);
        let mut twin = found.results[0].clone();
        twin.model = "twin";
        let mut other = twin.clone();
        other.model = "other";
        for point in &mut other.curve {
            point.residual_velocity_m_s *= 1.05;
        }
        found.results.extend([twin, other]);
        let svg = limit_figure(&scenario, &found).unwrap().svg;
        assert!(svg.contains(">plugging and twin<"), "{svg}");
        assert!(svg.contains(">other<"), "{svg}");
    }

    #[test]
    fn the_curve_of_a_model_starts_at_its_limit_on_the_axis() {
        let (scenario, found) = limits_by(&["plugging", "power_balance"]);
        let Some(Chart::Lines(chart)) = limit_chart(&scenario, &found) else {
            panic!("{found:?}");
        };
        let mut curves = chart.series.iter().filter(|series| series.name.is_empty());
        for limit in &found.results {
            let curve = curves.next().unwrap();
            let at = limit.ballistic_limit_m_s.unwrap();
            assert_eq!(curve.points[0], (at, 0.0), "{}", limit.model);
            assert!(curve.points[1].0 > at && curve.points[1].1 > 0.0);
        }
        assert_eq!(found.results.len(), 2);
    }
}
