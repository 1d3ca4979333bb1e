//! Models that give nothing, or nothing at some of the speeds, and why.

use percuss::{
    compare::Comparison,
    outcome::{BandQuantity, Outcome},
    summary::ResultRecord,
};

use super::head::speed_range;
use crate::terminal::{bold, width, wrap};

/// The list below the tables; empty when every model says everything.
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

/// One line a model and kind of absence: where, and why.
pub fn reasons(comparison: &Comparison) -> Vec<String> {
    let speeds = comparison.speeds();
    let mut lines = Vec::new();
    for model in comparison.models() {
        let records: Vec<&ResultRecord> = comparison.of_model(model).collect();
        for outcome in [Outcome::NotApplicable, Outcome::Failed] {
            let absent: Vec<bool> = records.iter().map(|r| r.outcome == outcome).collect();
            let Some(first) = absent.iter().position(|absent| *absent) else {
                continue;
            };
            let everywhere = absent.iter().all(|absent| *absent);
            let at = match everywhere {
                true => String::new(),
                false => format!(" at {}", ranges(&speeds, &absent)),
            };
            let reason = records[first]
                .reason
                .as_deref()
                .unwrap_or("it does not say why");
            // A reason with numbers in it may hold for one speed only.
            let differs = records
                .iter()
                .any(|r| r.outcome == outcome && r.reason != records[first].reason);
            let of = match differs {
                true => format!(" ({} m/s)", speeds[first]),
                false => String::new(),
            };
            lines.push(match outcome {
                Outcome::Failed => format!("{model} failed{at}: {reason}{of}"),
                _ => format!("{model} is not applicable{at}, because {reason}{of}"),
            });
        }
    }
    lines
}

/// Models with results that lack the leading quantity.
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
                "{model} gives no {}{}",
                leading.in_words(),
                gives(comparison, model)
            )
        })
        .collect()
}

/// What a model gives in place of the leading quantity.
fn gives(comparison: &Comparison, model: &str) -> String {
    let given: Vec<&str> = BandQuantity::ALL
        .iter()
        .filter(|quantity| {
            comparison
                .of_model(model)
                .any(|r| r.value(**quantity).is_some())
        })
        .map(|quantity| quantity.in_words())
        .collect();
    match given.as_slice() {
        [] => String::new(),
        _ => format!(", but: {}", given.join(", ")),
    }
}

/// `200 to 300 m/s and 450 m/s`: where a flag is set.
fn ranges(speeds: &[f64], flags: &[bool]) -> String {
    let mut parts = Vec::new();
    let mut from = 0;
    for run in flags.chunk_by(|a, b| a == b) {
        if run[0] {
            parts.push(speed_range(&speeds[from..from + run.len()]));
        }
        from += run.len();
    }
    parts.join(" and ")
}
