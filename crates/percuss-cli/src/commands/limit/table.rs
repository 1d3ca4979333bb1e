//! Terminal output of `percuss limit`: ballistic limits and V50.

use percuss::{
    Scenario, axisymmetric,
    limit::{LambertJonasFit, LimitOutcome, Limits, ModelLimit, RearFace, Tolerance},
    units::significant,
    v50::{Estimate, Method, Pattern, V50},
};
use percuss_report::{
    axisymmetric_limit, limit_headline,
    table::{Table, number},
};

use super::{reliance, values};
use crate::{
    by_models::by_models,
    table::blocks,
    terminal::{self, bold, counted, paragraph, title, width, wrap},
};

/// Case, range and tolerance.
pub fn head(scenario: &Scenario, limits: &Limits, tolerance: Tolerance) -> String {
    let line = format!(
        "case {}, searched from {} to {} m/s, brackets of {} or less",
        limits.case,
        significant(limits.searched_m_s.0, 4),
        significant(limits.searched_m_s.1, 4),
        values::describe(tolerance)
    );
    let rear_face = limits.rear_face.and_then(RearFace::describe);
    let rear_face = rear_face.map_or_else(String::new, |words| paragraph(&words));
    format!("{}{}{rear_face}\n", title(scenario), paragraph(&line))
}

/// Table of limits, warnings, and models without a limit.
pub fn text(limits: &Limits) -> String {
    let found: Vec<&ModelLimit> = limits.results.iter().filter(|l| is_found(l)).collect();
    let mut text = limit_headline(limits).map_or_else(String::new, |line| {
        format!("{}\n\n", bold(wrap(&line, width(), 0)))
    });
    text += &axisymmetric(limits);
    if found.is_empty() {
        text += "no model finds a limit in this range\n\n";
    } else {
        text += &numbers(limits, &found);
    }
    text += &reliance::text(limits);
    text += &curves(&found);
    text += &reliance::inputs(limits);
    let said = limits.results.iter().flat_map(|limit| {
        let warnings = limit.warnings.iter();
        warnings.map(|warning| (limit.model, warning.clone()))
    });
    for line in by_models(said) {
        text += &format!("{}\n", terminal::warning(&line));
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

/// Limit by the axisymmetric model, and what its meshes gave.
fn axisymmetric(limits: &Limits) -> String {
    let Some(limit) = &limits.axisymmetric else {
        return String::new();
    };
    let mut text = match axisymmetric_limit(limits) {
        // The first line has it.
        Some(_) if limits.is_recommended(axisymmetric::MODEL) => String::new(),
        Some(shown) => paragraph(&format!("axisymmetric limit {shown}")),
        None => paragraph(&format!(
            "no axisymmetric ballistic limit: {}",
            limit.reason.as_deref().unwrap_or("no reason given")
        )),
    };
    let table = Table::of(&limit.meshes)
        .numbers("cells per\nradius", "", |mesh| {
            mesh.cells_per_radius.to_string()
        })
        .numbers("ballistic\nlimit", "m/s", |mesh| {
            number(mesh.ballistic_limit_m_s, 4)
        })
        .numbers("highest\npartial", "m/s", |mesh| {
            number(mesh.bracket.map(|bracket| bracket.stopped_m_s), 4)
        })
        .numbers("lowest\ncomplete", "m/s", |mesh| {
            number(mesh.bracket.map(|bracket| bracket.perforated_m_s), 4)
        })
        .numbers("runs", "", |mesh| mesh.runs.to_string());
    if limit.meshes.iter().any(|mesh| mesh.bracket.is_some()) {
        text += &blocks(&table.table());
    }
    for warning in &limit.warnings {
        text += &format!(
            "{}\n",
            terminal::warning(&format!("axi on the finest mesh: {warning}"))
        );
    }
    text
}

fn is_found(limit: &ModelLimit) -> bool {
    limit.outcome == LimitOutcome::Found
}

fn numbers(limits: &Limits, found: &[&ModelLimit]) -> String {
    let measured = limits.measured();
    let measured_words = measured.map(|(value, count)| match count {
        1 => significant(value, 4),
        _ => format!("{} (mean of {count})", significant(value, 4)),
    });
    let mut rows = Table::of(found)
        .words("model", |limit| {
            let star = if limits.is_recommended(limit.model) {
                " ★"
            } else {
                ""
            };
            format!("{}{star}", limit.model)
        })
        .last(measured.map(|_| "experiment".to_owned()))
        .numbers("ballistic\nlimit", "m/s", |limit| {
            number(limit.ballistic_limit_m_s, 4)
        })
        .last(measured_words);
    if let Some((measured, _)) = measured {
        rows = rows.numbers("difference", "%", |limit| {
            let limit = limit.ballistic_limit_m_s;
            limit.map_or_else(String::new, |v| {
                // Rounded before it is written, so that no zero is negative.
                format!(
                    "{:+.1}",
                    (1000.0 * (v / measured - 1.0)).round() / 10.0 + 0.0
                )
            })
        });
    }
    let table = rows
        .numbers("highest\npartial", "m/s", |limit| {
            number(limit.bracket.map(|bracket| bracket.stopped_m_s), 4)
        })
        .numbers("lowest\ncomplete", "m/s", |limit| {
            number(limit.bracket.map(|bracket| bracket.perforated_m_s), 4)
        })
        .numbers("runs", "", |limit| limit.runs.to_string());
    blocks(&table.table())
}

/// Numbers of the curves through the residual velocities.
fn curves(found: &[&ModelLimit]) -> String {
    let fitted: Vec<(&ModelLimit, &LambertJonasFit)> = found
        .iter()
        .filter_map(|limit| Some((*limit, limit.fit.as_ref()?)))
        .collect();
    if fitted.is_empty() {
        return String::new();
    }
    let table = Table::of(&fitted)
        .words("model", |(limit, _)| limit.model)
        .numbers("points", "", |(limit, _)| limit.curve.len().to_string())
        .numbers("to", "m/s", |(limit, _)| last_velocity(limit))
        .numbers("a", "", |(_, fit)| significant(fit.a, 4))
        .numbers("p", "", |(_, fit)| significant(fit.p, 4))
        .numbers("v_bl", "m/s", |(_, fit)| {
            significant(fit.ballistic_limit_m_s, 4)
        })
        .numbers("rms", "m/s", |(_, fit)| format!("{:.2}", fit.rms_m_s))
        .table();
    let title = "residual velocity: v_r = a (v^p - v_bl^p)^(1/p), v_bl fixed at the limit";
    format!("{}\n{}", bold(title), blocks(&table))
}

/// Highest impact velocity of a curve.
pub(super) fn last_velocity(limit: &ModelLimit) -> String {
    let last = limit.curve.last();
    last.map_or_else(String::new, |p| significant(p.impact_velocity_m_s, 4))
}

/// One line per reason why models have no limit.
pub fn reasons(limits: &Limits) -> Vec<String> {
    let without = |limit: &&ModelLimit| !is_found(limit) && limit.outcome != LimitOutcome::Input;
    let said = limits.results.iter().filter(without);
    let said = said.map(|limit| {
        let reason = limit.reason.as_deref().unwrap_or("no reason given");
        let words = match limit.outcome {
            LimitOutcome::NotApplicable => format!("not applicable, because {reason}"),
            // These reasons say what the outcome is.
            LimitOutcome::NeverPerforates | LimitOutcome::AlwaysPerforates => reason.to_owned(),
            other => format!("{}: {reason}", other.describe()),
        };
        (limit.model, words)
    });
    by_models(said)
}

/// One line of NAME=VALUE pairs per model.
pub fn lines(limits: &Limits) -> String {
    let value = |value: Option<f64>| value.map_or_else(|| "null".to_owned(), |v| significant(v, 6));
    let line = |limit: &ModelLimit| {
        format!(
            "model={} outcome={} ballistic_limit_m_s={} stopped_m_s={} perforated_m_s={} runs={} warnings={} \
             recommended={} input_limit_m_s={}\n",
            limit.model,
            limit.outcome.describe().replace(' ', "_"),
            value(limit.ballistic_limit_m_s),
            value(limit.bracket.map(|bracket| bracket.stopped_m_s)),
            value(limit.bracket.map(|bracket| bracket.perforated_m_s)),
            limit.runs,
            limit.warnings.len(),
            limits.is_recommended(limit.model),
            value(limit.input_limit.map(|input| input.ballistic_limit_m_s)),
        )
    };
    let axisymmetric = limits.axisymmetric.iter().map(|limit| {
        format!(
            "axisymmetric.ballistic_limit_m_s={} axisymmetric.uncertainty_m_s={}\n",
            value(limit.ballistic_limit_m_s),
            value(limit.uncertainty_m_s)
        )
    });
    limits
        .results
        .iter()
        .map(line)
        .chain(axisymmetric)
        .collect()
}

/// V50 of tests by every method.
pub fn v50_text(file: &str, v50: &V50) -> String {
    let line = format!(
        "{} of {file}: {} partial and {} complete penetrations; {}",
        counted(v50.tests, "test"),
        v50.tests - v50.perforated,
        v50.perforated,
        pattern(v50)
    );
    let mut text = format!("{}\n{}\n\n", bold("V50"), wrap(&line, width(), 0));
    let percent = format!("{:.0} %", 100.0 * v50.confidence);
    let table = Table::of(&v50.estimates)
        .words("method", |entry| entry.method.describe())
        .numbers("V50", "m/s", |entry| number(entry.v50_m_s, 5))
        .numbers(format!("{percent} interval"), "m/s", interval)
        .numbers("standard\nerror", "m/s", |entry| {
            number(entry.standard_error_m_s, 5)
        })
        .numbers("scatter", "m/s", |entry| {
            number(entry.standard_deviation_m_s, 5)
        })
        .numbers("tests\nused", "", |entry| {
            let all = entry.v50_m_s.map(|_| v50.tests);
            let used = entry.tests_used.or(all);
            used.map_or_else(|| number(None, 0), |used| used.to_string())
        })
        .numbers("span", "m/s", |entry| number(entry.span_m_s, 5));
    text += &blocks(&table.table());
    let said = v50.estimates.iter();
    let said = said.filter_map(|entry| Some((entry.method.describe(), entry.reason.clone()?)));
    for line in by_models(said) {
        text += &format!("{}\n\n", wrap(&line, width(), 2));
    }
    text
}

fn interval(entry: &Estimate) -> String {
    let end = |value: Option<f64>, none: &str| value.map_or(none.to_owned(), |v| significant(v, 5));
    let ends = (entry.low_m_s, entry.high_m_s);
    match (entry.method, ends, entry.v50_m_s) {
        (Method::MeanOfExtremes, ..) | (_, (None, None), None) => "–".to_owned(),
        (_, (None, None), Some(_)) => "unbounded".to_owned(),
        (_, (low, high), _) => format!("{} to {}", end(low, "unbounded"), end(high, "unbounded")),
    }
}

fn pattern(v50: &V50) -> String {
    let speed = |value: Option<f64>| value.map_or_else(String::new, |v| significant(v, 6));
    let (stopped, through) = (
        speed(v50.highest_stopped_m_s),
        speed(v50.lowest_perforated_m_s),
    );
    match v50.pattern {
        Pattern::Mixed => format!("zone of mixed results from {through} to {stopped} m/s"),
        Pattern::Separated if stopped == through => {
            format!(
                "no zone of mixed results: partial and complete penetration both at {stopped} m/s only"
            )
        }
        Pattern::Separated => {
            format!(
                "no zone of mixed results: partial penetration up to {stopped} m/s, complete from {through} m/s on"
            )
        }
        Pattern::Reversed => "the partial penetrations are the faster ones".to_owned(),
        Pattern::AllStopped => "no complete penetration".to_owned(),
        Pattern::AllPerforated => "no partial penetration".to_owned(),
    }
}

/// One line of NAME=VALUE pairs per method.
pub fn v50_lines(v50: &V50) -> String {
    let value = |value: Option<f64>| value.map_or_else(|| "null".to_owned(), |v| significant(v, 6));
    let line = |entry: &Estimate| {
        format!(
            "method={} v50_m_s={} low_m_s={} high_m_s={} standard_deviation_m_s={}\n",
            entry.method.describe().replace(' ', "_"),
            value(entry.v50_m_s),
            value(entry.low_m_s),
            value(entry.high_m_s),
            value(entry.standard_deviation_m_s)
        )
    };
    v50.estimates.iter().map(line).collect()
}
