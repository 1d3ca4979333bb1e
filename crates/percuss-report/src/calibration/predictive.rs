//! Errors of the calibrated model on the measured values.

use percuss::{
    calibrate::{Calibration, Prediction},
    model::label,
    outcome::BandQuantity,
};

use crate::{Axis, LineChart, Mark, Series, Style, palette};

/// Relative errors versus impact velocity with 95 % predictive intervals, as `predictive`.
pub(super) fn chart(calibration: &Calibration) -> LineChart {
    let mut chart = LineChart::new(
        "predictive",
        format!(
            "Relative error of model {} after calibration",
            label(calibration.model)
        ),
        Axis::new("Impact velocity (m/s)"),
        Axis::new("Predicted / measured - 1 (%)"),
    )
    .caption(caption(calibration))
    .mark(Mark::horizontal("", 0.0));
    for (name, held_out, color) in [
        ("fitted", false, palette::SERIES[0]),
        ("held out", true, palette::SERIES[1]),
    ] {
        let of_kind = || {
            let all = calibration.predictions.iter();
            all.filter(move |prediction| prediction.held_out == held_out)
                .filter_map(|prediction| Some((prediction, prediction.best?)))
        };
        let points: Vec<(f64, f64)> = of_kind()
            .map(|(p, best)| (p.impact_velocity_m_s, percent(p, best - p.measured)))
            .collect();
        if points.is_empty() {
            continue;
        }
        let bars = of_kind().map(|(p, best)| {
            p.predictive_band.map_or((0.0, 0.0), |[low, high]| {
                (percent(p, best - low), percent(p, high - best))
            })
        });
        let series = Series::new(name, points).style(Style::Markers).color(color);
        chart = chart.series(series.error_bars(bars));
    }
    let before = calibration.predictions.iter().filter_map(|p| {
        let error = p.before? - p.measured;
        Some((p.impact_velocity_m_s, percent(p, error)))
    });
    let before = Series::new("before calibration", before);
    chart.series(before.style(Style::Cloud).color("#9a9a9a"))
}

/// A difference in percent of what relative errors are relative to.
fn percent(prediction: &Prediction, difference: f64) -> f64 {
    let scale = match prediction.quantity {
        BandQuantity::ResidualVelocity => prediction.impact_velocity_m_s,
        _ => prediction.measured,
    };
    100.0 * difference / scale
}

fn caption(calibration: &Calibration) -> String {
    let of = |quality: &percuss::calibrate::Quality| {
        let inside = quality.inside.map_or_else(String::new, |inside| {
            format!(", {inside} within their intervals")
        });
        format!(
            "RMS error {:.1} % over {} values{inside}",
            100.0 * quality.rms,
            quality.count
        )
    };
    let fitted = calibration.training.as_ref().map_or_else(String::new, of);
    let bars = match calibration.sample {
        Some(_) => "; error bars: 95 % predictive interval",
        None => "",
    };
    let held_out = calibration
        .hold_out
        .as_ref()
        .map_or_else(String::new, |quality| {
            format!("; held out: {}", of(quality))
        });
    format!("fitted: {fitted}{held_out}{bars}")
}
