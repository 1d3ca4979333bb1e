//! Parallel runs of a study, with progress and cancellation.

use std::{
    sync::atomic::{AtomicBool, Ordering},
    thread,
    time::Duration,
};

use percuss::{
    model::Model,
    sweep::{BatchKernel, Kernel, Observer, Stopped, SweepRow, SweepRun},
};

use super::Job;
use crate::RequestLimits;

/// Time between two looks whether somebody still waits.
const LOOK: Duration = Duration::from_millis(50);
/// Looks between two messages to a client that hears of no other progress.
const REPEAT: u32 = 10;

/// Works until nobody waits or time is up, which makes `ended` true: runs may be long, so that their progress is no measure of it.
pub(super) fn watched<T>(job: &Job<'_>, ended: &AtomicBool, work: impl FnOnce() -> T) -> T {
    let done = AtomicBool::new(false);
    thread::scope(|scope| {
        let looking = scope.spawn(|| {
            for look in 1_u32.. {
                if done.load(Ordering::Relaxed) {
                    break;
                }
                if look.is_multiple_of(REPEAT) {
                    job.events.repeat();
                }
                if job.wanted().is_break() {
                    ended.store(true, Ordering::Relaxed);
                }
                thread::park_timeout(LOOK);
            }
        });
        // The other thread ends whatever becomes of the work.
        let _end = Done(&done, looking.thread().clone());
        work()
    })
}

/// Computes runs while somebody waits, and tells how many are done.
pub(super) fn followed<T>(job: &Job<'_>, compute: impl FnOnce(&Observer<'_>) -> T) -> T {
    let ended = AtomicBool::new(false);
    let progress = |finished: u64, total: u64| {
        let words = format!("{finished} of {total} runs");
        job.events.progress(finished as f64 / total as f64, &words);
    };
    let watch = Observer {
        stop: &ended,
        progress: &progress,
    };
    watched(job, &ended, || compute(&watch))
}

/// Ends the thread that looks.
struct Done<'a>(&'a AtomicBool, thread::Thread);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
        self.1.unpark();
    }
}

/// A kernel that refuses runs which ask for more than a page may: a number that is varied can be that of elements.
pub(super) struct Bounded<'a> {
    kernel: BatchKernel,
    model: &'static dyn Model,
    bounds: &'a RequestLimits,
}

impl<'a> Bounded<'a> {
    pub(super) fn new(model: &'static dyn Model, bounds: &'a RequestLimits) -> Self {
        Self {
            kernel: BatchKernel::new(model),
            model,
            bounds,
        }
    }
}

impl Kernel for Bounded<'_> {
    fn rows(&self, mut runs: Vec<SweepRun>, stop: &AtomicBool) -> Result<Vec<SweepRow>, Stopped> {
        for run in &mut runs {
            let scenario = run.scenario.as_ref().ok();
            if let Some(Err(problem)) = scenario.map(|s| self.bounds.check(self.model, s)) {
                run.scenario = Err(problem.message().to_owned());
            }
        }
        self.kernel.rows(runs, stop)
    }
}
