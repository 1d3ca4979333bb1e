//! Pages of a material and of the validation report.

use std::{
    ops::ControlFlow,
    sync::{Arc, OnceLock},
};

use axum::{
    extract::{Path, Request, State},
    http::StatusCode,
    response::{IntoResponse, Response},
};
use percuss::{experiments, material::Library, model, validate};
use percuss_report::{
    MaterialCard,
    validation::{self, Origin},
};
use serde::Deserialize;
use serde_json::json;

use crate::{assets, events, http, job::Workers, problem::Problem, request};

/// `GET /materials/{name}`.
pub(crate) async fn material(Path(name): Path<String>) -> Response {
    let library = Library::built_in();
    match library.find(&name) {
        Some(entry) => http::report(&MaterialCard::new(entry, library).html()),
        None => assets::missing().page(),
    }
}

/// The validation report, once it was computed.
#[derive(Debug, Default)]
pub(crate) struct Validation(OnceLock<String>);

/// A request without content.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Empty {}

impl Validation {
    /// `GET /validation`: the report, when it was computed before.
    pub(crate) async fn get(State(report): State<Arc<Self>>) -> Response {
        match report.0.get() {
            Some(html) => http::report(html),
            None => Problem::with_status(
                StatusCode::NOT_FOUND,
                "the validation is not computed yet",
                "the page computes it: press `Validation` there",
            )
            .page(),
        }
    }

    /// `POST /api/validation`: computes the report, unless it is there.
    pub(crate) async fn post(
        State(report): State<Arc<Self>>,
        State(workers): State<Workers>,
        request: Request,
    ) -> Response {
        if let Err(problem) = request::read::<Empty>(request).await {
            return problem.into_response();
        }
        events::respond(&workers, move |stop, events| {
            if report.0.get().is_none() {
                let progress = |fraction: f64| {
                    events.progress(fraction, "published tests");
                    match events.is_disconnected() {
                        true => ControlFlow::Break(()),
                        false => stop.flow(),
                    }
                };
                let tests = experiments::built_in();
                let (models, library) = (model::fast_models(), Library::built_in());
                let validation = validate::run(&models, tests, library, &progress)
                    .map_err(|error| stop.problem(error))?;
                let origin = Origin {
                    files: vec![format!("the program's own ({})", tests.len())],
                    command: "percuss validate".to_owned(),
                };
                // Of two that compute at once the first one is kept: they are the same.
                let _ = report.0.set(validation::html(&validation, &origin));
            }
            Ok(json!({ "address": "/validation" }))
        })
        .await
    }
}
