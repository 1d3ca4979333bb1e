//! Mesh convergence.

use percuss::{
    converge::{self, REFINEMENT},
    model::{self, Control},
};
use percuss_report::{Chart, convergence_chart};
use serde_json::json;

use super::{Job, Study};
use crate::{events::pretty, problem::Problem};

/// Meshes of a convergence study.
const LEVELS: u32 = 4;

pub(super) fn converged(job: &Job<'_>) -> Result<Study, Problem> {
    let scenario = job.read()?.scenario;
    let model = job.model(&scenario)?;
    let finest = model.refined(&scenario, f64::from(REFINEMENT.pow(LEVELS - 1)));
    job.bounds
        .check(model, finest.as_ref().unwrap_or(&scenario))?;
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
        job.go_on(done / total, &format!("mesh {} of {LEVELS}", level + 1))
    };
    let mut control = Control {
        progress: Some(&mut report),
        ..Control::default()
    };
    let (study, _) = converge::study(model, &scenario, LEVELS, &mut control)
        .map_err(|error| job.stop.problem(error))?;
    let charts: Vec<Chart> = (0..study.quantities.len())
        .filter_map(|i| convergence_chart(scenario.heading(), &study, i))
        .collect();
    let words: Vec<String> = study
        .quantities
        .iter()
        .map(|quantity| study.describe(quantity))
        .collect();
    let files = [("convergence.json".to_owned(), pretty(&study))];
    let record = json!({ "study": study, "words": words });
    Ok(Study::new(record, &charts, files))
}
