//! Figure of partial and complete penetrations, with the probability of perforation and V50.

use percuss::v50::{Estimate, Method, Test, V50, probability};

use crate::{Axis, Figure, LineChart, Mark, Series, Style, caption::significant, palette};

/// Points of a smooth curve.
const POINTS: u32 = 200;

/// Draws tests, the maximum-likelihood probability of perforation, and V50 with its interval, as `v50`.
pub fn v50_figure(name: &str, tests: &[Test], v50: &V50) -> Figure {
    let mut chart = LineChart::new(
        "v50",
        format!("Partial and complete penetrations: {name}"),
        Axis::new("Impact velocity (m/s)"),
        Axis::new("Probability of perforation").range(-0.05, 1.05),
    )
    .caption(caption(v50));
    let (slowest, fastest) = tests
        .iter()
        .fold((f64::MAX, f64::MIN), |(low, high), test| {
            (
                low.min(test.impact_velocity),
                high.max(test.impact_velocity),
            )
        });
    let margin = 0.15 * (fastest - slowest);
    let speeds = (0..=POINTS).map(|i| {
        let part = f64::from(i) / f64::from(POINTS);
        slowest - margin + part * (fastest - slowest + 2.0 * margin)
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
        chart = marks(chart, entry);
    }
    chart.draw()
}

/// V50 and the ends of its interval.
fn marks(mut chart: LineChart, entry: &Estimate) -> LineChart {
    if let Some(value) = entry.v50_m_s {
        chart = chart.mark(Mark::vertical(
            format!("V50 {} m/s", significant(value)),
            value,
        ));
    }
    if let (Some(low), Some(high)) = (entry.low_m_s, entry.high_m_s) {
        let name = format!(
            "95 % interval {} to {} m/s",
            significant(low),
            significant(high)
        );
        chart = chart.mark(Mark::vertical(name, low));
        chart = chart.mark(Mark::vertical("", high));
    }
    chart
}

fn caption(v50: &V50) -> String {
    format!(
        "{} tests: {} partial and {} complete penetrations",
        v50.tests,
        v50.tests - v50.perforated,
        v50.perforated
    )
}
