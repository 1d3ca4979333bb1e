//! What uncertain numbers of a case do to its results.

use std::{
    sync::atomic::{AtomicBool, Ordering},
    thread,
    time::Duration,
};

use percuss::{
    case::Document,
    model::Model,
    sweep::{BatchKernel, Kernel, Row, Shot, Stopped},
    uncertainty::{self, MIN_SAMPLES, Settings, Uncertainty, Watch},
};
use percuss_report::{uncertainty_charts, uncertainty_files};
use serde_json::{Value, json};

use super::{Study, csv_files, wanted};
use crate::{
    Bounds,
    problem::Problem,
    request::CaseRequest,
    stream::{Tell, pretty},
    worker::Stop,
};

/// Most shots that the statistics of a page rest on.
const MOST_SAMPLES: u64 = 16_384;
/// Time between two looks whether somebody still waits.
const LOOK: Duration = Duration::from_millis(50);

pub(super) fn uncertain(
    asked: &CaseRequest,
    bounds: &Bounds,
    stop: &Stop,
    tell: &Tell,
) -> Result<Study, Problem> {
    let samples = asked.uncertainty.samples;
    if !(MIN_SAMPLES..=MOST_SAMPLES).contains(&samples) {
        return Err(Problem::refused(
            format!("{samples} shots are out of range"),
            format!("a page computes {MIN_SAMPLES} to {MOST_SAMPLES}; `percuss uncertainty` more"),
        ));
    }
    let text = asked.edited()?;
    let name = asked.name().to_owned();
    let study = uncertainty::Study::of(&Document::new(&name, text))?;
    let model = asked.model(&study.scenario, bounds)?;
    let kernel = Bounded {
        kernel: BatchKernel::new(model),
        model,
        bounds,
    };
    let settings = Settings {
        samples,
        seed: asked.uncertainty.seed,
        quantities: Vec::new(),
        indices: asked.uncertainty.indices,
        speeds: Vec::new(),
    };
    let found = watched(stop, tell, |watch| {
        uncertainty::analyse(&study, model, &kernel, &settings, watch)
    })
    .map_err(|error| stop.problem(error))?;
    if found.quantities.is_empty() && found.perforation.is_none() {
        let reasons = found.failures.reasons.join("; ");
        return Err(Problem::refused("no shot has a result", reasons));
    }
    let charts = uncertainty_charts(&study.scenario, &found);
    let files: Vec<_> = csv_files(uncertainty_files(&found)?)
        .chain([("uncertainty.json".to_owned(), pretty(&found))])
        .collect();
    let quantities: Vec<Value> = found.quantities.iter().map(quantity).collect();
    let labels: Vec<&str> = found.inputs.iter().map(|i| i.label.as_str()).collect();
    let record = json!({
        "uncertainty": found,
        "quantities": quantities,
        "labels": labels,
        "nominal": found.nominal.outcome.in_words(),
        "caution": found.caution(),
    });
    Ok(Study::new(record, &charts, files))
}

/// A quantity in words.
fn quantity(result: &uncertainty::QuantityResult) -> Value {
    let what = result.what();
    json!({ "words": what.in_words, "unit": what.unit })
}

/// Analyses while somebody waits: shots may be long, so that their progress is no measure of it.
fn watched(
    stop: &Stop,
    tell: &Tell,
    analyse: impl FnOnce(&Watch<'_>) -> Result<Uncertainty, percuss::Error>,
) -> Result<Uncertainty, percuss::Error> {
    let (ended, done) = (AtomicBool::new(false), AtomicBool::new(false));
    let progress = |finished: u64, total: u64| {
        let words = format!("{finished} of {total} shots");
        tell.progress(finished as f64 / total as f64, &words);
    };
    let watch = Watch {
        stop: &ended,
        progress: &progress,
    };
    thread::scope(|scope| {
        let looking = scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                if wanted(stop, tell).is_break() {
                    ended.store(true, Ordering::Relaxed);
                }
                thread::park_timeout(LOOK);
            }
        });
        // The other thread ends whatever becomes of the analysis.
        let _end = Done(&done, looking.thread().clone());
        analyse(&watch)
    })
}

/// Ends the thread that looks.
struct Done<'a>(&'a AtomicBool, thread::Thread);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
        self.1.unpark();
    }
}

/// A kernel that refuses shots which ask for more than a page may: an uncertain number can be that of elements.
struct Bounded<'a> {
    kernel: BatchKernel,
    model: &'static dyn Model,
    bounds: &'a Bounds,
}

impl Kernel for Bounded<'_> {
    fn rows(&self, mut shots: Vec<Shot>, stop: &AtomicBool) -> Result<Vec<Row>, Stopped> {
        for shot in &mut shots {
            let scenario = shot.scenario.as_ref().ok();
            if let Some(Err(problem)) = scenario.map(|s| self.bounds.check(self.model, s)) {
                shot.scenario = Err(problem.message().to_owned());
            }
        }
        self.kernel.rows(shots, stop)
    }
}
