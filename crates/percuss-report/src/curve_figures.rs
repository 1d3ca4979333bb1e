//! Measured curves with those of runs.

use percuss::{
    Scenario, measured_curves::CurveComparison, model::label, scenario::MeasuredCurve,
    summary::ResultRecord, units::significant,
};

use crate::{
    Axis, LineChart, Series, Style,
    caption::caption,
    names::{capitalized, with_unit},
    palette,
};

/// A chart for each measured curve of a case: `measured-curve-1` and so on, with the curves of all models that give the quantity.
pub(crate) fn curve_charts(scenario: &Scenario, records: &[&ResultRecord]) -> Vec<LineChart> {
    let curves = scenario.measured_curves.iter().enumerate();
    curves
        .filter_map(|(index, curve)| curve_chart(scenario, records, index, curve))
        .collect()
}

fn curve_chart(
    scenario: &Scenario,
    records: &[&ResultRecord],
    index: usize,
    curve: &MeasuredCurve,
) -> Option<LineChart> {
    let in_unit = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
        let points = points.iter();
        let scaled = points.map(|(time, value)| (time * 1e6, curve.unit.of_si(*value)));
        scaled.collect()
    };
    let words = curve.quantity.replace('_', " ");
    let place = match &curve.gauge {
        Some(gauge) => format!(" at {gauge}"),
        None => String::new(),
    };
    let chart = LineChart::new(
        format!("measured-curve-{}", index + 1),
        format!("{}{place}, measured and computed", capitalized(&words)),
        Axis::new("Time (µs)").tight(),
        Axis::new(with_unit(&words, curve.unit.symbol)),
    )
    .caption(format!(
        "{}; %: relative RMS difference",
        caption(scenario, Some(scenario.impact_velocity))
    ));
    let mut chart = chart.series(
        Series::new(format!("measured ({})", curve.name), in_unit(&curve.points))
            .style(Style::Dashed)
            .width(2.0)
            .color(palette::EXPERIMENT),
    );
    let mut any = false;
    let symbols = palette::model_symbols(records.iter().map(|record| record.model));
    for (record, symbol) in records.iter().zip(symbols) {
        let found = record.measured_curves.get(index);
        let Some(found) = found.filter(|found| !found.computed.is_empty()) else {
            continue;
        };
        any = true;
        let line = Series::new(label(record.model), in_unit(&found.computed));
        chart = chart.series(line.value(differs_by(found)).symbol(symbol));
    }
    any.then_some(chart)
}

/// Root mean square difference over that of the measured curve.
fn differs_by(found: &CurveComparison) -> String {
    match found.relative_rms_difference {
        Some(part) => format!("{} %", significant(100.0 * part, 3)),
        None => String::new(),
    }
}
