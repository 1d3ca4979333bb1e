//! Runs of the chain model computed side by side.

use std::sync::atomic::AtomicBool;

use super::{
    kernel::{Kernel, ScalarKernel, Stopped, SweepRow, SweepRun},
    panic_guard::catch_panic,
};
use crate::{
    Scenario, chain, cost,
    lanes::LANES,
    model::{self, Model},
    regime::Regime,
    summary::ResultRecord,
};

/// Computes runs of the chain model side by side, as many at once as the processor's registers are wide, and all others one after
/// the other. The rows are those of [`ScalarKernel`].
#[derive(Clone, Copy)]
pub struct BatchKernel {
    model: &'static dyn Model,
    scalar: ScalarKernel,
}

impl BatchKernel {
    /// The kernel of a model.
    pub fn new(model: &'static dyn Model) -> Self {
        Self {
            model,
            scalar: ScalarKernel::new(model),
        }
    }

    /// Memory of a thread that computes runs like this one [bytes].
    pub(crate) fn memory_of_thread(model: &dyn Model, scenario: &Scenario) -> f64 {
        let memory = cost::of_run(model, scenario).memory;
        match Self::takes(model, scenario) {
            true => LANES as f64 * memory,
            false => memory,
        }
    }

    /// Whether runs like this one are computed side by side.
    pub(super) fn takes(model: &dyn Model, scenario: &Scenario) -> bool {
        model.name() == chain::Chain.name() && chain::is_for_batch(scenario)
    }

    /// What is known of a run before it is computed, if it can be computed beside others.
    fn prepare(&self, scenario: &Scenario) -> Option<(Regime, Vec<String>)> {
        if !Self::takes(self.model, scenario) {
            return None;
        }
        let regime = Regime::of(scenario);
        let warnings = model::applicability_in(self.model, scenario, &regime).ok()?;
        Some((regime, warnings))
    }
}

impl Kernel for BatchKernel {
    fn rows(&self, runs: Vec<SweepRun>, stop: &AtomicBool) -> Result<Vec<SweepRow>, Stopped> {
        let prepared: Vec<_> = runs
            .iter()
            .map(|run| self.prepare(run.scenario.as_ref().ok()?))
            .collect();
        let together: Vec<&Scenario> = runs
            .iter()
            .zip(&prepared)
            .filter(|(_, prepared)| prepared.is_some())
            .filter_map(|(run, _)| run.scenario.as_ref().ok())
            .collect();
        // A panic costs the bundle no more than the time: one after the other, its run alone is at fault.
        let Ok(results) = catch_panic(|| chain::run_batch(&together, stop)) else {
            return self.scalar.rows(runs, stop);
        };
        let mut results = results.map_err(|chain::Stopped| Stopped)?.into_iter();
        let mut records = Vec::with_capacity(runs.len());
        for (run, prepared) in runs.iter().zip(prepared) {
            let record = match (&run.scenario, prepared) {
                (Err(reason), _) => Err(reason.clone()),
                (Ok(scenario), None) => Ok(self.scalar.record(scenario, stop)?),
                (Ok(scenario), Some((regime, warnings))) => {
                    // There is a result for every run that was prepared.
                    let Some(result) = results.next() else { break };
                    let result = result
                        .and_then(|result| model::complete(self.model, scenario, warnings, result));
                    Ok(match result {
                        Ok(result) => ResultRecord::in_regime(scenario, &regime, &result),
                        Err(error) => {
                            ResultRecord::without_result(scenario, self.model.name(), &error)
                        }
                    })
                }
            };
            records.push(record);
        }
        let rows = runs.into_iter().zip(records).map(|(run, record)| SweepRow {
            index: run.index,
            inputs: run.inputs,
            record,
        });
        Ok(rows.collect())
    }
}
