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

/// Most runs at one velocity.
pub(super) const RUNS: u64 = 256;

/// The runs at each velocity. Velocity by velocity the other parameters take the same values, so that curves are smooth.
pub(super) fn at_velocities(
    runner: &Runner<'_>,
    velocities: &[f64],
    rows: &Rows,
    samples: u64,
) -> Result<Vec<(f64, Vec<Draw>)>, Stopped> {
    let study = runner.study;
    let inputs = |i: u64| values(&study.axes, study.copula.as_ref(), &rows.first(i));
    velocities
        .iter()
        .map(|&velocity| {
            Ok((
                velocity,
                runner.run(samples.min(RUNS), &inputs, Some(velocity), false)?,
            ))
        })
        .collect()
}

/// What the runs at a velocity come to.
pub(super) fn band(velocity: f64, runs: &[Draw], quantities: &[&'static ResultNumber]) -> Band {
    let spread = |quantity: &&'static ResultNumber| QuantitySpread {
        quantity: quantity.name,
        statistics: Statistics::of(runs.iter().filter_map(|run| run.value(quantity))),
    };
    Band {
        impact_velocity_m_s: velocity,
        runs: runs.len(),
        failed: runs.iter().filter(|run| run.is_failed()).count(),
        perforation: Perforation::of(runs.iter().map(|run| run.outcome)),
        quantities: quantities.iter().map(spread).collect(),
    }
}
