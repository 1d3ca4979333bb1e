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

/// One line a kind of absence: which models, where, and why.
pub fn reasons(comparison: &Comparison) -> Vec<String> {
    let mut groups: Vec<(Vec<&str>, String)> = Vec::new();
    for model in comparison.models() {
        for outcome in [Outcome::NotApplicable, Outcome::Failed] {
            let Some(why) = why(comparison, model, outcome) else {
                continue;
            };
            match groups.iter_mut().find(|group| group.1 == why) {
                Some(group) => group.0.push(model),
                None => groups.push((vec![model], why)),
            }
        }
    }
    groups
        .into_iter()
        .map(|(models, why)| format!("{}: {why}", models.join(", ")))
        .collect()
}

/// Where a model has an outcome that is no result, and the reason at the first such speed.
fn why(comparison: &Comparison, model: &str, outcome: Outcome) -> Option<String> {
    let speeds = comparison.speeds();
    let records: Vec<&ResultRecord> = comparison.of_model(model).collect();
    let absent: Vec<bool> = records.iter().map(|r| r.outcome == outcome).collect();
    let first = absent.iter().position(|absent| *absent)?;
    let at = match absent.iter().all(|absent| *absent) {
        true => String::new(),
        false => format!(" at {}", ranges(&speeds, &absent)),
    };
    let reason = records[first]
        .reason
        .as_deref()
        .unwrap_or("it does not say why");
    // A reason with numbers in it may hold for one speed only.
    let speed = speed_range(&speeds[first..=first]);
    let differs = records
        .iter()
        .any(|r| r.outcome == outcome && r.reason != records[first].reason);
    let of = match differs && !reason.contains(&speed) {
        true => format!(" (at {speed})"),
        false => String::new(),
    };
    Some(match outcome {
        Outcome::Failed => format!("failed{at}: {reason}{of}"),
        _ => format!("not applicable{at}, because {reason}{of}"),
    })
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
                "{model}: gives no {}{}",
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
        _ => format!(", but {}", given.join(", ")),
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
