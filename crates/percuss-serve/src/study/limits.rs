//! Ballistic limits.

use percuss::{
    Scenario,
    axisymmetric::{BUDGET, Request},
    limit::{self, RearFace, Search},
    model,
    problem::RearFaceCondition,
};
use percuss_report::{axisymmetric_limit, limit_chart, limit_files, limit_headline};
use serde_json::json;

use super::{Job, Study, csv_files};
use crate::{events::pretty, problem::Problem};

pub(super) fn limits(job: &Job<'_>) -> Result<Study, Problem> {
    let scenario = job.scenario()?;
    let freed = with_freed_rear_face(&scenario);
    let is_freed = freed.is_some();
    let scenario = freed.unwrap_or(scenario);
    let mut report =
        |now: limit::Progress| job.go_on(now.fraction, &format!("{} runs", now.finished));
    let mut watch = limit::Observer {
        progress: Some(&mut report),
    };
    // Estimates err by a factor, and a study that is stopped says nothing.
    let budget = BUDGET.min(0.5 * job.bounds.seconds as f64);
    let search = Search {
        axisymmetric: Some(Request {
            budget: Some(budget),
            ..Request::unasked()
        }),
        ..Search::default()
    };
    let limits = limit::limits(&model::fast_models(), &scenario, &search, &mut watch)
        .map_err(|error| job.stop.problem(error))?;
    let chart = limit_chart(&scenario, &limits);
    let outcomes: Vec<&str> = limits
        .results
        .iter()
        .map(|limit| limit.outcome.describe())
        .collect();
    let expected: Vec<Option<String>> = limits
        .results
        .iter()
        .map(|limit| Some(limit.expected_error.as_ref()?.describe()))
        .collect();
    let files: Vec<_> = csv_files(limit_files(&limits)?)
        .chain([("limit.json".to_owned(), pretty(&limits))])
        .collect();
    let record = json!({
        "headline": limit_headline(&limits),
        "axisymmetric": axisymmetric_limit(&limits),
        "measured": limits.measured().map(|(value, _)| value),
        "limits": limits,
        "outcomes": outcomes,
        "freed": is_freed,
        "rear_face": limits.rear_face.and_then(RearFace::describe),
        "expected": expected,
    });
    Ok(Study::new(record, chart.as_slice(), files))
}

/// The case with a free rear face where it fixes that of a plate, which nothing can perforate; `None` for other cases.
fn with_freed_rear_face(scenario: &Scenario) -> Option<Scenario> {
    if !scenario.given.rear_face || scenario.rear_face() != Some(RearFaceCondition::Fixed) {
        return None;
    }
    let mut open = scenario.clone();
    open.given.rear_face = false;
    let mut freed = limit::with_free_rear_face(&open)?;
    freed.given.rear_face = true;
    Some(freed)
}
