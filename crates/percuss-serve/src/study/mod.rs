//! Studies of a case: models side by side, convergence with the mesh, ballistic limits, sweeps, uncertainty, calibration, and runs in
//! two dimensions.

mod calibration_example;
mod compared;
mod converged;
mod fitted;
mod limits;
mod runs;
mod swept;
mod uncertain;
mod uncertain_example;

use std::{collections::BTreeMap, ops::ControlFlow};

use axum::{
    extract::{Path, State},
    http::StatusCode,
    response::{IntoResponse, Response},
};
use percuss::{
    Scenario,
    model::{self, Model},
};
use percuss_report::{Chart, ChartData, Figure};
use serde::Serialize;
use serde_json::{Value, json};

use crate::{
    RequestLimits,
    events::{self, EventSender},
    http,
    job::{Stop, Workers},
    problem::Problem,
    request::{CaseRequest, ReadCase},
    response,
};

/// What a study came to.
#[derive(Serialize)]
struct Study {
    #[serde(flatten)]
    record: Value,
    charts: Vec<ChartData>,
    /// Figures that are no charts.
    pictures: Vec<Picture>,
    /// Files to take away, by name: text.
    files: BTreeMap<String, String>,
}

/// A figure that is no chart, as it is drawn.
#[derive(Serialize)]
struct Picture {
    name: String,
    title: String,
    svg: String,
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
            pictures: Vec::new(),
            files: drawings.chain(files).collect(),
        }
    }

    fn with_pictures(self, figures: impl IntoIterator<Item = Figure>) -> Self {
        let picture = |figure: Figure| Picture {
            name: figure.name,
            title: figure.title,
            svg: figure.svg,
        };
        Self {
            pictures: figures.into_iter().map(picture).collect(),
            ..self
        }
    }
}

/// `POST /api/study/{kind}`.
pub(crate) async fn post(
    State(workers): State<Workers>,
    Path(kind): Path<String>,
    asked: CaseRequest,
) -> Response {
    match kind.as_str() {
        "compare" => follow(&workers, asked, compared::compared).await,
        "converge" => follow(&workers, asked, converged::converged).await,
        "limit" => follow(&workers, asked, limits::limits).await,
        "sweep" => follow(&workers, asked, swept::swept).await,
        "calibrate" => follow(&workers, asked, fitted::fitted).await,
        "uncertainty" => follow(&workers, asked, uncertain::uncertain).await,
        "run" => follow(&workers, asked, slow_run).await,
        _ => Problem::with_status(StatusCode::NOT_FOUND, "there is no such study", "")
            .into_response(),
    }
}

/// Computes a study and answers as it goes.
async fn follow<T: Serialize + 'static>(
    workers: &Workers,
    asked: CaseRequest,
    study: fn(&Job<'_>) -> Result<T, Problem>,
) -> Response {
    let bounds = *workers.bounds();
    events::respond(workers, move |stop, events| {
        study(&Job {
            asked: &asked,
            bounds: &bounds,
            stop,
            events,
        })
    })
    .await
}

/// `POST /api/uncertainty-example`: the text of a case with an example of what is uncertain in it.
pub(crate) async fn uncertainty_example(
    State(workers): State<Workers>,
    asked: CaseRequest,
) -> Response {
    let example = |asked: &CaseRequest, _: &RequestLimits, _: &Stop| {
        let read = asked.read(asked.edited()?)?;
        Ok(uncertain_example::with_example(&read.text, &read.scenario))
    };
    changed(workers, asked, example).await
}

/// `POST /api/calibration-example`: the text of a case with an example of measured values in it.
pub(crate) async fn calibration_example(
    State(workers): State<Workers>,
    asked: CaseRequest,
) -> Response {
    let example = |asked: &CaseRequest, bounds: &RequestLimits, stop: &Stop| {
        let ReadCase { text, scenario } = asked.read(asked.edited()?)?;
        let chosen = asked.model(&scenario, bounds)?;
        calibration_example::with_example(&text, &scenario, &chosen, stop)
    };
    changed(workers, asked, example).await
}

/// Answers with the changed text of a case.
async fn changed(
    workers: Workers,
    asked: CaseRequest,
    change: fn(&CaseRequest, &RequestLimits, &Stop) -> Result<String, Problem>,
) -> Response {
    let bounds = *workers.bounds();
    let text = workers.run(move |stop| change(&asked, &bounds, stop));
    match text.await {
        Ok(text) => http::json(StatusCode::OK, &json!({ "case": text })),
        Err(problem) => problem.into_response(),
    }
}

/// What a study works with.
struct Job<'a> {
    asked: &'a CaseRequest,
    bounds: &'a RequestLimits,
    /// When it has to end.
    stop: &'a Stop,
    /// Who hears how far it is.
    events: &'a EventSender,
}

impl Job<'_> {
    /// The case with what the form changes.
    fn read(&self) -> Result<ReadCase, Problem> {
        self.asked.read(self.asked.edited()?)
    }

    /// The case, small enough for every model that answers at once.
    fn scenario(&self) -> Result<Scenario, Problem> {
        let scenario = self.read()?.scenario;
        for model in model::fast_models() {
            self.bounds.check(model, &scenario)?;
        }
        Ok(scenario)
    }

    /// The model that is asked for, within bounds.
    fn model(&self, scenario: &Scenario) -> Result<&'static dyn Model, Problem> {
        Ok(self.asked.model(scenario, self.bounds)?.model)
    }

    /// What a computation is told when it says how far it is.
    fn go_on(&self, fraction: f64, words: &str) -> ControlFlow<()> {
        self.events.progress(fraction, words);
        self.wanted()
    }

    /// Whether somebody waits and there is time left.
    fn wanted(&self) -> ControlFlow<()> {
        if self.events.is_disconnected() {
            self.stop.cancel();
        }
        self.stop.flow()
    }
}

/// Tables as text, those of them that are CSV: the page takes no Parquet.
fn csv_files(
    tables: impl IntoIterator<Item = (&'static str, Vec<u8>)>,
) -> impl Iterator<Item = (String, String)> {
    let csv = |(name, content): (&str, Vec<u8>)| {
        let content = name.ends_with(".csv").then_some(content)?;
        Some((name.to_owned(), String::from_utf8(content).ok()?))
    };
    tables.into_iter().filter_map(csv)
}

/// A run of a model that takes a while, as an answer like any other.
fn slow_run(job: &Job<'_>) -> Result<response::CaseResponse, Problem> {
    let read = job.read()?;
    let chosen = job.asked.model(&read.scenario, job.bounds)?;
    response::compute(read, &chosen, None, job.stop, Some(job.events))
}
