//! Axisymmetric answer that refines itself: runs of `axi` on one mesh after the other, with their frames.

mod frames;
mod messages;

use std::{
    ops::ControlFlow,
    time::{Duration, Instant},
};

use axum::{extract::State, response::Response};
use percuss::{
    Error, Refusal, Scenario,
    axisymmetric::{
        self, AxisymmetricAnswer, BUDGET, MeshResult, ReferenceMeshes, main_number, seconds,
    },
    model::{self, Control, Model},
    outcome::{BandQuantity, RunResult},
    scenario::TargetBody,
};
use percuss_report::{
    FieldColors,
    axisymmetric_rows::{headline, listed, rows},
    palette,
    result_rows::Row,
};
use serde::Serialize;
use serde_json::{Value, json};

use self::{
    frames::{FrameEncoder, QUANTITIES},
    messages::MessageSender,
};
use crate::{RequestLimits, job::Workers, problem::Problem, request::CaseRequest};

/// Name of the model.
const MODEL: &str = "axi";
/// Cells along the radius of the mesh that follows the standard ones.
const FINEST: u32 = 8;
/// Shortest time between two reports of the progress.
const REPORT: Duration = Duration::from_millis(50);
/// Number of colours of bodies: the projectile and three layers, which repeat.
const BODY_COLORS: u8 = 4;

/// `POST /api/refinement`.
pub(crate) async fn post(State(workers): State<Workers>, asked: CaseRequest) -> Response {
    let bounds = *workers.bounds();
    messages::respond(&workers, move |client| refine(&asked, &bounds, client)).await
}

/// Meshes of a refinement.
struct Meshes {
    cells: Vec<u32>,
    /// Reason why that is not all of them.
    note: Option<String>,
}

/// The meshes that fit into the time that a run takes unasked, and into that of a request.
fn meshes(scenario: &Scenario, bounds: &RequestLimits) -> Result<Meshes, Refusal> {
    let budget = BUDGET.min(bounds.seconds as f64);
    let plan = axisymmetric::plan(scenario, ReferenceMeshes::Standard, Some(budget))?;
    let (mut cells, mut note) = (plan.cells, plan.note);
    if note.is_none() {
        cells.push(FINEST);
        let cost: f64 = cells.iter().map(|&n| seconds(scenario, n)).sum();
        if cost > budget {
            cells.pop();
            note = Some(format!(
                "the mesh of {FINEST} cells is left out: all meshes take about {cost:.0} s of processor time; `percuss run --reference fine` computes it"
            ));
        }
    }
    Ok(Meshes { cells, note })
}

fn refine(
    asked: &CaseRequest,
    bounds: &RequestLimits,
    client: &MessageSender,
) -> Result<(), Problem> {
    let scenario = asked.read(asked.edited()?)?.scenario;
    let axi = model::model(MODEL)?;
    let Meshes { cells, note } = match meshes(&scenario, bounds) {
        Ok(meshes) => meshes,
        Err(refusal) => {
            let refused = json!({ "reason": refusal.reason, "remedy": refusal.remedy });
            client.offer(&json!({ "refused": refused }));
            return Ok(());
        }
    };
    let finest = cells.last().copied().unwrap_or(FINEST);
    bounds.check(axi, &on(&scenario, finest))?;
    sent(client, client.send(&plan(&scenario, &cells), &[]))?;
    let mut results = Vec::new();
    let mut notes = Vec::from_iter(note);
    for &cells in &cells {
        match run(axi, &on(&scenario, cells), cells, client) {
            Ok(result) => results.push(MeshResult::new(cells, &result)),
            Err(error @ Error::Cancelled { .. }) => return Err(client.problem(error)),
            Err(error) => notes.push(format!("the run on {cells} cells failed: {error}")),
        }
        let answer = Answer::new(&scenario, cells, &results, &notes);
        sent(client, client.send(&json!({ "answer": answer }), &[]))?;
    }
    Ok(())
}

/// The problem of a message that was not sent.
fn sent(client: &MessageSender, flow: ControlFlow<()>) -> Result<(), Problem> {
    match flow {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(client.ended()),
    }
}

/// The case on a mesh.
fn on(scenario: &Scenario, cells: u32) -> Scenario {
    let mut scenario = scenario.clone();
    scenario.options.axi.cells_per_radius = Some(cells);
    scenario
}

/// What the page has to know before the first frame.
fn plan(scenario: &Scenario, cells: &[u32]) -> Value {
    let wall = scenario.target == TargetBody::RigidWall;
    let hex = |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}");
    let quantities = QUANTITIES.map(|quantity| {
        let colors = FieldColors::new(quantity, (0.0, 1.0), wall);
        let bands = (0..FieldColors::LEVELS).map(|level| hex(colors.band(level)));
        json!({
            "name": quantity.name(),
            "label": quantity.label(),
            "colors": bands.collect::<Vec<_>>(),
            "bare": colors.bare(),
        })
    });
    let bodies = (0..BODY_COLORS).map(|index| hex(FieldColors::body(index)));
    json!({ "plan": {
        "cells": cells,
        "words": format!("{} cells per radius", listed(cells)),
        "wall": wall.then_some(hex(FieldColors::WALL)),
        "edge": hex(FieldColors::EDGE),
        "bodies": bodies.collect::<Vec<_>>(),
        "quantities": quantities,
        "colors": { "axisymmetric": palette::SERIES[0], "beside": palette::MARK },
    } })
}

/// Runs the model on a mesh and sends its frames.
fn run(
    axi: &dyn Model,
    scenario: &Scenario,
    cells: u32,
    client: &MessageSender,
) -> Result<RunResult, Error> {
    let mut encoder = FrameEncoder::new(scenario, cells);
    let mut reported = Instant::now();
    let mut progress = |now: model::Progress| {
        if reported.elapsed() >= REPORT {
            reported = Instant::now();
            let fraction = now.fraction;
            client.offer(&json!({ "progress": { "cells": cells, "fraction": fraction } }));
        }
        client.go_on()
    };
    let mut frames = |frame: &percuss::frames::Frame<'_>| match encoder.encode(frame) {
        Some((head, body)) => client.send(&json!({ "frame": head }), &body),
        None => ControlFlow::Continue(()),
    };
    let mut control = Control {
        progress: Some(&mut progress),
        frames: Some(&mut frames),
        ..Control::default()
    };
    model::run(axi, scenario, &mut control)
}

/// Answer of the meshes so far.
#[derive(Serialize)]
struct Answer {
    /// Cells along the radius of the mesh that has just ended.
    cells: u32,
    /// Main number.
    quantity: BandQuantity,
    unit: &'static str,
    /// Values of the main number on the meshes so far.
    meshes: Vec<(u32, Option<f64>)>,
    value: Option<f64>,
    uncertainty: Option<f64>,
    /// Name of the main number and its value with its uncertainty.
    headline: Option<[String; 2]>,
    rows: Vec<Row>,
    /// Reason why there is no answer; with one mesh there is none yet.
    reason: Option<String>,
    note: Option<String>,
}

impl Answer {
    fn new(scenario: &Scenario, cells: u32, meshes: &[MeshResult], notes: &[String]) -> Self {
        let answer =
            AxisymmetricAnswer::of(scenario, ReferenceMeshes::Standard, meshes.to_vec(), notes);
        let last = meshes
            .last()
            .map(|mesh| main_number(scenario, mesh.outcome));
        let quantity = last.unwrap_or(BandQuantity::DepthOfPenetration);
        let said: Vec<&str> = [&answer.doubt, &answer.note]
            .into_iter()
            .filter_map(|text| text.as_deref())
            .collect();
        let said = (!said.is_empty()).then(|| said.join("; "));
        Self {
            cells,
            quantity,
            unit: quantity.unit(),
            meshes: meshes
                .iter()
                .map(|mesh| (mesh.cells_per_radius, mesh.value(quantity)))
                .collect(),
            value: answer.value,
            uncertainty: answer.uncertainty,
            headline: headline(&answer),
            rows: rows(&answer, None),
            reason: answer.reason,
            note: said,
        }
    }
}
