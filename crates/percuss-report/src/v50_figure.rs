//! Figure of partial and complete penetrations, with the probability of perforation and V50.

use percuss::{
    units::significant,
    v50::{Estimate, Method, Test, V50, probability},
};

use crate::{Axis, Figure, LineChart, Mark, Series, Style, palette};

/// Points of a smooth curve.
const POINTS: u32 = 200;

/// Draws tests, the maximum-likelihood probability of perforation, and V50 with its interval, as `v50`.
pub fn v50_figure(name: &str, tests: &[Test], v50: &V50) -> Figure {
    let mut chart = LineChart::new(
        "v50",
        "Partial and complete penetrations",
        Axis::new("Impact velocity (m/s)"),
        Axis::new("Probability of perforation").range(-0.05, 1.05),
    )
    .caption(caption(name, v50));
    let (slowest, fastest) = tests
        .iter()
        .fold((f64::MAX, f64::MIN), |(low, high), test| {
            (
                low.min(test.impact_velocity),
                high.max(test.impact_velocity),
            )
        });
    let span = fastest - slowest;
    let drawn_ends: Vec<f64> = v50.of(Method::Probit).map_or_else(Vec::new, |entry| {
        let ends = [entry.low_m_s, entry.high_m_s].into_iter().flatten();
        // An end far from all tests would leave them a small part of the axis.
        ends.filter(|end| (slowest - span..=fastest + span).contains(end))
            .collect()
    });
    let margin = 0.15 * span;
    let (from, to) = drawn_ends
        .iter()
        .fold((slowest - margin, fastest + margin), |(from, to), end| {
            (from.min(*end), to.max(*end))
        });
    let speeds = (0..=POINTS).map(|i| {
        let part = f64::from(i) / f64::from(POINTS);
        from + part * (to - from)
    });
    for (method, style) in [
        (Method::Probit, Style::Line),
        (Method::Logit, Style::Dashed),
    ] {
        let Some(entry) = v50.of(method).filter(|entry| entry.v50_m_s.is_some()) else {
            continue;
        };
        let curve: Vec<(f64, f64)> = speeds
            .clone()
            .filter_map(|speed| Some((speed, probability(entry, speed)?)))
            .collect();
        chart = chart.series(Series::new(method.describe(), curve).style(style));
    }
    for (words, perforated, color) in [
        ("complete penetration", true, palette::SERIES[1]),
        ("partial penetration", false, palette::SERIES[2]),
    ] {
        let kind = tests.iter().filter(|test| test.perforated == perforated);
        let height = f64::from(u8::from(perforated));
        chart = chart.series(
            Series::new(words, kind.map(|test| (test.impact_velocity, height)))
                .style(Style::Markers)
                .color(color),
        );
    }
    if let Some(entry) = v50.of(Method::Probit) {
        chart = marks(chart, entry, &drawn_ends);
        if let (Some(interval), true) = (interval(entry), drawn_ends.is_empty()) {
            chart = chart.caption(format!("{}; {interval}", caption(name, v50)));
        }
    }
    chart.draw()
}

/// V50 and the ends of its interval that are drawn.
fn marks(mut chart: LineChart, entry: &Estimate, drawn_ends: &[f64]) -> LineChart {
    if let Some(value) = entry.v50_m_s {
        chart = chart.mark(Mark::vertical(
            format!("V50 {} m/s", significant(value, 4)),
            value,
        ));
    }
    if let Some(mut name) = interval(entry) {
        for end in drawn_ends {
            chart = chart.mark(Mark::vertical(std::mem::take(&mut name), *end));
        }
    }
    chart
}

/// The interval of V50 in words, where it is bounded.
fn interval(entry: &Estimate) -> Option<String> {
    let (low, high) = (entry.low_m_s?, entry.high_m_s?);
    let (low, high) = (significant(low, 4), significant(high, 4));
    Some(format!("95 % interval {low} to {high} m/s"))
}

fn caption(name: &str, v50: &V50) -> String {
    format!(
        "{name}; {}: {} partial and {} complete penetrations",
        match v50.tests {
            1 => "1 test".to_owned(),
            tests => format!("{tests} tests"),
        },
        v50.tests - v50.perforated,
        v50.perforated
    )
}
