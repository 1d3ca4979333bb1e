//! Studies of a case: models side by side, convergence with the mesh, ballistic limits, and runs in two dimensions.

use std::{collections::BTreeMap, ops::ControlFlow};

use axum::{
    extract::{Path, Request, State},
    http::StatusCode,
    response::{IntoResponse, Response},
};
use percuss::{
    Scenario,
    compare::{self, Comparison},
    converge::{self, REFINEMENT},
    limit::{self, Search},
    model::{self, Control, Model},
    outcome::BandQuantity,
};
use percuss_report::{
    Chart, ChartData, compare_chart, comparison_files, convergence_chart, limit_chart, limit_files,
};
use serde::Serialize;
use serde_json::{Value, json};

use crate::{
    Bounds, answer,
    problem::Problem,
    request::{self, CaseRequest},
    stream::{self, Tell, pretty},
    worker::{Stop, Workers},
};

/// Meshes of a convergence study.
const LEVELS: u32 = 4;
/// Most speeds of a comparison.
const SPEEDS: usize = 60;

/// What a study came to.
#[derive(Serialize)]
struct Study {
    #[serde(flatten)]
    record: Value,
    charts: Vec<ChartData>,
    /// Files to take away, by name: text.
    files: BTreeMap<String, String>,
}

impl Study {
    fn new(
        record: Value,
        charts: &[Chart],
        files: impl IntoIterator<Item = (String, String)>,
    ) -> Self {
        let drawings = charts.iter().map(|chart| {
            let figure = chart.draw();
            (format!("{}.svg", figure.name), figure.svg)
        });
        Self {
            record,
            charts: charts.iter().map(Chart::data).collect(),
            files: drawings.chain(files).collect(),
        }
    }
}

/// `POST /api/study/{kind}`.
pub(crate) async fn post(
    State(workers): State<Workers>,
    Path(kind): Path<String>,
    request: Request,
) -> Response {
    let asked: CaseRequest = match request::read(request).await {
        Ok(asked) => asked,
        Err(problem) => return problem.into_response(),
    };
    let bounds = *workers.bounds();
    match kind.as_str() {
        "compare" => stream::respond(&workers, move |s, t| compared(&asked, &bounds, s, t)).await,
        "converge" => stream::respond(&workers, move |s, t| converged(&asked, &bounds, s, t)).await,
        "limit" => stream::respond(&workers, move |s, t| limits(&asked, &bounds, s, t)).await,
        "run" => stream::respond(&workers, move |s, t| slow_run(&asked, &bounds, s, t)).await,
        _ => Problem::with_status(StatusCode::NOT_FOUND, "there is no such study", "")
            .into_response(),
    }
}

/// The case of a request, small enough for every model that answers at once.
fn scenario(asked: &CaseRequest, bounds: &Bounds) -> Result<Scenario, Problem> {
    let scenario = asked.read(asked.edited()?)?.scenario;
    for model in model::quick() {
        bounds.check(model, &scenario)?;
    }
    Ok(scenario)
}

/// What a computation is told when it says how far it is.
fn go_on(stop: &Stop, tell: &Tell, fraction: f64, words: &str) -> ControlFlow<()> {
    tell.progress(fraction, words);
    match tell.is_alone() {
        true => {
            stop.cancel();
            ControlFlow::Break(())
        }
        false => stop.flow(),
    }
}

fn compared(
    asked: &CaseRequest,
    bounds: &Bounds,
    stop: &Stop,
    tell: &Tell,
) -> Result<Study, Problem> {
    let scenario = scenario(asked, bounds)?;
    let speeds = match asked.speeds {
        None => vec![scenario.impact_speed],
        Some((from, to, count)) => speeds(from, to, count)?,
    };
    let mut report = |now: compare::Progress| {
        let words = format!("{} of {} runs", now.finished, now.total);
        go_on(stop, tell, now.fraction, &words)
    };
    let mut watch = compare::Watch {
        progress: Some(&mut report),
    };
    let comparison = compare::compare(&model::quick(), &scenario, &speeds, &mut watch)
        .map_err(|error| stop.problem(error))?;
    let regimes: Vec<String> = comparison
        .regime
        .iter()
        .map(|at| at.regime.in_words(&scenario))
        .collect();
    let quantities: Vec<Value> = comparison
        .quantities
        .iter()
        .map(|quantity| quantity_record(&comparison, *quantity, speeds[0]))
        .collect();
    let chart = compare_chart(&scenario, &comparison);
    let tables = comparison_files(&comparison)?;
    let csv = tables.into_iter().filter_map(text_file);
    let files: Vec<_> = csv
        .chain([("compare.json".to_owned(), pretty(&comparison))])
        .collect();
    let record = json!({ "comparison": comparison, "regimes": regimes, "quantities": quantities });
    Ok(Study::new(record, chart.as_slice(), files))
}

fn speeds(from: f64, to: f64, count: usize) -> Result<Vec<f64>, Problem> {
    let inside = |speed: f64| (0.0..=10_000.0).contains(&speed);
    if !inside(from) || !inside(to) || !(2..=SPEEDS).contains(&count) {
        return Err(Problem::bad_request(format!(
            "give speeds from 0 to 10000 m/s, and 2 to {SPEEDS} of them"
        )));
    }
    let part = |i: usize| i as f64 / (count - 1) as f64;
    Ok((0..count)
        .map(|i| from * (1.0 - part(i)) + to * part(i))
        .collect())
}

/// A quantity in words, with what was measured of it.
fn quantity_record(comparison: &Comparison, quantity: BandQuantity, speed: f64) -> Value {
    let measured = comparison.measured(quantity, speed);
    json!({
        "key": quantity,
        "words": quantity.in_words(),
        "unit": quantity.unit(),
        "measured": measured.map(|(value, _)| value),
    })
}

/// A table as text, if it is CSV: the page takes no Parquet.
fn text_file((name, content): (&'static str, Vec<u8>)) -> Option<(String, String)> {
    let csv = name.ends_with(".csv").then_some(content)?;
    Some((name.to_owned(), String::from_utf8(csv).ok()?))
}

fn converged(
    asked: &CaseRequest,
    bounds: &Bounds,
    stop: &Stop,
    tell: &Tell,
) -> Result<Study, Problem> {
    let scenario = asked.read(asked.edited()?)?.scenario;
    let model = asked.model(&scenario, bounds)?;
    bounds.check(model, &scenario.refined(REFINEMENT.pow(LEVELS - 1)))?;
    // The work grows fourfold with each mesh.
    let work = |level: u32| 4_f64.powi(level as i32);
    let total: f64 = (0..LEVELS).map(work).sum();
    let (mut level, mut before) = (0, 0.0);
    let mut report = |now: model::Progress| {
        if now.fraction < before {
            level = (level + 1).min(LEVELS - 1);
        }
        before = now.fraction;
        let done: f64 = (0..level).map(work).sum::<f64>() + now.fraction * work(level);
        go_on(
            stop,
            tell,
            done / total,
            &format!("mesh {} of {LEVELS}", level + 1),
        )
    };
    let mut control = Control {
        progress: Some(&mut report),
        ..Control::default()
    };
    let (study, _) = converge::study(model, &scenario, LEVELS, &mut control)
        .map_err(|error| stop.problem(error))?;
    let charts: Vec<Chart> = (0..study.quantities.len())
        .filter_map(|i| convergence_chart(&scenario.name, &study, i))
        .collect();
    let words: Vec<String> = study
        .quantities
        .iter()
        .map(|quantity| {
            let fine = quantity.values.last().copied().unwrap_or(f64::NAN);
            quantity.verdict.in_words(fine)
        })
        .collect();
    let files = [("convergence.json".to_owned(), pretty(&study))];
    let record = json!({ "study": study, "words": words });
    Ok(Study::new(record, &charts, files))
}

fn limits(
    asked: &CaseRequest,
    bounds: &Bounds,
    stop: &Stop,
    tell: &Tell,
) -> Result<Study, Problem> {
    let scenario = scenario(asked, bounds)?;
    let mut report =
        |now: limit::Progress| go_on(stop, tell, now.fraction, &format!("{} runs", now.finished));
    let mut watch = limit::Watch {
        progress: Some(&mut report),
    };
    let limits = limit::limits(&model::quick(), &scenario, &Search::default(), &mut watch)
        .map_err(|error| stop.problem(error))?;
    let chart = limit_chart(&scenario, &limits);
    let outcomes: Vec<&str> = limits
        .results
        .iter()
        .map(|limit| limit.outcome.in_words())
        .collect();
    let tables = limit_files(&limits)?.into_iter().filter_map(text_file);
    let files: Vec<_> = tables
        .chain([("limit.json".to_owned(), pretty(&limits))])
        .collect();
    let record = json!({
        "measured": limits.measured().map(|(value, _)| value),
        "limits": limits,
        "outcomes": outcomes,
    });
    Ok(Study::new(record, chart.as_slice(), files))
}

/// A run of a model that takes a while, as an answer like any other.
fn slow_run(
    asked: &CaseRequest,
    bounds: &Bounds,
    stop: &Stop,
    tell: &Tell,
) -> Result<answer::Answer, Problem> {
    let read = asked.read(asked.edited()?)?;
    let model: &'static dyn Model = asked.model(&read.scenario, bounds)?;
    answer::answer(read, model, stop, Some(tell))
}
