//! Uncertainty analysis of a case.

use percuss::{
    case::Document,
    uncertainty::{self, MIN_SAMPLES, Settings},
};
use percuss_report::{parameter_label, uncertainty_charts, uncertainty_files};
use serde_json::{Value, json};

use super::{
    Job, Study, csv_files,
    runs::{Bounded, followed},
};
use crate::{events::pretty, problem::Problem};

/// Most runs that the statistics of a page rest on.
const MOST_SAMPLES: u64 = 16_384;

pub(super) fn uncertain(job: &Job<'_>) -> Result<Study, Problem> {
    let asked = job.asked;
    let samples = asked.uncertainty.samples;
    if !(MIN_SAMPLES..=MOST_SAMPLES).contains(&samples) {
        return Err(Problem::refused(
            format!("{samples} samples are out of range"),
            format!(
                "the page allows {MIN_SAMPLES} to {MOST_SAMPLES}; use `percuss uncertainty` for more"
            ),
        ));
    }
    let text = asked.edited()?;
    let name = asked.name().to_owned();
    let study = uncertainty::Study::of(&Document::new(&name, text))?;
    let model = job.model(&study.scenario)?;
    let kernel = Bounded::new(model, job.bounds);
    let settings = Settings {
        samples,
        seed: asked.uncertainty.seed,
        quantities: Vec::new(),
        indices: asked.uncertainty.indices,
        velocities: Vec::new(),
    };
    let found = followed(job, |watch| {
        uncertainty::analyse(&study, model, &kernel, &settings, watch)
    })
    .map_err(|error| job.stop.problem(error))?;
    if found.quantities.is_empty() && found.perforation.is_none() {
        let reasons = found.failures.reasons.join("; ");
        return Err(Problem::refused("no run has a result", reasons));
    }
    let charts = uncertainty_charts(&study.scenario, &found);
    let files: Vec<_> = csv_files(uncertainty_files(&found)?)
        .chain([("uncertainty.json".to_owned(), pretty(&found))])
        .collect();
    let quantities: Vec<Value> = found.quantities.iter().map(quantity).collect();
    let inputs = found.inputs.iter();
    let labels: Vec<String> = inputs.map(|i| parameter_label(&i.key, "")).collect();
    let record = json!({
        "uncertainty": found,
        "quantities": quantities,
        "labels": labels,
        "nominal": found.nominal.outcome.describe(),
        "caution": found.caution(),
    });
    Ok(Study::new(record, &charts, files))
}

/// A quantity in words.
fn quantity(result: &uncertainty::QuantityResult) -> Value {
    let what = result.what();
    json!({ "words": what.label, "unit": what.unit.symbol })
}
