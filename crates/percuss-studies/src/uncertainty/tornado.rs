//! One-at-a-time sensitivities (tornado).

use super::{
    result::{Draw, TornadoBar},
    runner::Runner,
};
use crate::{summary::ResultNumber, sweep::Stopped};

/// Chances at which a parameter is low and high.
pub(super) const ENDS: [f64; 2] = [0.05, 0.95];

/// Runs with each parameter low and high and all others at their medians, two a parameter.
pub(super) fn runs(runner: &Runner<'_>) -> Result<Vec<Draw>, Stopped> {
    let axes = &runner.study.axes;
    let medians = runner.study.medians();
    let inputs = |i: u64| {
        let (parameter, end) = (i as usize / 2, i as usize % 2);
        let mut inputs = medians.clone();
        inputs[parameter] = axes[parameter].at(ENDS[end]);
        inputs
    };
    runner.run(2 * axes.len() as u64, &inputs, None, false)
}

/// The bars of a quantity, the longest first.
pub(super) fn bars(runner: &Runner<'_>, runs: &[Draw], quantity: &ResultNumber) -> Vec<TornadoBar> {
    let bar = |(i, axis): (usize, &crate::sweep::Axis)| {
        let [low, high] = [&runs[2 * i], &runs[2 * i + 1]];
        TornadoBar {
            key: axis.key.clone(),
            at_low: low.value(quantity),
            at_high: high.value(quantity),
        }
    };
    let mut bars: Vec<TornadoBar> = runner.study.axes.iter().enumerate().map(bar).collect();
    bars.sort_by(|a, b| b.length().total_cmp(&a.length()));
    bars
}
