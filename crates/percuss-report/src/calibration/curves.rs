//! Measured curves with those of the model before and after calibration.

use percuss::{
    calibrate::{Calibration, CurveError, CurvePrediction},
    model::label,
    units::significant,
};

use crate::{
    Axis, LineChart, Series, Style,
    names::{capitalized, with_unit},
    palette,
};

/// Colour of the model before calibration.
const BEFORE: &str = "#8a8a8a";

/// A measured curve, the model before and after calibration and its predictive interval, as `curve-1` and so on.
pub(super) fn chart(calibration: &Calibration, index: usize, curve: &CurvePrediction) -> LineChart {
    let points = &curve.points;
    let line = |values: &[f64]| -> Vec<(f64, f64)> {
        let times = points.time_us.iter().copied();
        times.zip(values.iter().copied()).collect()
    };
    let words = curve.quantity.replace('_', " ");
    let place = match &curve.gauge {
        Some(gauge) => format!(" at {gauge}"),
        None => String::new(),
    };
    let mut chart = LineChart::new(
        format!("curve-{}", index + 1),
        format!(
            "{}{place}, model {}",
            capitalized(&words),
            label(calibration.model)
        ),
        Axis::new("Time (µs)").tight(),
        Axis::new(with_unit(&words, curve.unit)),
    )
    .caption(caption(curve));
    if let Some(before) = &points.before {
        let name = format!("before calibration{}", differs_by(curve.before));
        chart = chart.series(Series::new(name, line(before)).color(BEFORE));
    }
    if let Some(best) = &points.best {
        let name = match points.predictive_band {
            Some(_) => "calibrated, 95 % band",
            None => "calibrated",
        };
        let name = format!("{name}{}", differs_by(curve.best));
        let mut series = Series::new(name, line(best)).color(palette::SERIES[0]);
        if let Some([low, high]) = &points.predictive_band {
            series = series.band(low.iter().copied().zip(high.iter().copied()));
        }
        chart = chart.series(series);
    }
    let measured = Series::new(format!("measured ({})", curve.name), line(&points.measured));
    chart.series(
        measured
            .style(Style::Dashed)
            .width(2.0)
            .color(palette::EXPERIMENT),
    )
}

/// Relative difference in words.
fn differs_by(error: Option<CurveError>) -> String {
    match error.and_then(|error| error.relative_rms_difference) {
        Some(part) => format!(": {} %", significant(100.0 * part, 3)),
        None => String::new(),
    }
}

fn caption(curve: &CurvePrediction) -> String {
    let held_out = match curve.held_out {
        true => ", held out",
        false => "",
    };
    let inside = curve.inside.map_or_else(String::new, |part| {
        format!("; {:.0} % in the predictive band", 100.0 * part)
    });
    format!(
        "%: relative RMS difference{held_out}; {} values, effective number {}{inside}",
        curve.values,
        significant(curve.effective_values, 3)
    )
}
