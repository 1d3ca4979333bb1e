//! Reading requests: JSON of a limited size that arrives in a limited time, and the case in it.

use std::{future::poll_fn, pin::Pin};

use axum::{
    body::{Body, HttpBody},
    extract::Request,
    http::{StatusCode, header},
};
use percuss::{
    Scenario, case,
    model::{self, ChosenModel},
};
use serde::{Deserialize, de::DeserializeOwned};
use tokio::time;

use crate::{
    Bounds,
    bounds::{ARRIVAL, BODY, PATIENT_BODY},
    edit::{self, Edit},
    problem::Problem,
};

/// A case as the page sends it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CaseRequest {
    /// Name of the case.
    #[serde(default)]
    pub(crate) name: String,
    /// The text of the case.
    pub(crate) case: String,
    /// What its form changes.
    #[serde(default)]
    pub(crate) edits: Vec<Edit>,
    /// Model to compute with; one that suits the case when not given.
    #[serde(default)]
    pub(crate) model: Option<String>,
    /// Impact speeds to compare models at [m/s]: first, last and how many; the case's own when not given.
    #[serde(default)]
    pub(crate) speeds: Option<(f64, f64, usize)>,
    /// How the uncertainty of the case is computed.
    #[serde(default)]
    pub(crate) uncertainty: Sampling,
    /// The text of a sweep file, in which the case is varied whatever base it names.
    #[serde(default)]
    pub(crate) sweep: String,
    /// How numbers of the case are fitted to what was measured.
    #[serde(default)]
    pub(crate) fit: Fitting,
    /// Charts that are to be seen while a slider moves: the answer has no others, and their curves have fewer points.
    #[serde(default)]
    pub(crate) in_view: Option<Vec<String>>,
    /// File that is asked for.
    #[serde(default)]
    pub(crate) file: Option<String>,
}

/// Shots of an analysis of uncertainty.
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
    /// The text of a file of parameters.
    pub(crate) file: String,
    /// Scatter about the model, as `--noise` of the command line takes it.
    pub(crate) noise: String,
    /// Steps of the walkers that sample the posterior; least squares only when not given.
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

/// A case that was understood.
pub(crate) struct ReadCase {
    pub(crate) text: String,
    pub(crate) scenario: Scenario,
}

impl CaseRequest {
    /// The text with what the form changes.
    pub(crate) fn edited(&self) -> Result<String, Problem> {
        edit::apply(&self.case, &self.edits)
    }

    /// Reads the edited text, as the command line reads a file.
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

    /// The model that is asked for, or the default one of the case, within bounds.
    pub(crate) fn model(
        &self,
        scenario: &Scenario,
        bounds: &Bounds,
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
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err(too_large()),
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

/// All of a body; nothing of one that is too large or breaks off.
async fn whole(mut body: Body) -> Option<Vec<u8>> {
    let (mut bytes, mut length) = (Vec::new(), 0_usize);
    while let Some(frame) = poll_fn(|context| Pin::new(&mut body).poll_frame(context)).await {
        let Ok(data) = frame.ok()?.into_data() else {
            continue;
        };
        length += data.len();
        if length > PATIENT_BODY {
            return None;
        }
        if length <= BODY {
            bytes.extend_from_slice(&data);
        }
    }
    (length <= BODY).then_some(bytes)
}

/// What a request says.
pub(crate) async fn read<T: DeserializeOwned>(request: Request) -> Result<T, Problem> {
    let bytes = body(request).await?;
    serde_json::from_slice(&bytes)
        .map_err(|error| Problem::bad_request(format!("the request is not understood: {error}")))
}
