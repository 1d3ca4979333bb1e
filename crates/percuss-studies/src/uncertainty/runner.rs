//! Computing many runs of a study.

use std::sync::atomic::{AtomicU64, Ordering};

use super::{result::Draw, study::Study};
use crate::sweep::{Kernel, Observer, Stopped, SweepRun, in_blocks};

/// Blocks that there are at least, where there are as many runs: they are what threads share.
const BLOCKS: u64 = 64;
/// Most runs in a block.
const LARGEST_BLOCK: u64 = 256;
/// Key of the impact velocity.
pub(super) const VELOCITY: &str = "projectile.impact_velocity";

/// Computes runs in blocks, in parallel.
pub(super) struct Runner<'a> {
    pub(super) study: &'a Study,
    pub(super) kernel: &'a dyn Kernel,
    pub(super) observer: &'a Observer<'a>,
    pub(super) total: u64,
    pub(super) done: AtomicU64,
}

impl Runner<'_> {
    /// Runs whose values are given by their number, at the case's own velocity or at another one; to rest where no more is asked.
    pub(super) fn run(
        &self,
        count: u64,
        inputs: &(dyn Fn(u64) -> Vec<f64> + Sync),
        velocity: Option<f64>,
        to_rest: bool,
    ) -> Result<Vec<Draw>, Stopped> {
        let size = count.div_ceil(BLOCKS).clamp(1, LARGEST_BLOCK);
        let more: Vec<(&str, toml::Value)> = velocity
            .map(|velocity| (VELOCITY, toml::Value::String(format!("{velocity:?} m/s"))))
            .into_iter()
            .collect();
        in_blocks(count, size, |range| {
            let runs = range.map(|i| {
                let (template, axes) = (&self.study.template, &self.study.axes);
                let run = SweepRun::new(template, axes, i, inputs(i), &more);
                match to_rest {
                    true => run.ended_at_rest(),
                    false => run,
                }
            });
            let rows = self.kernel.rows(runs.collect(), self.observer.stop)?;
            let of_block = rows.len() as u64;
            let done = self.done.fetch_add(of_block, Ordering::Relaxed) + of_block;
            (self.observer.progress)(done, self.total);
            Ok(rows.into_iter().map(Draw::of).collect())
        })
    }
}
