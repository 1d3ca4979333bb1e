//! Chart of a comparison of models, and its figure.

use percuss::{
    Scenario, compare::Comparison, model::label, outcome::BandQuantity, summary::ResultRecord,
    units::significant,
};

use crate::{
    Axis, Chart, Figure, LineChart, Mark, RowChart, Series, Style,
    caption::caption,
    curve_figures::curve_charts,
    measured::versus_speed,
    names::{capitalized, with_unit},
    palette,
};

/// Mark of a recommended model.
pub(crate) const RECOMMENDED: &str = "★";
/// Width of the line of a model where it is recommended [px].
const EMPHASIS: f64 = 4.0;

/// Draws the main quantity of a comparison as `compare`: versus impact velocity, or one row per model at a single velocity. Measured
/// curves follow as `measured-curve-1` and so on, with those of the models.
///
/// A line is interrupted where its model has no result, and thick where the model is recommended. There is no `compare` when no model
/// gives the quantity.
pub fn compare_figures(scenario: &Scenario, comparison: &Comparison) -> Vec<Figure> {
    let main = compare_chart(scenario, comparison).map(|chart| chart.draw());
    let own = scenario.impact_velocity;
    let records = comparison.results.iter();
    let records: Vec<&ResultRecord> = records
        .filter(|record| record.impact_velocity_m_s == own)
        .collect();
    let curves = curve_charts(scenario, &records);
    main.into_iter()
        .chain(curves.iter().map(LineChart::draw))
        .collect()
}

/// The chart `compare` of [`compare_figures`]; `None` when no model gives the quantity.
pub fn compare_chart(scenario: &Scenario, comparison: &Comparison) -> Option<Chart> {
    let quantity = *comparison.quantities.first()?;
    let given = |record: &ResultRecord| record.value(quantity).is_some();
    if !comparison.results.iter().any(given) {
        return None;
    }
    // A ballistic limit is independent of the impact velocity.
    if comparison.regime.len() == 1 || quantity == BandQuantity::BallisticLimit {
        Some(rows(scenario, comparison, quantity).into())
    } else {
        Some(lines(scenario, comparison, quantity).into())
    }
}

fn axis(quantity: BandQuantity) -> Axis {
    Axis::new(with_unit(quantity_name(quantity), quantity.unit()))
}

/// Full name of a quantity.
fn quantity_name(quantity: BandQuantity) -> &'static str {
    match quantity {
        BandQuantity::DepthOfPenetration => "depth of penetration",
        BandQuantity::ProjectileFinalLength => "final projectile length",
        quantity => quantity.describe(),
    }
}

fn title(quantity: BandQuantity) -> String {
    capitalized(quantity_name(quantity))
}

fn recommended(comparison: &Comparison, model: &str) -> Vec<bool> {
    comparison
        .recommended
        .iter()
        .map(|at| at.models.iter().any(|choice| choice.model == model))
        .collect()
}

fn name(model: &str, recommended: &[bool]) -> String {
    match recommended.contains(&true) {
        true => format!("{} {RECOMMENDED}", label(model)),
        false => label(model).into_owned(),
    }
}

/// Ends of the range of a quantity, where a model has one.
fn band(record: &ResultRecord, quantity: BandQuantity) -> Option<(f64, f64)> {
    let band = record.band.as_ref()?;
    (band.quantity == quantity).then_some((band.low, band.high))
}

/// Where a depth lies by the estimated error of its model: the ends of the 80 % interval.
fn corrected(record: &ResultRecord, quantity: BandQuantity) -> Option<(f64, f64)> {
    if quantity != BandQuantity::DepthOfPenetration {
        return None;
    }
    let (value, error) = (record.value(quantity)?, record.expected_error.as_ref()?);
    (error.low > -1.0).then(|| (value / (1.0 + error.high), value / (1.0 + error.low)))
}

fn lines(scenario: &Scenario, comparison: &Comparison, quantity: BandQuantity) -> LineChart {
    const NONE: f64 = f64::NAN;
    let mut chart = LineChart::new(
        "compare",
        format!("{} by model", title(quantity)),
        Axis::new("Impact velocity (m/s)"),
        axis(quantity),
    )
    .caption(note(scenario, comparison, ""));
    let models = comparison.models();
    let symbols = palette::model_symbols(models.iter().copied());
    for (model, symbol) in models.into_iter().zip(symbols) {
        let records: Vec<&ResultRecord> = comparison.of_model(model).collect();
        if records
            .iter()
            .all(|record| record.value(quantity).is_none())
        {
            continue;
        }
        let recommended = recommended(comparison, model);
        let point = |record: &ResultRecord| {
            let value = record.value(quantity).unwrap_or(NONE);
            (record.impact_velocity_m_s, value)
        };
        let emphasised = records
            .iter()
            .zip(&recommended)
            .map(|(record, recommended)| {
                let (speed, value) = point(record);
                (speed, if *recommended { value } else { NONE })
            });
        if recommended.contains(&true) {
            let thick = Series::new("", emphasised).width(EMPHASIS);
            chart = chart.series(thick.color(palette::symbol_color(symbol)));
        }
        let bands = records
            .iter()
            .map(|record| band(record, quantity).unwrap_or((NONE, NONE)));
        let series = Series::new(
            name(model, &recommended),
            records.iter().map(|record| point(record)),
        )
        .style(Style::LineAndMarkers)
        .symbol(symbol)
        .band(bands);
        let ranged = records
            .iter()
            .any(|record| band(record, quantity).is_some());
        chart = chart.series(match ranged {
            true => series.band_name("range of uncertain constants"),
            false => series,
        });
    }
    match versus_speed(&comparison.experiments, quantity) {
        Some(measured) => chart.series(measured),
        None => chart,
    }
}

fn rows(scenario: &Scenario, comparison: &Comparison, quantity: BandQuantity) -> RowChart {
    let speed = comparison.velocities()[0];
    let at = match quantity {
        BandQuantity::BallisticLimit => String::new(),
        _ => format!(" at {} m/s", significant(speed, 4)),
    };
    let any = |has: &dyn Fn(&ResultRecord) -> bool| comparison.results.iter().any(has);
    let bars = match (
        any(&|record| corrected(record, quantity).is_some()),
        any(&|record| corrected(record, quantity).is_none() && band(record, quantity).is_some()),
    ) {
        (true, false) => "bars: depth corrected by the model error, 80 % interval",
        (true, true) => {
            "bars: depth corrected by the model error, 80 % interval, or range of uncertain constants where no error is known"
        }
        (false, true) => "bars: range of uncertain constants",
        (false, false) => "",
    };
    let mut chart = RowChart::new(
        "compare",
        format!("{}{at} by model", title(quantity)),
        axis(quantity),
    )
    .caption(note(scenario, comparison, bars));
    let models = comparison.models();
    let symbols = palette::model_symbols(models.iter().copied());
    for (model, symbol) in models.into_iter().zip(symbols) {
        let mut given = comparison
            .of_model(model)
            .filter(|r| r.value(quantity).is_some());
        let Some(record) = given.next() else {
            continue;
        };
        chart = chart.row(
            name(model, &recommended(comparison, model)),
            record.value(quantity).unwrap_or(f64::NAN),
            corrected(record, quantity).or_else(|| band(record, quantity)),
            palette::symbol_color(symbol),
        );
    }
    for measured in comparison
        .experiments
        .iter()
        .filter(|m| m.quantity == quantity)
    {
        let same = measured
            .impact_velocity_m_s
            .is_none_or(|at| (at - speed).abs() <= 1e-3 * speed);
        if !same && quantity != BandQuantity::BallisticLimit {
            continue;
        }
        let u = measured.uncertainty;
        chart = chart.row(
            "experiment",
            measured.value,
            u.map(|u| (measured.value - u, measured.value + u)),
            palette::EXPERIMENT,
        );
        chart = chart.mark(Mark::vertical("", measured.value));
    }
    chart
}

/// Case in one line, with the meaning of the star and of the bars.
fn note(scenario: &Scenario, comparison: &Comparison, bars: &str) -> String {
    let marked = comparison
        .recommended
        .iter()
        .any(|at| !at.models.is_empty());
    let case = match marked {
        true => format!("{} ({RECOMMENDED} recommended)", caption(scenario, None)),
        false => caption(scenario, None),
    };
    match bars {
        "" => case,
        bars => format!("{case}; {bars}"),
    }
}
