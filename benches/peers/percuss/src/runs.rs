//! Runs of a case as percuss itself computes them: large strain, contact, border shear and energy balance, each to its end.

use std::{path::Path, sync::atomic::AtomicBool};

use percuss::{
    Scenario, case,
    model::{self, Control},
    sweep::{BatchKernel, Kernel, SweepRun},
};
use rayon::prelude::*;

use crate::Outcome;

/// Runs that are computed together, as many as in a block of `percuss sweep`.
const BLOCK: usize = 64;

/// Runs of a case at speeds from 150 to 400 m/s.
pub(crate) fn scenarios(case: &str, count: u32) -> Outcome<Vec<Scenario>> {
    let scenario = case::load(Path::new(case))?;
    let speeds = (0..count).map(|i| 150.0 + 250.0 * (f64::from(i) + 0.5) / f64::from(count));
    let scenarios = speeds.map(|impact_velocity| Scenario {
        impact_velocity,
        ..scenario.clone()
    });
    Ok(scenarios.collect())
}

/// Computes runs as `percuss sweep` does, on the threads of the pool: the sum of elements times steps.
pub(crate) fn side_by_side(scenarios: &[Scenario]) -> Outcome<u64> {
    let kernel = BatchKernel::new(model::model("chain")?);
    let stop = AtomicBool::new(false);
    let blocks = scenarios.par_chunks(BLOCK).map(|block| {
        let runs = block.iter().enumerate().map(|(i, scenario)| SweepRun {
            index: i as u64,
            inputs: vec![scenario.impact_velocity],
            scenario: Ok(scenario.clone()),
        });
        let rows = kernel.rows(runs.collect(), &stop);
        let rows = rows.map_err(|_| "the runs were stopped".to_owned())?;
        let steps = rows.into_iter().map(|row| {
            let record = row.record?;
            let reason = record.reason.unwrap_or_default();
            record.steps.ok_or(reason)
        });
        steps.sum::<Result<u64, String>>()
    });
    let steps = blocks.sum::<Result<u64, String>>()?;
    Ok(steps * elements(scenarios))
}

/// Computes runs as `percuss run` does: the sum of elements times steps.
pub(crate) fn one_by_one(scenarios: &[Scenario]) -> Outcome<u64> {
    let chain = model::model("chain")?;
    let mut steps = 0;
    for scenario in scenarios {
        steps += model::run(chain, scenario, &mut Control::default())?
            .numerics()
            .steps;
    }
    Ok(steps * elements(scenarios))
}

/// Elements of a run: all runs have as many.
fn elements(scenarios: &[Scenario]) -> u64 {
    scenarios.first().map_or(0, |scenario| {
        let chain = &scenario.options.chain;
        (chain.projectile_elements() + chain.target_elements()) as u64
    })
}
