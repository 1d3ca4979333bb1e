//! Tables of all models at many velocities: one row per velocity, one column per model, split into blocks of the terminal's width.

use percuss::{
    axisymmetric::MODEL, compare::Comparison, outcome::BandQuantity, summary::ResultRecord,
    units::significant,
};
use percuss_report::table::{Table, number};

use super::{
    quantities,
    single::{RECOMMENDED, heading, name, off_by},
};
use crate::{
    table::blocks,
    terminal::{width, wrap},
};

/// Tables of all relevant quantities and their differences from experiments.
pub fn text(comparison: &Comparison) -> String {
    let mut text = String::new();
    for quantity in quantities::quantities(comparison) {
        let given: Vec<&str> = comparison
            .models()
            .into_iter()
            .filter(|model| {
                comparison
                    .of_model(model)
                    .any(|r| r.value(quantity).is_some())
            })
            .collect();
        text += &match quantity {
            BandQuantity::BallisticLimit => limits(comparison, &given),
            _ => versus_velocity(comparison, quantity, &given),
        };
    }
    text + &model_errors(comparison)
}

/// Range over the velocities of the median estimated model error of the depth, in one line for all models.
fn model_errors(comparison: &Comparison) -> String {
    let percent = |error: f64| format!("{:+.0}", 100.0 * error + 0.0).replace('-', "\u{2212}");
    let ranges: Vec<String> = comparison
        .models()
        .into_iter()
        .filter_map(|model| {
            let expected = comparison
                .of_model(model)
                .filter_map(|r| r.expected_error.as_ref());
            let medians: Vec<f64> = expected.map(|expected| expected.median).collect();
            let low = medians.iter().copied().reduce(f64::min)?;
            let high = medians.iter().copied().reduce(f64::max)?;
            let range = match percent(low) == percent(high) {
                true => percent(low),
                false => format!("{} to {}", percent(low), percent(high)),
            };
            Some(format!("{model} {range} %"))
        })
        .collect();
    if ranges.is_empty() {
        return String::new();
    }
    let words = format!(
        "estimated model error of the depth against the axisymmetric reference, range of the medians: {}",
        ranges.join(", ")
    );
    format!("{}\n\n", wrap(&words, width(), 2))
}

fn versus_velocity(comparison: &Comparison, quantity: BandQuantity, models: &[&str]) -> String {
    let speeds = comparison.velocities();
    let measured = |i: usize| {
        let measured = comparison.measured(quantity, speeds[i]);
        measured.map(|(value, _)| value)
    };
    let all: Vec<usize> = (0..speeds.len()).collect();
    let compared: Vec<usize> = all
        .iter()
        .copied()
        .filter(|i| measured(*i).is_some())
        .collect();
    let speed = |i: &usize| significant(speeds[*i], 4);
    let values = |model: &str| -> Vec<Option<f64>> {
        let records = comparison.of_model(model);
        records.map(|record| record.value(quantity)).collect()
    };
    let table = Table::of(&all)
        .numbers("velocity", "m/s", speed)
        .when(!compared.is_empty(), |rows| {
            rows.numbers("exper-\niment", "", |&i| number(measured(i), 4))
        })
        .each(models, |rows, model| {
            let values = values(model);
            let rows = rows.numbers(model_heading(comparison, model), "", |&i| {
                number(values[i], 4)
            });
            let off = uncertainties(comparison, quantity, model);
            rows.when(off.iter().any(Option::is_some), |rows| {
                rows.numbers("±", "", |&i| number(off[i], 2))
            })
        });
    let mut text = heading(&format!("{} [{}]", quantity.describe(), quantity.unit()));
    text += &blocks(&table.table());
    if !compared.is_empty() && !models.is_empty() {
        text += &heading(&format!(
            "{}, difference from experiment [%]",
            quantity.describe()
        ));
        let off =
            Table::of(&compared)
                .numbers("velocity", "m/s", speed)
                .each(models, |rows, model| {
                    let values = values(model);
                    rows.numbers(model_heading(comparison, model), "", |&i| {
                        measured(i).map_or_else(String::new, |measured| off_by(values[i], measured))
                    })
                });
        text += &blocks(&off.table());
    }
    text
}

/// Half widths of the discretisation uncertainty at the velocities; only the axisymmetric model states it.
fn uncertainties(comparison: &Comparison, quantity: BandQuantity, model: &str) -> Vec<Option<f64>> {
    let of = |record: &ResultRecord| {
        let band = record.band.as_ref();
        let band = band.filter(|band| model == MODEL && band.quantity == quantity)?;
        Some(band.high - record.value(quantity)?)
    };
    comparison.of_model(model).map(of).collect()
}

/// Ballistic limits, one row per model.
fn limits(comparison: &Comparison, models: &[&str]) -> String {
    let quantity = BandQuantity::BallisticLimit;
    let measured = comparison.measured(quantity, 0.0);
    let title = heading("ballistic limit [m/s]");
    if models.is_empty() {
        let measured = number(measured.map(|(value, _)| value), 4);
        return format!("{title}{measured} measured; no model predicts it\n\n");
    }
    let value = |model: &str| comparison.of_model(model).find_map(|r| r.value(quantity));
    let mut rows = Table::of(models)
        .words("model", |model| name(comparison, model))
        .numbers("limit", "", |model| number(value(model), 4));
    if let Some((measured, _)) = measured {
        let heading = format!("difference from {} [%]", significant(measured, 4));
        rows = rows.numbers(heading, "", |model| off_by(value(model), measured));
    }
    title + &blocks(&rows.table())
}

/// Name of a model in several short lines.
fn model_heading(comparison: &Comparison, model: &str) -> String {
    let heading = model.replace('_', "\n");
    match name(comparison, model).ends_with(RECOMMENDED) {
        true => format!("{heading} {RECOMMENDED}"),
        false => heading,
    }
}
