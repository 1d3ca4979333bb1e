//! The answer to a case: its numbers, its charts and the text that they belong to.

use std::{collections::BTreeMap, ops::ControlFlow, time::Instant};

use axum::{
    extract::{Request, State},
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
    Bounds,
    constants::{self, Constant},
    form, http,
    problem::Problem,
    request::{self, CaseRequest, ReadCase},
    stream::Tell,
    worker::{Stop, Workers},
};

/// Cells of the x–t diagram of a page along the axis and along time.
const CELLS: [usize; 2] = [160, 120];
/// Name of the x–t diagram.
const STRESS: &str = "stress-xt";
/// Points of a curve that follows a slider, at most.
const DRAFT_POINTS: usize = 400;

/// What the page shows of a case.
#[derive(Debug, Serialize)]
pub(crate) struct Answer {
    /// The text with what the form changed.
    case: String,
    /// Its values by dotted key.
    values: BTreeMap<String, Value>,
    /// Constants of its materials; a draft has none.
    constants: Vec<Constant>,
    model: &'static str,
    /// What `percuss run --json` prints.
    results: CaseResults,
    /// The same for people: outcome, what the model alone has, books.
    pub(crate) rows: [Vec<result_rows::Row>; 3],
    charts: Vec<ChartData>,
    /// Time that the run and its charts took [ms].
    elapsed_ms: f64,
}

/// What the page shows of a case that is not valid: the form and the text stay in step.
#[derive(Serialize)]
struct Refusal {
    problem: Problem,
    case: String,
    values: BTreeMap<String, Value>,
}

/// Computes a case; `tell` hears how far it is.
pub(crate) fn run(
    scenario: &Scenario,
    chosen: &ChosenModel,
    stop: &Stop,
    tell: Option<&Tell>,
) -> Result<RunResult, Problem> {
    let mut report = |now: model::Progress| {
        if let Some(tell) = tell {
            tell.progress(now.fraction, &format!("{:.1} µs", now.time * 1e6));
            if tell.is_alone() {
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

/// Charts that are to be seen while a slider moves, with as many points as a moving eye takes in.
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

/// The answer of a model to a case that was read; a draft of it where only some charts are in view.
pub(crate) fn answer(
    read: ReadCase,
    chosen: &ChosenModel,
    in_view: Option<&[String]>,
    stop: &Stop,
    tell: Option<&Tell>,
) -> Result<Answer, Problem> {
    let start = Instant::now();
    let ReadCase { text, scenario } = read;
    let mut result = run(&scenario, chosen, stop, tell)?;
    let results = CaseResults::new(&scenario, std::slice::from_ref(&result));
    let books = result.numerics.as_ref().map_or_else(Vec::new, |numerics| {
        result_rows::book_rows(numerics, result.end_time.unwrap_or(0.0))
    });
    let outcome = result_rows::outcome_rows(&scenario, &result, &results.results[0]);
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
        result_rows::detail_rows(&result),
        books,
    ];
    let charts = match in_view {
        Some(in_view) => draft(&scenario, &mut result, in_view)?,
        None => charts(&scenario, &result, Some(CELLS))?,
    };
    let values = form::values(&text);
    Ok(Answer {
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

/// Reads the case of a request and computes it.
pub(crate) fn answer_to(
    asked: &CaseRequest,
    text: String,
    bounds: &Bounds,
    stop: &Stop,
) -> Result<Answer, Problem> {
    let read = asked.read(text)?;
    let chosen = asked.model(&read.scenario, bounds)?;
    if chosen.model.cost() == CostClass::Minutes {
        return Err(Problem::bad_request(format!(
            "model `{}` takes too long to answer at once",
            chosen.model.name()
        )));
    }
    answer(read, &chosen, asked.in_view.as_deref(), stop, None)
}

/// `POST /api/answer`.
pub(crate) async fn post(State(workers): State<Workers>, request: Request) -> Response {
    let asked: CaseRequest = match request::read(request).await {
        Ok(asked) => asked,
        Err(problem) => return problem.into_response(),
    };
    let text = match asked.edited() {
        Ok(text) => text,
        Err(problem) => return problem.into_response(),
    };
    let case = text.clone();
    let bounds = *workers.bounds();
    // The answer is written on the thread that computed it: a large one takes as long as a small run.
    let answered = workers.run(move |stop| {
        let answer = answer_to(&asked, text, &bounds, stop)?;
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
