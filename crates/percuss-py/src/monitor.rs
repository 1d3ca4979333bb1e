//! Progress and cancellation of long computations, while other Python threads run.

use std::{
    ops::ControlFlow,
    panic,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
        mpsc::{self, RecvTimeoutError},
    },
    thread,
    time::{Duration, Instant},
};

use percuss_cli::{Failure, start_threads};
use pyo3::prelude::*;

use crate::{errors::raise, fork::with_threads};

/// Interval of progress reports and signal checks.
const INTERVAL: Duration = Duration::from_millis(50);

/// Progress reports to Python, with a check of signals.
pub struct PythonMonitor<'py> {
    progress: Option<&'py Py<PyAny>>,
    last: Instant,
    /// Exception that stopped the computation.
    error: Option<PyErr>,
}

impl<'py> PythonMonitor<'py> {
    pub fn new(progress: Option<&'py Py<PyAny>>) -> Self {
        Self {
            progress,
            last: Instant::now(),
            error: None,
        }
    }

    /// Reports the progress to Python at intervals and returns whether to continue.
    pub fn report(&mut self, fraction: f64, words: impl FnOnce() -> String) -> ControlFlow<()> {
        if self.last.elapsed() < INTERVAL {
            return ControlFlow::Continue(());
        }
        self.last = Instant::now();
        let asked = Python::attach(|py| {
            py.check_signals()?;
            match self.progress {
                Some(progress) => progress.call1(py, (fraction, words())).map(drop),
                None => Ok(()),
            }
        });
        match asked {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.error = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    /// The result, or the exception of the progress callback.
    pub fn finish<T>(self, py: Python<'_>, result: Result<T, Failure>) -> PyResult<T> {
        match (self.error, result) {
            (Some(error), _) => Err(error),
            (None, Ok(value)) => Ok(value),
            (None, Err(failure)) => Err(raise(py, failure)),
        }
    }
}

/// Progress shared with another thread.
#[derive(Default)]
pub struct SharedProgress {
    stop: AtomicBool,
    latest: Mutex<(f64, String)>,
}

impl SharedProgress {
    /// Stores the progress and returns whether to continue.
    pub fn on_progress(&self, fraction: f64, words: &str) -> ControlFlow<()> {
        *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = (fraction, words.to_owned());
        match self.stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    /// Flag that ends the work.
    pub fn stop(&self) -> &AtomicBool {
        &self.stop
    }
}

/// Runs multithreaded work on another thread; this thread handles signals and progress.
pub fn run_monitored<T: Send>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&SharedProgress) -> Result<T, Failure> + Send,
) -> PyResult<T> {
    let progress_state = SharedProgress::default();
    let mut monitor = PythonMonitor::new(progress);
    start_threads().map_err(|failure| raise(py, failure))?;
    let result = py.detach(|| {
        thread::scope(|scope| {
            let (done, ended) = mpsc::channel::<()>();
            let worker = scope.spawn(|| {
                // Dropped when the work ends, in whatever way.
                let _done = done;
                with_threads(|| work(&progress_state))
            });
            while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(INTERVAL) {
                let (fraction, words) = {
                    let latest = progress_state.latest.lock();
                    latest.unwrap_or_else(PoisonError::into_inner).clone()
                };
                if monitor.report(fraction, || words).is_break() {
                    progress_state.stop.store(true, Ordering::Relaxed);
                    break;
                }
            }
            worker.join()
        })
    });
    match result {
        Ok(result) => monitor.finish(py, result),
        Err(payload) => panic::resume_unwind(payload),
    }
}
