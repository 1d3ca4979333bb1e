//! What a study says over a range of impact speeds.

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

/// Most shots at one speed.
pub(super) const SHOTS: u64 = 256;

/// The shots at each speed. Speed by speed the other parameters take the same values, so that curves are smooth.
pub(super) fn shots(
    runner: &Runner<'_>,
    speeds: &[f64],
    rows: &Rows,
    samples: u64,
) -> Result<Vec<(f64, Vec<Draw>)>, Stopped> {
    let study = runner.study;
    let inputs = |i: u64| values(&study.axes, study.copula.as_ref(), &rows.first(i));
    speeds
        .iter()
        .map(|&speed| Ok((speed, runner.run(samples.min(SHOTS), &inputs, Some(speed))?)))
        .collect()
}

/// What the shots at a speed come to.
pub(super) fn band(speed: f64, shots: &[Draw], quantities: &[&'static ResultNumber]) -> Band {
    let spread = |quantity: &&'static ResultNumber| QuantitySpread {
        quantity: quantity.name,
        statistics: Statistics::of(shots.iter().filter_map(|shot| shot.value(quantity))),
    };
    Band {
        velocity_m_s: speed,
        shots: shots.len(),
        failed: shots.iter().filter(|shot| shot.is_failed()).count(),
        perforation: Perforation::of(shots.iter().map(|shot| shot.outcome)),
        quantities: quantities.iter().map(spread).collect(),
    }
}
