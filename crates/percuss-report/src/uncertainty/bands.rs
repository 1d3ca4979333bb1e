//! Figures versus impact velocity.

use percuss::{
    Scenario,
    model::label,
    outcome::BandQuantity,
    uncertainty::{QuantityResult, Statistics, Uncertainty},
};

use super::stem;
use crate::{
    Axis, LineChart, Mark, Series, Style,
    caption::{caption, caption_with},
    names::{capitalized, with_unit},
    palette,
};

/// Percentiles versus impact velocity, with measured values.
pub(super) fn bands(
    scenario: &Scenario,
    found: &Uncertainty,
    quantity: &QuantityResult,
) -> Option<LineChart> {
    let what = quantity.what();
    let at = |band: &percuss::uncertainty::Band| -> Option<Statistics> {
        let of = band.quantities.iter().find(|q| q.quantity == what.name)?;
        of.statistics.clone()
    };
    let points: Vec<(f64, Option<Statistics>)> = found
        .bands
        .iter()
        .map(|band| (band.impact_velocity_m_s, at(band)))
        .collect();
    points.iter().find(|(_, statistics)| statistics.is_some())?;
    let percentile = |percent: f64| {
        points.iter().map(move |(speed, statistics)| {
            let value = statistics.as_ref().map(|s| s.percentile(percent).value);
            (*speed, value.unwrap_or(f64::NAN))
        })
    };
    let between = |low: f64, high: f64| {
        let ends = percentile(low).zip(percentile(high));
        ends.map(|(low, high)| (low.1, high.1))
    };
    let color = palette::SERIES[0];
    let mut chart = LineChart::new(
        format!("bands-{}", stem(what.name)),
        format!("{} versus impact velocity", capitalized(what.label)),
        Axis::new("Impact velocity (m/s)"),
        Axis::new(with_unit(what.label, what.unit.symbol)),
    )
    .caption(format!(
        "{}; the velocity itself is exact",
        caption(scenario, None)
    ))
    .series(
        Series::new("median", percentile(50.0))
            .color(color)
            .band(between(25.0, 75.0))
            .band_name("25th to 75th percentile"),
    )
    .series(
        Series::new("5th and 95th percentile", percentile(5.0))
            .color(color)
            .width(0.8)
            .style(Style::Dashed),
    )
    .series(
        Series::new("", percentile(95.0))
            .color(color)
            .width(0.8)
            .style(Style::Dashed),
    );
    let measured: Vec<_> = scenario
        .experiments
        .iter()
        .filter(|m| of_name(m.quantity) == what.name)
        .filter_map(|m| Some((m.impact_velocity?, m)))
        .collect();
    if !measured.is_empty() {
        let points = measured
            .iter()
            .map(|(speed, m)| (*speed, m.quantity.in_unit(m.value)));
        let errors = measured.iter().map(|(_, m)| {
            let error = m.uncertainty.map_or(0.0, |u| m.quantity.in_unit(u));
            (error, error)
        });
        chart = chart.series(
            Series::new("experiment", points)
                .style(Style::Markers)
                .color(palette::EXPERIMENT)
                .error_bars(errors),
        );
    }
    Some(chart)
}

/// Name of a measured quantity among results.
fn of_name(quantity: BandQuantity) -> &'static str {
    match quantity {
        BandQuantity::DepthOfPenetration => "depth_of_penetration_mm",
        BandQuantity::ResidualVelocity => "residual_velocity_m_s",
        BandQuantity::BallisticLimit => "ballistic_limit_m_s",
        BandQuantity::ProjectileFinalLength => "projectile_final_length_mm",
    }
}

/// Probability of perforation versus impact velocity; `None` where no run perforates.
pub(super) fn perforation(scenario: &Scenario, found: &Uncertainty) -> Option<LineChart> {
    let decided: Vec<_> = found
        .bands
        .iter()
        .filter_map(|band| Some((band.impact_velocity_m_s, band.perforation?)))
        .collect();
    decided.iter().find(|(_, p)| p.perforated > 0)?;
    let curve = decided
        .iter()
        .map(|(speed, p)| (*speed, 100.0 * p.probability));
    let band = decided.iter().map(|(_, p)| (100.0 * p.low, 100.0 * p.high));
    let mut chart = LineChart::new(
        "perforation",
        "Probability of perforation",
        Axis::new("Impact velocity (m/s)"),
        Axis::new("Probability of perforation (%)").range(-4.0, 104.0),
    )
    .caption(caption_with(
        scenario,
        "band: 95 % interval due to the finite number of runs",
    ))
    .series(Series::new(format!("model {}", label(found.model)), curve).band(band));
    let tests = scenario
        .experiments
        .iter()
        .filter(|m| m.quantity == BandQuantity::ResidualVelocity);
    let tests: Vec<(f64, f64)> = tests
        .filter_map(|m| Some((m.impact_velocity?, if m.value > 0.0 { 100.0 } else { 0.0 })))
        .collect();
    if !tests.is_empty() {
        chart = chart.series(
            Series::new("experiment", tests)
                .style(Style::Markers)
                .color(palette::EXPERIMENT),
        );
    }
    let limit = scenario
        .experiments
        .iter()
        .find(|m| m.quantity == BandQuantity::BallisticLimit);
    if let Some(limit) = limit {
        chart = chart.mark(Mark::vertical("measured limit", limit.value));
    }
    Some(chart)
}
