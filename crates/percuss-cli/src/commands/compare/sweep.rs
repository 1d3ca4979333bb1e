//! Every model at many speeds: a row a speed, a column a model, in as many blocks as the terminal's width asks for.

use percuss::{compare::Comparison, outcome::BandQuantity, units::significant};

use super::{
    shown,
    single::{RECOMMENDED, heading, name, number, off_by},
};
use crate::{
    table::{Column, blocks},
    terminal::{width, wrap},
};

/// Tables of all relevant quantities, and how far they are from experiment.
pub fn text(comparison: &Comparison) -> String {
    let mut text = String::new();
    for quantity in shown::quantities(comparison) {
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
            _ => over_speed(comparison, quantity, &given),
        };
    }
    text + &expected_errors(comparison)
}

/// Medians of the errors to expect of the depths, from the smallest to the largest over the speeds, a line for all models.
fn expected_errors(comparison: &Comparison) -> String {
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
        "expected error of the depth against the axisymmetric reference, median at each speed: {}",
        ranges.join(", ")
    );
    format!("{}\n\n", wrap(&words, width(), 2))
}

fn over_speed(comparison: &Comparison, quantity: BandQuantity, models: &[&str]) -> String {
    let speeds = comparison.speeds();
    let all: Vec<usize> = (0..speeds.len()).collect();
    let compared: Vec<usize> = all
        .iter()
        .copied()
        .filter(|&i| comparison.measured(quantity, speeds[i]).is_some())
        .collect();
    let values = |model: &str, rows: &[usize]| -> Vec<Option<f64>> {
        let values: Vec<_> = comparison
            .of_model(model)
            .map(|r| r.value(quantity))
            .collect();
        rows.iter().map(|&i| values[i]).collect()
    };
    let speed_column = |rows: &[usize]| Column {
        heading: "speed\n[m/s]".to_owned(),
        cells: rows.iter().map(|&i| significant(speeds[i], 4)).collect(),
        numbers: true,
    };
    let experiment = |rows: &[usize]| Column {
        heading: "exper-\niment".to_owned(),
        cells: rows
            .iter()
            .map(|&i| {
                number(
                    comparison
                        .measured(quantity, speeds[i])
                        .map(|(value, _)| value),
                )
            })
            .collect(),
        numbers: true,
    };
    let columns = |rows: &[usize], cell: &dyn Fn(usize, Option<f64>) -> String| -> Vec<Column> {
        models
            .iter()
            .map(|model| Column {
                heading: model_heading(comparison, model),
                cells: rows
                    .iter()
                    .zip(values(model, rows))
                    .map(|(&i, value)| cell(i, value))
                    .collect(),
                numbers: true,
            })
            .collect()
    };
    let mut text = heading(&format!("{} [{}]", quantity.in_words(), quantity.unit()));
    let mut shown = columns(&all, &|_, value| number(value));
    if !compared.is_empty() {
        shown.insert(0, experiment(&all));
    }
    text += &blocks(&speed_column(&all), shown);
    if !compared.is_empty() && !models.is_empty() {
        text += &heading(&format!("{}, off experiment by [%]", quantity.in_words()));
        let off = columns(&compared, &|i, value| {
            let measured = comparison.measured(quantity, speeds[i]);
            measured.map_or_else(String::new, |(measured, _)| off_by(value, measured))
        });
        text += &blocks(&speed_column(&compared), off);
    }
    text
}

/// Ballistic limits do not depend on the speed: a row a model.
fn limits(comparison: &Comparison, models: &[&str]) -> String {
    let quantity = BandQuantity::BallisticLimit;
    let measured = comparison.measured(quantity, 0.0);
    let title = heading("ballistic limit [m/s]");
    if models.is_empty() {
        let measured = number(measured.map(|(value, _)| value));
        return format!("{title}{measured} measured; no model gives one\n\n");
    }
    let value = |model: &str| comparison.of_model(model).find_map(|r| r.value(quantity));
    let first = Column {
        heading: "model".to_owned(),
        cells: models.iter().map(|model| name(comparison, model)).collect(),
        numbers: false,
    };
    let mut columns = vec![Column {
        heading: "limit".to_owned(),
        cells: models.iter().map(|model| number(value(model))).collect(),
        numbers: true,
    }];
    if let Some((measured, _)) = measured {
        columns.push(Column {
            heading: format!("off {} by [%]", significant(measured, 4)),
            cells: models
                .iter()
                .map(|model| off_by(value(model), measured))
                .collect(),
            numbers: true,
        });
    }
    title + &blocks(&first, columns)
}

/// Name of a model over lines that are short.
fn model_heading(comparison: &Comparison, model: &str) -> String {
    let heading = model.replace('_', "\n");
    match name(comparison, model).ends_with(RECOMMENDED) {
        true => format!("{heading} {RECOMMENDED}"),
        false => heading,
    }
}
