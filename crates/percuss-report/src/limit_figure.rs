//! Chart of residual velocity versus impact velocity, and its figure.

use percuss::{
    Scenario,
    limit::{LimitOutcome, Limits, ModelLimit},
    outcome::BandQuantity,
};

use crate::{
    Axis, Chart, Figure, LineChart, Mark, Series, Style, caption::caption, caption::significant,
    palette, result_rows::with_uncertainty,
};

/// Points of a smooth curve.
const POINTS: u32 = 200;

/// Draws residual velocities of all models, their Lambert-Jonas curves, and measured values, as `limit`; `None` when no model has a
/// limit. Models whose limit is an input have a dashed curve without points.
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
        format!("Residual velocity and ballistic limit: {}", limits.case),
        Axis::new("Impact velocity (m/s)"),
        Axis::new("Residual velocity (m/s)"),
    )
    .caption(caption(scenario, None));
    for (symbol, (_, limit)) in found().enumerate() {
        chart = series(chart, limit, symbol);
    }
    for (place, limit) in inputs().enumerate() {
        chart = input_curve(chart, limit, found().count() + place);
    }
    let measured: Vec<_> = limits
        .experiments
        .iter()
        .filter(|measured| measured.quantity == BandQuantity::ResidualVelocity)
        .filter_map(|measured| Some((measured.impact_velocity_m_s?, measured)))
        .collect();
    if !measured.is_empty() {
        let bar = |u: Option<f64>| u.map_or((0.0, 0.0), |u| (u, u));
        chart = chart.series(
            Series::new("experiment", measured.iter().map(|(v, m)| (*v, m.value)))
                .style(Style::Markers)
                .color(palette::EXPERIMENT)
                .error_bars(measured.iter().map(|(_, m)| bar(m.uncertainty))),
        );
    }
    let axisymmetric = limits.axisymmetric.as_ref();
    if let Some((value, half_width)) =
        axisymmetric.and_then(|l| l.ballistic_limit_m_s.zip(l.uncertainty_m_s))
    {
        let name = format!(
            "axisymmetric limit {}",
            with_uncertainty(value, half_width, "m/s")
        );
        chart = chart.mark(Mark::vertical(name, value));
    }
    if let Some((value, _)) = limits.measured() {
        let name = format!("measured limit {} m/s", significant(value));
        chart = chart.mark(Mark::vertical(name, value));
    }
    Some(chart.into())
}

/// Points and curve of a model; the point at its limit is on the axis.
fn series(chart: LineChart, limit: &ModelLimit, symbol: usize) -> LineChart {
    let Some(at_limit) = limit.ballistic_limit_m_s else {
        return chart;
    };
    let points = limit.curve.iter();
    let points = points.map(|p| (p.impact_velocity_m_s, p.residual_velocity_m_s));
    let name = format!("{}, limit {} m/s", limit.model, significant(at_limit));
    let points = Series::new(name, std::iter::once((at_limit, 0.0)).chain(points));
    let chart = chart.series(points.style(Style::Markers).symbol(symbol));
    let (Some(fit), Some(last)) = (limit.fit, limit.curve.last()) else {
        return chart;
    };
    let (from, to) = (fit.ballistic_limit_m_s, last.impact_velocity_m_s);
    let curve = (0..=POINTS).map(|i| {
        // Closer to each other where the curve is steep.
        let part = f64::from(i) / f64::from(POINTS);
        let speed = from + (to - from) * part * part;
        (speed, fit.at(speed))
    });
    chart.series(Series::new("", curve).color(palette::symbol_color(symbol)))
}

fn is_input(limit: &ModelLimit) -> bool {
    limit.outcome == LimitOutcome::Input && !limit.curve.is_empty()
}

/// Residual velocities of a model whose limit is an input.
fn input_curve(chart: LineChart, limit: &ModelLimit, symbol: usize) -> LineChart {
    let Some(input) = limit.input_limit else {
        return chart;
    };
    let at = input.ballistic_limit_m_s;
    let points = limit.curve.iter();
    let points = points.map(|p| (p.impact_velocity_m_s, p.residual_velocity_m_s));
    let name = format!("{}, input {} m/s", limit.model, significant(at));
    let curve = Series::new(name, std::iter::once((at, 0.0)).chain(points));
    let color = palette::symbol_color(symbol);
    chart.series(curve.style(Style::Dashed).color(color))
}
