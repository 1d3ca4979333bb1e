//! Recommended models, range and estimated model errors of limits, and residual velocities above limits that are inputs.

use percuss::{
    limit::{LambertJonasFit, LimitOutcome, Limits, ModelLimit},
    units::significant,
};
use percuss_report::table::{Table, number};

use super::table::last_velocity;

use crate::{
    table::blocks,
    terminal::{bold, width, wrap},
};

/// Recommended model, range over the models, and estimated model errors from published limits.
pub fn text(limits: &Limits) -> String {
    let mut lines: Vec<String> = limits
        .recommended
        .iter()
        .map(|choice| format!("★ recommended: {}: {}", choice.model, choice.because))
        .collect();
    lines.extend(limits.note.clone());
    if let Some(range) = limits.range.filter(|range| range.models > 1) {
        lines.push(format!(
            "range of {} models within their ranges of validity: {} to {} m/s",
            range.models,
            significant(range.lowest_m_s, 4),
            significant(range.highest_m_s, 4)
        ));
    }
    lines.extend(limits.results.iter().filter_map(|limit| {
        let expected = limit.expected_error.as_ref()?;
        let (model, words) = (limit.model, expected.describe());
        Some(format!("estimated model error of {model}: {words}"))
    }));
    let without = limits.without_expected_error();
    if !without.is_empty() {
        lines.push(format!(
            "no estimated model error of {}: fewer than 5 published limits of this kind were compared",
            without.join(", ")
        ));
    }
    if lines.is_empty() {
        return String::new();
    }
    let line = |line: &String| format!("{}\n", wrap(line, width(), 2));
    lines.iter().map(line).collect::<String>() + "\n"
}

/// Residual velocities of the models that take a limit as input; empty without any.
pub fn inputs(limits: &Limits) -> String {
    let inputs: Vec<&ModelLimit> = limits
        .results
        .iter()
        .filter(|limit| limit.outcome == LimitOutcome::Input)
        .collect();
    if inputs.is_empty() {
        return String::new();
    }
    let fit =
        |limit: &ModelLimit, of: fn(&LambertJonasFit) -> f64| number(limit.fit.as_ref().map(of), 4);
    let table = Table::of(&inputs)
        .words("model", |limit| limit.model)
        .numbers("input\nlimit", "m/s", |limit| {
            let input = limit.input_limit.map(|input| input.ballistic_limit_m_s);
            input.map_or_else(String::new, |limit| significant(limit, 4))
        })
        .words("from", |limit| {
            let input = limit.input_limit.as_ref();
            input.map_or_else(String::new, |input| input.origin_in_words().to_owned())
        })
        .numbers("points", "", |limit| limit.curve.len().to_string())
        .numbers("to", "m/s", |limit| last_velocity(limit))
        .numbers("a", "", |limit| fit(limit, |fit| fit.a))
        .numbers("p", "", |limit| fit(limit, |fit| fit.p))
        .table();
    let title = "residual velocity above a given limit (an input, not a prediction of the limit)";
    format!("{}\n{}", bold(wrap(title, width(), 0)), blocks(&table))
}
