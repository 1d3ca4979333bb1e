//! Models without a result at some or all velocities, with the reasons.

use percuss::{
    compare::Comparison,
    outcome::{BandQuantity, Outcome},
};

use super::messages::grouped;
use crate::{
    by_models::by_models,
    terminal::{bold, width, wrap},
};

/// List below the tables; empty when every model has all results.
pub fn text(comparison: &Comparison) -> String {
    let mut lines = reasons(comparison);
    lines.extend(silent(comparison));
    if lines.is_empty() {
        return String::new();
    }
    let entries: String = lines
        .iter()
        .map(|line| format!("  {}\n", wrap(line, width() - 2, 4)))
        .collect();
    format!("{}\n{entries}\n", bold("without a result"))
}

/// One line per reason: models, velocities and reason.
pub fn reasons(comparison: &Comparison) -> Vec<String> {
    let mut entries = Vec::new();
    for model in comparison.models() {
        for outcome in [Outcome::NotApplicable, Outcome::Failed] {
            entries.extend(why(comparison, model, outcome).map(|why| (model, why)));
        }
    }
    by_models(entries)
}

/// Velocities at which a model has no result, with the reasons; reasons that differ only in numbers are merged.
fn why(comparison: &Comparison, model: &str, outcome: Outcome) -> Option<String> {
    let speeds = comparison.velocities();
    let absent = comparison
        .of_model(model)
        .enumerate()
        .filter(|(_, record)| record.outcome == outcome)
        .map(|(speed, record)| {
            let reason = record.reason.as_deref();
            (speed, reason.unwrap_or("no reason given"))
        });
    let messages = grouped(absent, speeds.len());
    let what = match outcome {
        Outcome::Failed => "failed",
        _ => "not applicable",
    };
    match messages.as_slice() {
        [] => None,
        [one] => {
            let because = match outcome {
                Outcome::Failed => ":",
                _ => ", because",
            };
            let (place, reason) = (one.place(&speeds), one.describe(&speeds));
            Some(format!("{what}{place}{because} {reason}"))
        }
        several => {
            let each = several.iter().map(|message| {
                let (place, reason) = (message.place(&speeds), message.describe(&speeds));
                format!("{}: {reason}", place.trim_start())
            });
            Some(format!("{what} {}", each.collect::<Vec<_>>().join("; ")))
        }
    }
}

/// Models whose results lack the main quantity.
fn silent(comparison: &Comparison) -> Vec<String> {
    let Some(leading) = comparison.quantities.first() else {
        return Vec::new();
    };
    let models = comparison.models().into_iter().filter(|model| {
        let mut records = comparison
            .of_model(model)
            .filter(|r| r.is_result())
            .peekable();
        records.peek().is_some() && records.all(|r| r.value(*leading).is_none())
    });
    models
        .map(|model| {
            format!(
                "{model}: gives no {}{}",
                leading.describe(),
                gives(comparison, model)
            )
        })
        .collect()
}

/// Quantities that a model gives instead of the main one.
fn gives(comparison: &Comparison, model: &str) -> String {
    let given: Vec<&str> = BandQuantity::ALL
        .iter()
        .filter(|quantity| {
            comparison
                .of_model(model)
                .any(|r| r.value(**quantity).is_some())
        })
        .map(|quantity| quantity.describe())
        .collect();
    match given.as_slice() {
        [] => String::new(),
        _ => format!(", but {}", given.join(", ")),
    }
}
