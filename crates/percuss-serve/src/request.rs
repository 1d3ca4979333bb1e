//! Reading requests: JSON of a limited size that arrives in a limited time, and the case in it.

use std::{future::poll_fn, pin::Pin};

use axum::{
    body::{Body, HttpBody},
    extract::{FromRequest, Request},
    http::{StatusCode, header},
};
use percuss::{
    Scenario, case,
    model::{self, ChosenModel},
    quote::shorten_words,
};
use serde::{Deserialize, de::DeserializeOwned};
use tokio::time;

use crate::{
    RequestLimits,
    edit::{self, Edit},
    limits::{ARRIVAL, BODY, LARGEST_READ_BODY},
    problem::Problem,
};

/// A case as the page sends it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CaseRequest {
    /// Name of the case.
    #[serde(default)]
    pub(crate) name: String,
    /// Text of the case.
    pub(crate) case: String,
    /// Edits of the form.
    #[serde(default)]
    pub(crate) edits: Vec<Edit>,
    /// Model; the default of the case when not given.
    #[serde(default)]
    pub(crate) model: Option<String>,
    /// Impact velocities for a comparison [m/s]: first, last and number; that of the case when not given.
    #[serde(default)]
    pub(crate) speeds: Option<(f64, f64, usize)>,
    /// Settings of the uncertainty analysis.
    #[serde(default)]
    pub(crate) uncertainty: Sampling,
    /// Text of a sweep file; the case replaces its base.
    #[serde(default)]
    pub(crate) sweep: String,
    /// Settings of the calibration.
    #[serde(default)]
    pub(crate) fit: Fitting,
    /// Visible charts while a slider moves: the response has only these, with fewer points.
    #[serde(default)]
    pub(crate) in_view: Option<Vec<String>>,
    /// Requested file.
    #[serde(default)]
    pub(crate) file: Option<String>,
}

impl<S: Sync> FromRequest<S> for CaseRequest {
    type Rejection = Problem;

    async fn from_request(request: Request, _: &S) -> Result<Self, Problem> {
        read(request).await
    }
}

/// Settings of an uncertainty analysis.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Sampling {
    pub(crate) samples: u64,
    pub(crate) seed: u64,
    pub(crate) indices: bool,
}

impl Default for Sampling {
    fn default() -> Self {
        Self {
            samples: 256,
            seed: 0,
            indices: true,
        }
    }
}

/// A calibration.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Fitting {
    /// Text of a file of parameters.
    pub(crate) file: String,
    /// Scatter about the model, as `--noise` of the command line takes it.
    pub(crate) noise: String,
    /// Steps of the walkers; least squares only when not given.
    pub(crate) steps: Option<usize>,
    pub(crate) seed: u64,
    /// Sources that test the result.
    pub(crate) hold_out: Vec<String>,
}

impl Default for Fitting {
    fn default() -> Self {
        Self {
            file: String::new(),
            noise: "estimated".to_owned(),
            steps: None,
            seed: 0,
            hold_out: Vec::new(),
        }
    }
}

/// Case with its resolved scenario.
pub(crate) struct ReadCase {
    pub(crate) text: String,
    pub(crate) scenario: Scenario,
}

impl CaseRequest {
    /// Text with the edits of the form.
    pub(crate) fn edited(&self) -> Result<String, Problem> {
        edit::apply(&self.case, &self.edits)
    }

    /// Reads the edited text with the reader of the command line.
    pub(crate) fn read(&self, text: String) -> Result<ReadCase, Problem> {
        let scenario = case::load_str(self.name(), &text)?;
        Ok(ReadCase { text, scenario })
    }

    /// Name of the case.
    pub(crate) fn name(&self) -> &str {
        match self.name.trim() {
            "" => "case",
            name => name,
        }
    }

    /// Requested model, or the default of the case, within the limits.
    pub(crate) fn model(
        &self,
        scenario: &Scenario,
        bounds: &RequestLimits,
    ) -> Result<ChosenModel, Problem> {
        let chosen = model::choose(self.model.as_deref(), scenario)?;
        bounds.check(chosen.model, scenario)?;
        Ok(chosen)
    }
}

/// The body of a request.
async fn body(request: Request) -> Result<Vec<u8>, Problem> {
    let json = request
        .headers()
        .get(header::CONTENT_TYPE)
        .and_then(|value| value.to_str().ok())
        .is_some_and(|kind| {
            kind.split(';').next().unwrap_or_default().trim() == "application/json"
        });
    if !json {
        return Err(Problem::with_status(
            StatusCode::UNSUPPORTED_MEDIA_TYPE,
            "the request is not of type application/json",
            "reload the page",
        ));
    }
    let too_large = || {
        Problem::with_status(
            StatusCode::PAYLOAD_TOO_LARGE,
            &format!("the case is larger than {} KiB", BODY >> 10),
            "shorten it, or use `percuss run`",
        )
    };
    match time::timeout(ARRIVAL, whole(request.into_body())).await {
        Ok(Ok(bytes)) => Ok(bytes),
        Ok(Err(Unread::TooLarge)) => Err(too_large()),
        Ok(Err(Unread::Broken)) => Err(Problem::bad_request(
            "the body of the request is broken".to_owned(),
        )),
        Err(_) => Err(Problem::with_status(
            StatusCode::REQUEST_TIMEOUT,
            &format!(
                "the request took more than {} s to arrive",
                ARRIVAL.as_secs()
            ),
            "try again",
        )),
    }
}

/// Why a body is not read.
enum Unread {
    TooLarge,
    Broken,
}

/// Whole body.
async fn whole(mut body: Body) -> Result<Vec<u8>, Unread> {
    let (mut bytes, mut length) = (Vec::new(), 0_usize);
    while let Some(frame) = poll_fn(|context| Pin::new(&mut body).poll_frame(context)).await {
        let Ok(data) = frame.map_err(|_| Unread::Broken)?.into_data() else {
            continue;
        };
        length += data.len();
        if length > LARGEST_READ_BODY {
            return Err(Unread::TooLarge);
        }
        if length <= BODY {
            bytes.extend_from_slice(&data);
        }
    }
    match length <= BODY {
        true => Ok(bytes),
        false => Err(Unread::TooLarge),
    }
}

/// Reads a request.
pub(crate) async fn read<T: DeserializeOwned>(request: Request) -> Result<T, Problem> {
    let bytes = body(request).await?;
    serde_json::from_slice(&bytes).map_err(|error| {
        let error = shorten_words(&error.to_string());
        Problem::bad_request(format!("the request is not valid: {error}"))
    })
}
