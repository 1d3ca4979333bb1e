//! Figures of the distribution and the sensitivity of a quantity.

use percuss::{
    Scenario,
    model::label,
    uncertainty::{Estimate, QuantityResult, TornadoBar, Uncertainty},
    units::significant,
};

use super::stem;
use crate::{
    Axis, Bar, BarRows, Histogram, LineChart, Mark, Series, Style, caption::caption_with, names,
    names::with_unit as label_with_unit, palette,
};

fn axis(quantity: &QuantityResult) -> Axis {
    let what = quantity.what();
    Axis::new(label_with_unit(what.label, what.unit.symbol))
}

fn title(start: &str, quantity: &QuantityResult) -> String {
    format!("{start} {}", quantity.what().label)
}

fn with_unit(value: f64, unit: &str) -> String {
    format!("{} {unit}", significant(value, 4))
        .trim_end()
        .to_owned()
}

/// Histogram with mean, percentiles and the result at median inputs.
pub(super) fn histogram(
    scenario: &Scenario,
    found: &Uncertainty,
    quantity: &QuantityResult,
) -> Histogram {
    let what = quantity.what();
    let statistics = &quantity.statistics;
    let values = found.draws.iter().filter_map(|draw| draw.value(what));
    let named = |name: &str, value: f64| {
        Mark::vertical(
            format!("{name} {}", with_unit(value, what.unit.symbol)),
            value,
        )
    };
    let title = title("Distribution of the", quantity);
    let mut chart = Histogram::new(
        format!("histogram-{}", stem(quantity.quantity)),
        title,
        axis(quantity),
        values,
    )
    .caption(caption_with(
        scenario,
        &format!(
            "{} runs, model {}, standard deviation {}",
            statistics.runs,
            label(found.model),
            with_unit(statistics.standard_deviation, what.unit.symbol)
        ),
    ))
    .mark(named("5th percentile", statistics.percentile(5.0).value))
    .mark(named("mean", statistics.mean))
    .mark(named("95th percentile", statistics.percentile(95.0).value));
    if let Some(nominal) = quantity.nominal {
        chart = chart.mark(named("at median inputs", nominal));
    }
    chart
}

/// Tornado chart: effect of each parameter from its 5th to its 95th percentile.
pub(super) fn tornado(
    scenario: &Scenario,
    found: &Uncertainty,
    quantity: &QuantityResult,
) -> BarRows {
    let nominal = quantity
        .nominal
        .unwrap_or(quantity.statistics.percentile(50.0).value);
    let [low_color, high_color] = [palette::SERIES[0], palette::SERIES[5]];
    let name = format!("tornado-{}", stem(quantity.quantity));
    let mut chart = BarRows::new(
        name,
        title("Tornado chart of the", quantity),
        axis(quantity),
        1,
    )
    .caption(caption_with(
        scenario,
        "one parameter at a time, all others at their medians",
    ))
    .color("at 5th percentile", low_color)
    .color("at 95th percentile", high_color)
    .mark(Mark::vertical("at median inputs", nominal));
    for TornadoBar {
        key,
        at_low,
        at_high,
    } in &quantity.tornado
    {
        let Some(input) = found.inputs.iter().find(|input| input.key == *key) else {
            continue;
        };
        let bar = |end: Option<f64>, at: f64, color: &str| {
            end.map(|end| Bar {
                ends: (nominal, end),
                color: color.to_owned(),
                lane: 0,
                interval: None,
                text: with_unit(at, &input.unit),
            })
        };
        let bars = [
            bar(*at_low, input.low, low_color),
            bar(*at_high, input.high, high_color),
        ];
        chart = chart.row(names::parameter(key), bars.into_iter().flatten());
    }
    chart
}

/// Sobol' indices with their intervals.
pub(super) fn indices(scenario: &Scenario, quantity: &QuantityResult) -> Option<BarRows> {
    let indices = quantity.indices.as_ref()?;
    let [first_color, total_color] = [palette::SERIES[2], palette::SERIES[4]];
    let name = format!("indices-{}", stem(quantity.quantity));
    let x = Axis::new("Fraction of variance");
    let mut chart = BarRows::new(name, title("Sobol' indices of the", quantity), x, 2)
        .caption(caption_with(
            scenario,
            &format!("{} sample rows, 95 % intervals", indices.rows),
        ))
        .color("first-order index", first_color)
        .color("total-effect index", total_color)
        .mark(Mark::vertical("", 0.0));
    let mut sorted: Vec<_> = indices.parameters.iter().collect();
    sorted.sort_by(|a, b| b.total.value.total_cmp(&a.total.value));
    for index in sorted {
        let bar = |lane: usize, estimate: Estimate, color: &str| Bar {
            ends: (0.0, estimate.value.max(0.0)),
            color: color.to_owned(),
            lane,
            interval: Some((estimate.low, estimate.high)),
            text: format!("{:.2}", estimate.value + 0.0).replace("-0.00", "0.00"),
        };
        let bars = [
            bar(0, index.first_order, first_color),
            bar(1, index.total, total_color),
        ];
        chart = chart.row(names::parameter(&index.key), bars);
    }
    Some(chart)
}

/// Axisymmetric number against that of the model, with the line through them.
pub(super) fn axisymmetric(scenario: &Scenario, found: &Uncertainty) -> Option<LineChart> {
    let spread = found.axisymmetric.as_ref()?;
    let what = spread.what();
    let unit = what.unit.symbol;
    let points = || spread.points.iter();
    let error = |error: f64| format!("{} {unit}", significant(error, 2));
    let ends_of = |uncertainty: Option<f64>| uncertainty.map_or((0.0, 0.0), |u| (u, u));
    let ends = [points().next()?, points().next_back()?].map(|point| {
        let at = point.model_value;
        (at, spread.intercept + spread.slope * at)
    });
    let chart = LineChart::new(
        format!("axisymmetric-{}", stem(spread.quantity)),
        format!(
            "Axisymmetric {} against model {}",
            what.label,
            label(found.model)
        ),
        Axis::new(label_with_unit(
            &format!("{} by model {}", what.label, label(found.model)),
            unit,
        )),
        Axis::new(label_with_unit(
            &format!("{} by model {}", what.label, label("axi")),
            unit,
        )),
    )
    .caption(caption_with(
        scenario,
        &format!(
            "mean {} ± {}, standard deviation {} ± {}",
            significant(spread.mean, 4),
            error(spread.standard_error),
            significant(spread.standard_deviation, 3),
            error(spread.standard_deviation_error)
        ),
    ))
    .series(
        Series::new(
            format!("line, correlation {}", significant(spread.correlation, 3)),
            ends,
        )
        .color(palette::symbol_color(1)),
    )
    .series(
        Series::new(
            "samples, ± mesh",
            points().map(|point| (point.model_value, point.value)),
        )
        .style(Style::Markers)
        .color(palette::symbol_color(0))
        .error_bars(points().map(|point| ends_of(point.uncertainty))),
    );
    Some(chart)
}
