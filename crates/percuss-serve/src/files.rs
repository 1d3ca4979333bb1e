//! Files for download: histories, figures, results.

use axum::{
    extract::State,
    http::{HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};
use percuss::summary::CaseResults;
use percuss_report::{Chart, history_files};

use crate::{
    events::pretty,
    http,
    job::{Stop, Workers},
    problem::Problem,
    request::CaseRequest,
    response,
};

/// Cells of the x–t diagram of a figure along the axis and along time.
const CELLS: [usize; 2] = [300, 220];

/// `POST /api/file`.
pub(crate) async fn post(State(workers): State<Workers>, asked: CaseRequest) -> Response {
    let bounds = *workers.bounds();
    let made = workers.run(move |stop| {
        let name = asked.file.clone().unwrap_or_default();
        let read = asked.read(asked.edited()?)?;
        let chosen = asked.model(&read.scenario, &bounds)?;
        file(&name, &read.scenario, &chosen, stop)
    });
    match made.await {
        Ok((kind, content)) => {
            let mut response = http::respond(StatusCode::OK, kind, content);
            response.headers_mut().insert(
                header::CONTENT_DISPOSITION,
                HeaderValue::from_static("attachment"),
            );
            response
        }
        Err(problem) => problem.into_response(),
    }
}

/// Type and content of a file by its name.
fn file(
    name: &str,
    scenario: &percuss::Scenario,
    chosen: &percuss::model::ChosenModel,
    stop: &Stop,
) -> Result<(&'static str, Vec<u8>), Problem> {
    let result = response::run(scenario, chosen, stop, None)?;
    if name == "result.json" {
        let results = CaseResults::new(scenario, &[result]);
        return Ok(("application/json", pretty(&results).into_bytes()));
    }
    let unknown = || {
        Problem::with_status(
            StatusCode::NOT_FOUND,
            "this model gives no such file for this case",
            "",
        )
    };
    let Some(figure) = name.strip_suffix(".svg") else {
        let tables = history_files(&result, None)?;
        let found = tables.into_iter().find(|(table, _)| *table == name);
        let (_, content) = found.ok_or_else(unknown)?;
        let kind = match name.ends_with(".csv") {
            true => "text/csv",
            false => "application/vnd.apache.parquet",
        };
        return Ok((kind, content));
    };
    let charts = response::charts(scenario, &result, Some(CELLS))?;
    let chart: &Chart = charts
        .iter()
        .find(|chart| chart.name() == figure)
        .ok_or_else(unknown)?;
    Ok(("image/svg+xml", chart.draw().svg.into_bytes()))
}
