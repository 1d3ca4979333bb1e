//! Table of all models at one velocity.

use percuss::{
    compare::Comparison, outcome::BandQuantity, summary::ResultRecord, units::significant,
};
use percuss_report::table::{Table, number};

use super::quantities;
use crate::{output, table::blocks, terminal::bold};

/// Mark of a recommended model.
pub const RECOMMENDED: &str = "★";

/// The table.
pub fn text(comparison: &Comparison) -> String {
    let speed = comparison.velocities()[0];
    let records: Vec<&ResultRecord> = comparison
        .at_impact_velocity(0)
        .iter()
        .filter(|record| record.is_result())
        .collect();
    let quantities = quantities::quantities(comparison);
    let measured = |quantity| comparison.measured(quantity, speed);
    let any_measured = quantities.iter().any(|q| measured(*q).is_some());
    // The last row holds the measured values, if there are any.
    let mut rows = Table::of(&records)
        .words("model", |record| name(comparison, record.model))
        .last(any_measured.then(|| "experiment".to_owned()));
    for quantity in quantities {
        let measured = measured(quantity);
        let heading = quantity.describe().replace(' ', "\n");
        rows = rows
            .numbers(heading, quantity.unit(), |record| {
                number(record.value(quantity), 4)
            })
            .last(measured.map(|(mean, count)| measurement(comparison, quantity, mean, count)));
        if let Some((measured, _)) = measured.filter(|_| quantities::is_given(comparison, quantity))
        {
            rows = rows.numbers("difference", "%", |record| {
                off_by(record.value(quantity), measured)
            });
        }
    }
    let any = |has: fn(&ResultRecord) -> bool| records.iter().any(|record| has(record));
    let table = rows
        .when(any(|record| record.band.is_some()), |rows| {
            rows.numbers("range", "", |record| {
                range(record, comparison.quantities[0])
            })
        })
        .when(any(|record| record.expected_error.is_some()), |rows| {
            rows.numbers("estimated model\nerror of the depth", "%", |record| {
                let expected = record.expected_error.as_ref();
                expected.map_or_else(String::new, |expected| {
                    expected.describe().replace(" %", "")
                })
            })
        })
        .words("outcome", |record| record.outcome.describe())
        .numbers("warn-\nings", "", |record| match record.warnings.len() {
            0 => String::new(),
            count => count.to_string(),
        });
    blocks(&table.table())
}

/// Name of a model, marked where it is recommended at any velocity.
pub fn name(comparison: &Comparison, model: &str) -> String {
    let recommended = comparison
        .recommended
        .iter()
        .any(|at| at.models.iter().any(|choice| choice.model == model));
    match recommended {
        true => format!("{model} {RECOMMENDED}"),
        false => model.to_owned(),
    }
}

/// Difference from a measured value in per cent, with its sign.
pub fn off_by(value: Option<f64>, measured: f64) -> String {
    match value {
        Some(value) if measured != 0.0 => format!("{:+.1}", 100.0 * (value / measured - 1.0)),
        _ => number(None, 0),
    }
}

fn measurement(comparison: &Comparison, quantity: BandQuantity, mean: f64, count: usize) -> String {
    if count > 1 {
        return format!("{} (mean of {count})", significant(mean, 4));
    }
    let uncertainty = comparison
        .experiments
        .iter()
        .find(|measured| measured.quantity == quantity && measured.value == mean)
        .and_then(|measured| measured.uncertainty);
    match uncertainty {
        Some(uncertainty) => format!("{} ± {}", significant(mean, 4), significant(uncertainty, 2)),
        None => significant(mean, 4),
    }
}

/// Ends of a range, with its quantity where that is not the main one.
fn range(record: &ResultRecord, leading: BandQuantity) -> String {
    let Some(band) = &record.band else {
        return String::new();
    };
    let ends = format!("{}–{}", significant(band.low, 3), significant(band.high, 3));
    match band.quantity == leading {
        true => ends,
        false => format!("{} {ends}", band.quantity.describe()),
    }
}

/// One line of NAME=VALUE pairs per velocity and model.
pub fn lines(comparison: &Comparison) -> String {
    comparison
        .results
        .iter()
        .map(|record| {
            let outcome = serde_json::json!(record.outcome);
            format!(
                "model={} impact_velocity_m_s={} outcome={} {} warnings={}\n",
                record.model,
                record.impact_velocity_m_s,
                outcome.as_str().unwrap_or_default(),
                output::main_numbers(record),
                record.warnings.len(),
            )
        })
        .collect()
}

/// Heading of a block of numbers.
pub fn heading(words: &str) -> String {
    format!("{}\n", bold(words))
}
