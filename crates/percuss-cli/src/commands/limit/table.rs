//! What is printed of limits and of V50.

use percuss::{
    Scenario,
    limit::{LimitOutcome, Limits, ModelLimit, Tolerance},
    units::significant,
    v50::{Estimate, Method, Pattern, V50},
};

use super::values;
use crate::{
    table::{Column, blocks},
    terminal::{bold, counted, width, wrap, yellow},
};

/// Case, range and tolerance.
pub fn head(scenario: &Scenario, limits: &Limits, tolerance: Tolerance) -> String {
    let title = match scenario.title.is_empty() {
        true => &scenario.name,
        false => &scenario.title,
    };
    let line = format!(
        "case {}, searched from {} to {} m/s, brackets of {} or less",
        limits.case,
        significant(limits.searched_m_s.0, 4),
        significant(limits.searched_m_s.1, 4),
        values::in_words(tolerance)
    );
    let (title, line) = (wrap(title, width(), 0), wrap(&line, width(), 0));
    format!("{}\n{line}\n\n", bold(title))
}

/// Table of limits, warnings, and models without a limit.
pub fn text(limits: &Limits) -> String {
    let found: Vec<&ModelLimit> = limits.results.iter().filter(|l| is_found(l)).collect();
    let mut text = String::new();
    if found.is_empty() {
        text += "no model finds a limit in this range\n\n";
    } else {
        text += &numbers(limits, &found);
    }
    for limit in &limits.results {
        for warning in &limit.warnings {
            let line = format!("warning: {}: {warning}", limit.model);
            let line = wrap(&line, width(), 9);
            text += &line.replacen("warning:", &yellow("warning:"), 1);
            text += "\n\n";
        }
    }
    let reasons = reasons(limits);
    if !reasons.is_empty() {
        text += &format!("{}\n", bold("without a limit"));
        for reason in reasons {
            text += &format!("  {}\n", wrap(&reason, width() - 2, 4));
        }
        text.push('\n');
    }
    text
}

fn is_found(limit: &ModelLimit) -> bool {
    limit.outcome == LimitOutcome::Found
}

fn numbers(limits: &Limits, found: &[&ModelLimit]) -> String {
    let measured = limits.measured();
    let column = |heading: &str, last: &str, cell: &dyn Fn(&ModelLimit) -> String| {
        let mut cells: Vec<String> = found.iter().map(|limit| cell(limit)).collect();
        cells.extend(measured.map(|_| last.to_owned()));
        Column {
            heading: heading.to_owned(),
            cells,
            numbers: true,
        }
    };
    let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |v| significant(v, 4));
    let first = Column {
        numbers: false,
        ..column("model", "experiment", &|limit| limit.model.to_owned())
    };
    let measured_words = measured.map_or_else(String::new, |(value, count)| match count {
        1 => significant(value, 4),
        _ => format!("{} (mean of {count})", significant(value, 4)),
    });
    let mut columns = vec![column(
        "ballistic\nlimit\n[m/s]",
        &measured_words,
        &|limit| number(limit.ballistic_limit_m_s),
    )];
    if let Some((measured, _)) = measured {
        columns.push(column("off by\n[%]", "", &|limit| {
            let limit = limit.ballistic_limit_m_s;
            limit.map_or_else(String::new, |v| {
                format!("{:+.1}", 100.0 * (v / measured - 1.0))
            })
        }));
    }
    columns.push(column("fastest\nstopped\n[m/s]", "", &|limit| {
        number(limit.bracket.map(|bracket| bracket.stopped_m_s))
    }));
    columns.push(column("slowest\nthrough\n[m/s]", "", &|limit| {
        number(limit.bracket.map(|bracket| bracket.perforated_m_s))
    }));
    columns.push(column("runs", "", &|limit| limit.runs.to_string()));
    if found.iter().any(|limit| limit.fit.is_some()) {
        let fit = |limit: &ModelLimit, of: fn(&percuss::limit::LambertJonasFit) -> f64| {
            number(limit.fit.as_ref().map(of))
        };
        columns.push(column("fitted\na", "", &|limit| fit(limit, |fit| fit.a)));
        columns.push(column("fitted\np", "", &|limit| fit(limit, |fit| fit.p)));
        columns.push(column("fitted\nlimit\n[m/s]", "", &|limit| {
            fit(limit, |fit| fit.ballistic_limit_m_s)
        }));
        columns.push(column("rms\n[m/s]", "", &|limit| {
            let rms = limit.fit.as_ref().map(|fit| fit.rms_m_s);
            rms.map_or_else(|| "–".to_owned(), |rms| format!("{rms:.2}"))
        }));
    }
    blocks(&first, columns)
}

/// One line for each reason why models have no limit.
pub fn reasons(limits: &Limits) -> Vec<String> {
    let mut lines: Vec<(Vec<&str>, String)> = Vec::new();
    for limit in limits.results.iter().filter(|limit| !is_found(limit)) {
        let reason = limit.reason.as_deref().unwrap_or("it does not say why");
        let words = match limit.outcome {
            LimitOutcome::NotApplicable => format!("not applicable, because {reason}"),
            other => format!("{}: {reason}", other.in_words()),
        };
        match lines.iter_mut().find(|(_, said)| *said == words) {
            Some((models, _)) => models.push(limit.model),
            None => lines.push((vec![limit.model], words)),
        }
    }
    lines
        .into_iter()
        .map(|(models, words)| format!("{}: {words}", models.join(", ")))
        .collect()
}

/// One line a model, for scripts.
pub fn lines(limits: &Limits) -> String {
    let value = |value: Option<f64>| value.map_or_else(|| "none".to_owned(), |v| significant(v, 6));
    let line = |limit: &ModelLimit| {
        format!(
            "model={} outcome={} ballistic_limit_m_s={} stopped_m_s={} perforated_m_s={} runs={} warnings={}\n",
            limit.model,
            limit.outcome.in_words().replace(' ', "_"),
            value(limit.ballistic_limit_m_s),
            value(limit.bracket.map(|bracket| bracket.stopped_m_s)),
            value(limit.bracket.map(|bracket| bracket.perforated_m_s)),
            limit.runs,
            limit.warnings.len()
        )
    };
    limits.results.iter().map(line).collect()
}

/// V50 of shots by every method.
pub fn v50_text(file: &str, v50: &V50) -> String {
    let line = format!(
        "{} of {file}: {} stopped, {} went through; {}",
        counted(v50.shots, "shot"),
        v50.shots - v50.perforated,
        v50.perforated,
        pattern(v50)
    );
    let mut text = format!("{}\n{}\n\n", bold("V50"), wrap(&line, width(), 0));
    let column = |heading: &str, cell: &dyn Fn(&Estimate) -> String| Column {
        heading: heading.to_owned(),
        cells: v50.estimates.iter().map(cell).collect(),
        numbers: true,
    };
    let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |v| significant(v, 5));
    let first = Column {
        numbers: false,
        ..column("method", &|entry| entry.method.in_words().to_owned())
    };
    let percent = format!("{:.0} %", 100.0 * v50.confidence);
    text += &blocks(
        &first,
        vec![
            column("V50\n[m/s]", &|entry| number(entry.v50_m_s)),
            column(&format!("{percent} interval\n[m/s]"), &interval),
            column("standard\nerror\n[m/s]", &|entry| {
                number(entry.standard_error_m_s)
            }),
            column("scatter of\nshots\n[m/s]", &|entry| {
                number(entry.standard_deviation_m_s)
            }),
            column("shots\nused", &|entry| match entry.shots_used {
                Some(used) => used.to_string(),
                None if entry.v50_m_s.is_some() => v50.shots.to_string(),
                None => "–".to_owned(),
            }),
            column("span\n[m/s]", &|entry| number(entry.span_m_s)),
        ],
    );
    for (methods, reason) in absent(v50) {
        text += &format!("{}\n\n", wrap(&format!("{methods}: {reason}"), width(), 2));
    }
    text
}

fn interval(entry: &Estimate) -> String {
    let end = |value: Option<f64>, none: &str| value.map_or(none.to_owned(), |v| significant(v, 5));
    let ends = (entry.low_m_s, entry.high_m_s);
    match (entry.method, ends, entry.v50_m_s) {
        (Method::MeanOfExtremes, ..) | (_, (None, None), None) => "–".to_owned(),
        (_, (low, high), _) => format!("{} to {}", end(low, "no end"), end(high, "no end")),
    }
}

fn pattern(v50: &V50) -> String {
    let speed = |value: Option<f64>| value.map_or_else(String::new, |v| significant(v, 6));
    let (stopped, through) = (
        speed(v50.highest_stopped_m_s),
        speed(v50.lowest_perforated_m_s),
    );
    match v50.pattern {
        Pattern::Mixed => format!("mixed results from {through} to {stopped} m/s"),
        Pattern::Separated => {
            format!("no mixed results: stopped up to {stopped} m/s, through from {through} m/s on")
        }
        Pattern::Reversed => "the faster ones were stopped".to_owned(),
        Pattern::AllStopped => "none went through".to_owned(),
        Pattern::AllPerforated => "none was stopped".to_owned(),
    }
}

/// Methods without a V50, with the reason that they share.
fn absent(v50: &V50) -> Vec<(String, String)> {
    let mut reasons: Vec<(String, String)> = Vec::new();
    for entry in &v50.estimates {
        let Some(reason) = &entry.reason else {
            continue;
        };
        match reasons.iter_mut().find(|(_, said)| said == reason) {
            Some((methods, _)) => *methods += &format!(", {}", entry.method.in_words()),
            None => reasons.push((entry.method.in_words().to_owned(), reason.clone())),
        }
    }
    reasons
}

/// One line a method, for scripts.
pub fn v50_lines(v50: &V50) -> String {
    let value = |value: Option<f64>| value.map_or_else(|| "none".to_owned(), |v| significant(v, 6));
    let line = |entry: &Estimate| {
        format!(
            "method={} v50_m_s={} low_m_s={} high_m_s={} standard_deviation_m_s={}\n",
            entry.method.in_words().replace(' ', "_"),
            value(entry.v50_m_s),
            value(entry.low_m_s),
            value(entry.high_m_s),
            value(entry.standard_deviation_m_s)
        )
    };
    v50.estimates.iter().map(line).collect()
}
