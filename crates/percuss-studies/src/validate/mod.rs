//! Validation: every model on every published test that it applies to, and how far off it is.
//!
//! ```no_run
//! use std::ops::ControlFlow;
//! use percuss::{experiments, material::Library, model::fast_models, validate};
//!
//! let validation = validate::run(&fast_models(), experiments::built_in(), Library::built_in(), &|_| ControlFlow::Continue(()))?;
//! for group in validate::statistics(&validation, validate::Grouping::All) {
//!     println!("{} {}: RMS {:.1} % of {}", group.model, group.kind.name(), 100.0 * group.errors.rms, group.errors.count);
//! }
//! # Ok::<(), percuss::Error>(())
//! ```

mod grouping;
mod prediction;
mod record;
mod statistics;
#[cfg(test)]
mod tests;

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicBool, AtomicUsize, Ordering},
};

use rayon::prelude::*;

pub use grouping::{
    Coverage, Group, Grouping, HOT, SEPARATOR, coverage, statistics, without_tests,
};
pub use prediction::{Prediction, Standing};
pub use record::PredictionRecord;
pub use statistics::Errors;

use prediction::Computed;

use crate::{
    Error, Scenario, cost,
    experiments::Experiment,
    material::Library,
    model::{Estimate, Model},
    validity::FittedTo,
};

/// What every model said of every test.
#[derive(Debug, Clone, PartialEq)]
pub struct Validation {
    /// The tests.
    pub tests: Vec<Experiment>,
    /// Names of the models, in their own order.
    pub models: Vec<&'static str>,
    /// What each of them was fitted to or chosen on.
    pub fitted_to: Vec<&'static [FittedTo]>,
    /// One entry a test, material record and model, in that order.
    pub predictions: Vec<Prediction>,
}

impl Validation {
    /// The test that a prediction is of.
    pub fn test(&self, prediction: &Prediction) -> &Experiment {
        &self.tests[prediction.test]
    }
}

/// Each test with each of its material records, by number.
fn jobs(tests: &[Experiment]) -> impl Iterator<Item = (usize, usize)> {
    let records = |test: &Experiment| test.projectile_materials.len().max(1);
    let numbered = tests.iter().enumerate();
    numbered.flat_map(move |(i, test)| (0..records(test)).map(move |record| (i, record)))
}

/// A test as a case, with one of its material records.
fn scenario(test: &Experiment, record: usize, library: &Library) -> Result<Scenario, String> {
    let name = test.projectile_materials.get(record);
    test.scenario(name.map_or("", String::as_str), library)
}

/// Estimated cost of [`run`].
pub fn estimate(
    models: &[&'static dyn Model],
    tests: &[Experiment],
    library: &Library,
) -> Estimate {
    let of_job = |(test, record): (usize, usize)| {
        let (test, models) = (&tests[test], models.iter());
        let giving = models.filter(|m| m.validity().predicts.contains(&test.kind.quantity()));
        match scenario(test, record, library) {
            Ok(case) => giving.map(|model| cost::of_run(*model, &case)).sum(),
            Err(_) => Estimate::LITTLE,
        }
    };
    jobs(tests).map(of_job).sum()
}

/// Computes every test with every model that applies, on all cores.
///
/// `progress` is called with the part done, 0 to 1, from several threads; [`ControlFlow::Break`] ends the validation.
///
/// # Errors
/// [`Error::Cancelled`]; a model that fails on a test is an entry of the result and no error.
pub fn run(
    models: &[&'static dyn Model],
    tests: &[Experiment],
    library: &Library,
    progress: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Validation, Error> {
    let jobs: Vec<(usize, usize)> = jobs(tests).collect();
    let total = (jobs.len() * models.len()).max(1);
    let (done, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let compute = |&(test, record): &(usize, usize)| -> Vec<Prediction> {
        let scenario = scenario(&tests[test], record, library);
        let regime = scenario
            .as_ref()
            .map_or_else(|_| String::new(), prediction::regime_of);
        let of_model = |&model: &&'static dyn Model| {
            let case = Computed {
                test: &tests[test],
                index: test,
                record,
                scenario: &scenario,
                regime: &regime,
            };
            let prediction = case.predict(model, &stop);
            let finished = 1 + done.fetch_add(1, Ordering::Relaxed);
            if progress(finished as f64 / total as f64).is_break() {
                stop.store(true, Ordering::Relaxed);
            }
            prediction
        };
        models
            .iter()
            .take_while(|_| !stop.load(Ordering::Relaxed))
            .map(of_model)
            .collect()
    };
    // Tests differ in cost by orders of magnitude: one at a time, so that no core is left with a block of slow ones.
    let memory = estimate(models, tests, library).memory;
    let predictions: Vec<Vec<Prediction>> = cost::within_memory(memory, || {
        jobs.par_iter().with_max_len(1).map(compute).collect()
    });
    if stop.load(Ordering::Relaxed) {
        return Err(Error::Cancelled {
            step: done.load(Ordering::Relaxed) as u64,
            time_us: 0.0,
        });
    }
    Ok(Validation {
        tests: tests.to_vec(),
        models: models.iter().map(|model| model.name()).collect(),
        fitted_to: models
            .iter()
            .map(|model| model.validity().fitted_to)
            .collect(),
        predictions: predictions.into_iter().flatten().collect(),
    })
}

/// A test as a case, with its main material record.
pub(crate) fn main_scenario(test: &Experiment, library: &Library) -> Result<Scenario, String> {
    scenario(test, 0, library)
}

/// Prediction of a model for a test, by its index, with its main material record.
pub(crate) fn with_main_record(
    model: &dyn Model,
    index: usize,
    test: &Experiment,
    library: &Library,
) -> Prediction {
    let case = Computed {
        test,
        index,
        record: 0,
        scenario: &main_scenario(test, library),
        regime: "",
    };
    case.predict(model, &AtomicBool::new(false))
}
