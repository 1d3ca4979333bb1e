//! Sweep of a case by a sweep file.

use std::collections::BTreeMap;

use percuss::{
    case::Document,
    outcome::Outcome,
    sweep::{Axis, Sweep, SweepRow},
};
use percuss_report::{
    parameter_label,
    sweep::{PlotStyle, charts, numbers, parallel_figure, rows_csv},
};
use serde_json::{Value, json};

use super::{
    Job, Study, csv_files,
    runs::{Bounded, followed},
};
use crate::problem::Problem;

/// Most runs of a sweep.
const MOST_RUNS: u64 = 4096;
/// Most rows that the page shows by themselves; the file has all.
const SHOWN: usize = 200;
/// Most reasons of failed runs.
const REASONS: usize = 3;
/// Name that the sweep file has for the case.
const BASE: &str = "scenario.toml";

pub(super) fn swept(job: &Job<'_>) -> Result<Study, Problem> {
    let asked = job.asked;
    let case = job.read()?;
    let file = Document::new("sweep.toml", asked.sweep.as_str());
    let sweep = Sweep::of(&file, &Document::new(asked.name(), case.text.as_str()))?;
    if sweep.runs() > MOST_RUNS {
        return Err(Problem::refused(
            format!("the sweep has {} runs", sweep.runs()),
            format!("the page allows up to {MOST_RUNS}; use `percuss sweep` for more"),
        ));
    }
    job.bounds.check(sweep.model, &case.scenario)?;
    let kernel = Bounded::new(sweep.model, job.bounds);
    let rows = followed(job, |watch| sweep.rows(&kernel, watch));
    let rows = rows.map_err(|_| job.stop.ended())?;

    let drawn = charts(&sweep, &rows);
    let figures = drawn.iter().map(|one| {
        let figure = one.chart.draw();
        (format!("{}.svg", figure.name), figure.svg)
    });
    let texts = [
        ("sweep.toml".to_owned(), asked.sweep.clone()),
        (BASE.to_owned(), case.text.clone()),
    ];
    let files: Vec<_> = csv_files([("rows.csv", rows_csv(&sweep, &rows)?)])
        .chain(figures)
        .chain(texts)
        .collect();
    let drawn: Vec<Value> = drawn
        .iter()
        .map(|one| {
            let style = match one.style {
                PlotStyle::Curves => "curves",
                PlotStyle::Map => "map",
                PlotStyle::Parallel => "parallel coordinates",
            };
            json!({ "quantity": one.quantity, "style": style, "chart": one.chart.data() })
        })
        .collect();
    let record = json!({
        "model": sweep.model.name(),
        "design": sweep.design().name(),
        "runs": sweep.runs(),
        "parameters": sweep.axes.iter().map(parameter).collect::<Vec<_>>(),
        "outcomes": outcomes(&rows),
        "reasons": reasons(&rows),
        "numbers": table(&sweep, &rows),
        "rows": rows.iter().take(SHOWN).map(row).collect::<Vec<_>>(),
        "drawn": drawn,
    });
    let picture = parallel_figure(&sweep, &rows);
    Ok(Study::new(record, &[], files).with_pictures(picture))
}

fn parameter(axis: &Axis) -> Value {
    json!({
        "label": parameter_label(&axis.key, &axis.unit),
        "words": axis.words().unwrap_or_default(),
    })
}

/// The numbers that come of the runs, with the values of the rows that are shown.
fn table(sweep: &Sweep, rows: &[SweepRow]) -> Vec<Value> {
    let number = |number: percuss_report::sweep::SweepNumber| {
        let shown = number.values.iter().take(SHOWN).collect::<Vec<_>>();
        json!({ "quantity": number.quantity, "label": number.label, "values": shown })
    };
    numbers(sweep, rows).into_iter().map(number).collect()
}

fn row(row: &SweepRow) -> Value {
    let (outcome, reason) = match &row.record {
        Ok(record) => (record.outcome, record.reason.clone().unwrap_or_default()),
        Err(reason) => (Outcome::Failed, reason.clone()),
    };
    json!({ "inputs": row.inputs, "outcome": outcome.describe(), "reason": reason })
}

/// How often each outcome is there.
fn outcomes(rows: &[SweepRow]) -> BTreeMap<&'static str, u64> {
    let mut outcomes = BTreeMap::new();
    for row in rows {
        let outcome = row.record.as_ref().map_or(Outcome::Failed, |r| r.outcome);
        *outcomes.entry(outcome.describe()).or_default() += 1;
    }
    outcomes
}

/// Why runs have no result: each reason once, and no more than a few.
fn reasons(rows: &[SweepRow]) -> Vec<&str> {
    let mut reasons: Vec<&str> = Vec::new();
    for row in rows {
        let reason = match &row.record {
            Ok(record) => record.reason.as_deref(),
            Err(reason) => Some(reason.as_str()),
        };
        if let Some(reason) = reason
            && reasons.len() < REASONS
            && !reasons.contains(&reason)
        {
            reasons.push(reason);
        }
    }
    reasons
}
