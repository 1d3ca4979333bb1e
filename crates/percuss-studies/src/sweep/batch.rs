//! Shots of the chain model computed side by side.

use std::sync::atomic::AtomicBool;

use super::{
    caught::caught,
    kernel::{Kernel, Row, ScalarKernel, Shot, Stopped},
};
use crate::{
    Scenario, chain,
    model::{self, Model},
    regime::Regime,
    summary::ResultRecord,
};

/// Computes shots of the chain model side by side, as many at once as the processor's registers are wide, and all others one after
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

    /// Whether shots like this one are computed side by side.
    pub(super) fn takes(model: &dyn Model, scenario: &Scenario) -> bool {
        model.name() == chain::Chain.name() && chain::is_for_batch(scenario)
    }

    /// What is known of a shot before it is computed, if it can be computed beside others.
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
    fn rows(&self, shots: Vec<Shot>, stop: &AtomicBool) -> Result<Vec<Row>, Stopped> {
        let prepared: Vec<_> = shots
            .iter()
            .map(|shot| self.prepare(shot.scenario.as_ref().ok()?))
            .collect();
        let together: Vec<&Scenario> = shots
            .iter()
            .zip(&prepared)
            .filter(|(_, prepared)| prepared.is_some())
            .filter_map(|(shot, _)| shot.scenario.as_ref().ok())
            .collect();
        // A panic costs the bundle no more than the time: one after the other, its shot alone is at fault.
        let Ok(results) = caught(|| chain::run_batch(&together, stop)) else {
            return self.scalar.rows(shots, stop);
        };
        let mut results = results.map_err(|chain::Stopped| Stopped)?.into_iter();
        let mut records = Vec::with_capacity(shots.len());
        for (shot, prepared) in shots.iter().zip(prepared) {
            let record = match (&shot.scenario, prepared) {
                (Err(reason), _) => Err(reason.clone()),
                (Ok(scenario), None) => Ok(self.scalar.record(scenario, stop)?),
                (Ok(scenario), Some((regime, warnings))) => {
                    // There is a result for every shot that was prepared.
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
        let rows = shots.into_iter().zip(records).map(|(shot, record)| Row {
            index: shot.index,
            inputs: shot.inputs,
            record,
        });
        Ok(rows.collect())
    }
}
