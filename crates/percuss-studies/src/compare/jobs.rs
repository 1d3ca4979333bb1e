//! Runs of many models at many velocities, side by side.

use std::{
    ops::ControlFlow,
    sync::{Mutex, PoisonError},
};

use rayon::prelude::*;

use crate::{
    Error, Scenario,
    axisymmetric::{MODEL, Request},
    cost,
    model::{self, Control, Model},
    outcome::Band,
    regime::Regime,
    solver::go_on_to_next_run,
    summary::ResultRecord,
};

/// How far a comparison has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Runs that have ended.
    pub finished: usize,
    /// All runs.
    pub total: usize,
    /// Estimated part done, 0 to 1.
    pub fraction: f64,
}

/// What a caller wants of a comparison: progress and a way to stop it.
#[derive(Default)]
pub struct Observer<'a> {
    /// Called now and then from any thread, never from two at once; [`ControlFlow::Break`] ends the comparison.
    pub progress: Option<&'a mut (dyn FnMut(Progress) -> ControlFlow<()> + Send)>,
}

impl std::fmt::Debug for Observer<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Observer").finish_non_exhaustive()
    }
}

/// The case at each impact velocity, with its regime.
pub(super) fn scenarios(scenario: &Scenario, velocities: &[f64]) -> Vec<(Scenario, Regime)> {
    velocities
        .par_iter()
        .map(|&velocity| {
            let scenario = scenario.at_impact_velocity(velocity);
            let regime = Regime::of(&scenario);
            (scenario, regime)
        })
        .collect()
}

/// What runs at every velocity.
pub(super) enum Entry<'a> {
    /// A model, once.
    Model(&'a dyn Model),
    /// The axisymmetric model, on several meshes.
    Axisymmetric(&'a dyn Model, Request),
}

impl<'a> Entry<'a> {
    pub(super) fn model(&self) -> &'a dyn Model {
        match self {
            Self::Model(model) | Self::Axisymmetric(model, _) => *model,
        }
    }
}

/// The axisymmetric answer where it is requested, and the models.
pub(super) fn all_of<'a>(
    models: &[&'a dyn Model],
    axisymmetric: Option<Request>,
) -> Result<Vec<Entry<'a>>, Error> {
    let mut all = Vec::new();
    if let Some(request) = axisymmetric {
        all.push(Entry::Axisymmetric(model::model(MODEL)?, request));
    }
    all.extend(models.iter().map(|model| Entry::Model(*model)));
    Ok(all)
}

/// Memory of the largest of the jobs [bytes].
pub(super) fn memory(models: &[Entry<'_>], runs: &[(Scenario, Regime)]) -> f64 {
    let of_one = |entry: &Entry<'_>, scenario: &Scenario| match entry {
        Entry::Model(model) => cost::of_run(*model, scenario).memory,
        Entry::Axisymmetric(_, request) => request.memory(scenario),
    };
    let pairs = runs
        .iter()
        .flat_map(|(scenario, _)| models.iter().map(move |entry| of_one(entry, scenario)));
    pairs.fold(0.0, f64::max)
}

/// Runs every model at every velocity; the results of one velocity are consecutive. Beside each, why its number is not one to use.
pub(super) fn run(
    models: &[Entry<'_>],
    runs: &[(Scenario, Regime)],
    observer: &mut Observer<'_>,
) -> Result<Vec<(ResultRecord, Option<String>)>, Error> {
    let total = models.len() * runs.len();
    let board = Mutex::new(Board {
        fractions: vec![0.0; total],
        sum: 0.0,
        finished: 0,
        stopped: false,
        observer,
    });
    (0..total)
        .into_par_iter()
        .map(|job| {
            let (scenario, regime) = &runs[job / models.len()];
            run_one(&models[job % models.len()], scenario, regime, |fraction| {
                // A caller whose callback has panicked gets its panic anyway.
                let mut board = board.lock().unwrap_or_else(PoisonError::into_inner);
                board.update(job, fraction)
            })
        })
        .collect()
}

fn run_one(
    entry: &Entry<'_>,
    scenario: &Scenario,
    regime: &Regime,
    update: impl Fn(f64) -> ControlFlow<()> + Sync,
) -> Result<(ResultRecord, Option<String>), Error> {
    go_on_to_next_run(update(0.0))?;
    let record = match entry {
        Entry::Axisymmetric(_, request) => {
            let mut report = |fraction: f64| update(fraction.clamp(0.0, 1.0));
            axisymmetric_record(request, scenario, regime, &mut report)?
        }
        Entry::Model(model) => {
            let mut report = |now: model::Progress| update(now.fraction.clamp(0.0, 1.0));
            let mut control = Control {
                record: !scenario.measured_curves.is_empty(),
                progress: Some(&mut report),
                ..Control::default()
            };
            match model::run_in(*model, scenario, regime, &mut control) {
                Ok(result) => (ResultRecord::in_regime(scenario, regime, &result), None),
                Err(stop @ Error::Cancelled { .. }) => return Err(stop),
                Err(error) => {
                    let record = ResultRecord::without_result(scenario, model.name(), &error);
                    (record, None)
                }
            }
        }
    };
    go_on_to_next_run(update(FINISHED))?;
    Ok(record)
}

/// Record of the model `axi` by the axisymmetric answer: its main number in the limit of the meshes, with the discretisation
/// uncertainty as its range; or why there is none.
fn axisymmetric_record(
    request: &Request,
    scenario: &Scenario,
    regime: &Regime,
    report: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
) -> Result<(ResultRecord, Option<String>), Error> {
    let answer = request.answer(scenario, report)?;
    let Some((quantity, finest)) = answer.quantity.zip(answer.finest) else {
        let error = Error::not_applicable(MODEL, answer.reason.unwrap_or_default());
        return Ok((ResultRecord::without_result(scenario, MODEL, &error), None));
    };
    let band = answer.value.zip(answer.uncertainty);
    let band = band.map(|(value, uncertainty)| Band {
        quantity,
        // Depths, lengths and velocities after perforation are not negative.
        low: match value >= 0.0 {
            true => (value - uncertainty).max(0.0),
            false => value - uncertainty,
        },
        high: value + uncertainty,
        basis: "discretisation uncertainty",
    });
    let mut record = ResultRecord::in_regime(scenario, regime, &finest).with_main_number(
        quantity,
        answer.value,
        band,
    );
    if let Some(doubt) = &answer.doubt {
        record
            .warnings
            .insert(0, format!("not to be relied on: {doubt}"));
    }
    Ok((record, answer.doubt))
}

/// Part of a run that says that it has ended: what runs say of themselves stays within 1.
const FINISHED: f64 = 2.0;

/// What all runs together have done.
struct Board<'a, 'b> {
    fractions: Vec<f64>,
    sum: f64,
    finished: usize,
    stopped: bool,
    observer: &'a mut Observer<'b>,
}

impl Board<'_, '_> {
    fn update(&mut self, job: usize, fraction: f64) -> ControlFlow<()> {
        if self.stopped {
            return ControlFlow::Break(());
        }
        if fraction == FINISHED {
            self.finished += 1;
        }
        self.sum += fraction.min(1.0) - self.fractions[job];
        self.fractions[job] = fraction.min(1.0);
        let total = self.fractions.len();
        let progress = Progress {
            finished: self.finished,
            total,
            fraction: self.sum / total as f64,
        };
        let flow = match &mut self.observer.progress {
            Some(callback) => callback(progress),
            None => ControlFlow::Continue(()),
        };
        self.stopped = flow.is_break();
        flow
    }
}
