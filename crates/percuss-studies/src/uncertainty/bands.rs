//! Percentile bands over a range of impact velocities.

use super::{
    design::Rows,
    perforation::Perforation,
    result::{Band, Draw, QuantitySpread},
    runner::Runner,
    statistics::Statistics,
};
use crate::{
    summary::ResultNumber,
    sweep::{Stopped, values},
};

/// Most runs at one speed.
pub(super) const RUNS: u64 = 256;

/// The runs at each speed. Speed by speed the other parameters take the same values, so that curves are smooth.
pub(super) fn at_velocities(
    runner: &Runner<'_>,
    speeds: &[f64],
    rows: &Rows,
    samples: u64,
) -> Result<Vec<(f64, Vec<Draw>)>, Stopped> {
    let study = runner.study;
    let inputs = |i: u64| values(&study.axes, study.copula.as_ref(), &rows.first(i));
    speeds
        .iter()
        .map(|&speed| Ok((speed, runner.run(samples.min(RUNS), &inputs, Some(speed))?)))
        .collect()
}

/// What the runs at a speed come to.
pub(super) fn band(speed: f64, runs: &[Draw], quantities: &[&'static ResultNumber]) -> Band {
    let spread = |quantity: &&'static ResultNumber| QuantitySpread {
        quantity: quantity.name,
        statistics: Statistics::of(runs.iter().filter_map(|run| run.value(quantity))),
    };
    Band {
        impact_velocity_m_s: speed,
        runs: runs.len(),
        failed: runs.iter().filter(|run| run.is_failed()).count(),
        perforation: Perforation::of(runs.iter().map(|run| run.outcome)),
        quantities: quantities.iter().map(spread).collect(),
    }
}
