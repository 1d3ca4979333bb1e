//! Parallel computation of many runs in blocks, with all results in memory.

use std::{
    ops::Range,
    sync::atomic::{AtomicBool, AtomicU64, Ordering},
};

use rayon::prelude::*;

use super::{Kernel, Stopped, Sweep, SweepRow};
use crate::cost;

/// What a caller wants of many runs: progress and a way to stop them.
pub struct Observer<'a> {
    /// Ends them when it becomes true.
    pub stop: &'a AtomicBool,
    /// Called now and then from any thread with the runs that are done and all of them.
    pub progress: &'a (dyn Fn(u64, u64) + Sync),
}

/// Results of `count` runs in blocks of `size`, in the order of the runs.
pub(crate) fn in_blocks<T: Send>(
    count: u64,
    size: u64,
    work: impl Fn(Range<u64>) -> Result<Vec<T>, Stopped> + Sync,
) -> Result<Vec<T>, Stopped> {
    let blocks: Result<Vec<Vec<T>>, Stopped> = (0..count.div_ceil(size))
        .into_par_iter()
        .map(|block| work(block * size..((block + 1) * size).min(count)))
        .collect();
    Ok(blocks?.into_iter().flatten().collect())
}

impl Sweep {
    /// All rows, in the order of the runs. They take memory: a folder of `percuss-report` takes sweeps of any size.
    ///
    /// # Errors
    /// [`Stopped`].
    pub fn rows(
        &self,
        kernel: &dyn Kernel,
        observer: &Observer<'_>,
    ) -> Result<Vec<SweepRow>, Stopped> {
        let (done, total) = (AtomicU64::new(0), self.runs());
        let of_block = |block: Range<u64>| {
            let runs = block.map(|run| self.run(run)).collect();
            let rows = kernel.rows(runs, observer.stop)?;
            let of_block = rows.len() as u64;
            let done = done.fetch_add(of_block, Ordering::Relaxed) + of_block;
            (observer.progress)(done, total);
            Ok(rows)
        };
        cost::within_memory(self.memory_of_thread(), || {
            in_blocks(total, self.block_size, of_block)
        })
    }
}
