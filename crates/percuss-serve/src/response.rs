//! Response to a case: its results, charts and text.

use std::{collections::BTreeMap, ops::ControlFlow, time::Instant};

use axum::{
    extract::State,
    http::StatusCode,
    response::{IntoResponse, Response},
};
use percuss::{
    Scenario,
    model::{self, ChosenModel, Control, CostClass},
    outcome::RunResult,
    summary::CaseResults,
};
use percuss_report::{Chart, ChartData, result_rows, run_charts};
use serde::Serialize;
use serde_json::Value;

use crate::{
    RequestLimits,
    constants::{self, Constant},
    events::EventSender,
    form, http, in_use,
    job::{Stop, Workers},
    problem::Problem,
    request::{CaseRequest, ReadCase},
};

/// Cells of the x–t diagram of a page along the axis and along time.
const CELLS: [usize; 2] = [160, 120];
/// Digits of the numbers on the page.
const DIGITS: usize = 3;
/// Name of the x–t diagram.
const STRESS: &str = "stress-xt";
/// Largest number of points of a curve that follows a slider.
const DRAFT_POINTS: usize = 400;

/// Results of a case for the page.
#[derive(Debug, Serialize)]
pub(crate) struct CaseResponse {
    /// Text with the edits of the form.
    case: String,
    /// Values by dotted key.
    values: BTreeMap<String, Value>,
    /// Values in use of keys that are not given and have no default of their own; empty in a draft.
    in_use: BTreeMap<String, String>,
    /// Constants of its materials; empty in a draft.
    constants: Vec<Constant>,
    model: &'static str,
    /// Output of `percuss run --json`.
    results: CaseResults,
    /// Rows of the tables: outcome, model-specific numbers, balances.
    pub(crate) rows: [Vec<result_rows::Row>; 3],
    charts: Vec<ChartData>,
    /// Time of the run and its charts [ms].
    elapsed_ms: f64,
}

/// Response to a case that is not valid, with text and values of the form.
#[derive(Serialize)]
struct Refusal {
    problem: Problem,
    case: String,
    values: BTreeMap<String, Value>,
}

/// Computes a case; `events` gets the progress.
pub(crate) fn run(
    scenario: &Scenario,
    chosen: &ChosenModel,
    stop: &Stop,
    events: Option<&EventSender>,
) -> Result<RunResult, Problem> {
    let mut report = |now: model::Progress| {
        if let Some(events) = events {
            events.progress(now.fraction, &format!("{:.1} µs", now.time * 1e6));
            if events.is_disconnected() {
                return ControlFlow::Break(());
            }
        }
        stop.flow()
    };
    let mut control = Control {
        progress: Some(&mut report),
        ..Control::recording()
    };
    chosen
        .run(scenario, &mut control)
        .map_err(|error| stop.problem(error))
}

/// Charts of a result; a model without a time history has none.
pub(crate) fn charts(
    scenario: &Scenario,
    result: &RunResult,
    cells: Option<[usize; 2]>,
) -> Result<Vec<Chart>, Problem> {
    let recorded = result.history.as_ref();
    match recorded.is_some_and(|history| !history.samples.is_empty()) {
        true => Ok(run_charts(scenario, result, cells)?),
        false => Ok(Vec::new()),
    }
}

/// Visible charts while a slider moves, with fewer points.
fn draft(
    scenario: &Scenario,
    result: &mut RunResult,
    in_view: &[String],
) -> Result<Vec<Chart>, Problem> {
    let seen = |name: &str| in_view.iter().any(|seen| seen == name);
    if let Some(history) = &mut result.history {
        let last = history.samples.len().saturating_sub(1);
        let stride = history.samples.len().div_ceil(DRAFT_POINTS).max(1);
        let mut place = 0..;
        history.samples.retain(|_| {
            let place = place.next().unwrap_or(last);
            place % stride == 0 || place == last
        });
    }
    let cells = seen(STRESS).then_some(CELLS);
    let mut charts = charts(scenario, result, cells)?;
    charts.retain(|chart| seen(chart.name()));
    Ok(charts)
}

/// Response of a model to a case; a draft where `in_view` names the visible charts.
pub(crate) fn compute(
    read: ReadCase,
    chosen: &ChosenModel,
    in_view: Option<&[String]>,
    stop: &Stop,
    events: Option<&EventSender>,
) -> Result<CaseResponse, Problem> {
    let start = Instant::now();
    let ReadCase { text, scenario } = read;
    let mut result = run(&scenario, chosen, stop, events)?;
    let results = CaseResults::new(&scenario, std::slice::from_ref(&result));
    let balances = result.numerics.as_ref().map_or_else(Vec::new, |numerics| {
        result_rows::balance_rows(numerics, result.end_time.unwrap_or(0.0), DIGITS)
    });
    let outcome = result_rows::outcome_rows(&scenario, &result, &results.results[0], DIGITS);
    let choice = chosen
        .note
        .iter()
        .map(|note| ("model".to_owned(), note.clone()));
    let resistance = result
        .target_resistance_choice
        .iter()
        .map(|note| ("target resistance".to_owned(), note.clone()));
    let rows = [
        choice.chain(resistance).chain(outcome).collect(),
        result_rows::detail_rows(&result, DIGITS),
        balances,
    ]
    .map(typeset);
    let charts = match in_view {
        Some(in_view) => draft(&scenario, &mut result, in_view)?,
        None => charts(&scenario, &result, Some(CELLS))?,
    };
    let values = form::values(&text);
    Ok(CaseResponse {
        in_use: match in_view {
            Some(_) => BTreeMap::new(),
            None => in_use::of(&scenario),
        },
        constants: match in_view {
            Some(_) => Vec::new(),
            None => constants::all(&values, &scenario),
        },
        values,
        case: text,
        model: chosen.model.name(),
        results,
        rows,
        charts: charts.iter().map(Chart::data).collect(),
        elapsed_ms: start.elapsed().as_secs_f64() * 1e3,
    })
}

/// Rows with the sign of microseconds, which are `us` in the terminal and in files.
fn typeset(rows: Vec<result_rows::Row>) -> Vec<result_rows::Row> {
    let words = |value: &str| {
        let words = value.split(' ').map(|word| match word {
            "us" => "µs",
            "us," => "µs,",
            word => word,
        });
        words.collect::<Vec<_>>().join(" ")
    };
    rows.into_iter()
        .map(|(label, value)| (label, words(&value)))
        .collect()
}

/// Reads the case of a request and computes it.
pub(crate) fn compute_request(
    asked: &CaseRequest,
    text: String,
    bounds: &RequestLimits,
    stop: &Stop,
) -> Result<CaseResponse, Problem> {
    let read = asked.read(text)?;
    let chosen = asked.model(&read.scenario, bounds)?;
    if chosen.model.cost() == CostClass::Minutes {
        let name = chosen.model.name();
        return Err(match &asked.model {
            Some(_) => Problem::refused(
                format!("model `{name}` takes too long for the page"),
                "choose another model, or use `percuss run` for this case",
            ),
            None => Problem::refused(
                format!(
                    "no quick model applies to this case: the page has no answer at once, and `{name}` takes too long"
                ),
                "use `percuss run` for this case",
            ),
        });
    }
    compute(read, &chosen, asked.in_view.as_deref(), stop, None)
}

/// `POST /api/answer`.
pub(crate) async fn post(State(workers): State<Workers>, asked: CaseRequest) -> Response {
    let text = match asked.edited() {
        Ok(text) => text,
        Err(problem) => return problem.into_response(),
    };
    let case = text.clone();
    let bounds = *workers.bounds();
    // The response is serialised on the worker thread: a large one takes as long as a small run.
    let answered = workers.run(move |stop| {
        let answer = compute_request(&asked, text, &bounds, stop)?;
        Ok(http::json(StatusCode::OK, &answer))
    });
    match answered.await {
        Ok(response) => response,
        Err(problem) => {
            let status = problem.status;
            let values = form::values(&case);
            let refusal = Refusal {
                problem,
                case,
                values,
            };
            http::json(status, &refusal)
        }
    }
}
