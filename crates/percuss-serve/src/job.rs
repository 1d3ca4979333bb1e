//! Worker threads: a limited number of runs, each with a time limit and cancelled with its request.

use std::{
    ops::ControlFlow,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use tokio::{
    sync::{OwnedSemaphorePermit, Semaphore},
    task, time,
};

use crate::{RequestLimits, limits::QUEUE_TIME, problem::Problem};

/// Pool of workers.
#[derive(Debug, Clone)]
pub(crate) struct Workers {
    places: Arc<Semaphore>,
    bounds: RequestLimits,
}

/// Stop condition of a run: cancellation or deadline.
#[derive(Debug, Clone)]
pub(crate) struct Stop {
    cancelled: Arc<AtomicBool>,
    deadline: Instant,
    seconds: u64,
}

impl Stop {
    pub(crate) fn after(limit: Duration) -> Self {
        Self {
            cancelled: Arc::default(),
            deadline: Instant::now() + limit,
            seconds: limit.as_secs(),
        }
    }

    /// Whether the run continues.
    pub(crate) fn flow(&self) -> ControlFlow<()> {
        if self.cancelled.load(Ordering::Relaxed) || Instant::now() >= self.deadline {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    pub(crate) fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// The problem of a run that failed with an error.
    pub(crate) fn problem(&self, error: percuss::Error) -> Problem {
        match error {
            percuss::Error::Cancelled { .. } => self.ended(),
            error => error.into(),
        }
    }

    /// Problem of a stopped run.
    pub(crate) fn ended(&self) -> Problem {
        match self.cancelled.load(Ordering::Relaxed) {
            true => Problem::cancelled(),
            false => Problem::too_slow(self.seconds),
        }
    }
}

/// Cancels a run when its request is dropped.
struct CancelOnDrop(Stop);

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.cancel();
    }
}

impl Workers {
    pub(crate) fn new(bounds: RequestLimits) -> Self {
        Self {
            places: Arc::new(Semaphore::new(bounds.runs)),
            bounds,
        }
    }

    pub(crate) fn bounds(&self) -> &RequestLimits {
        &self.bounds
    }

    /// Waits for a free worker.
    pub(crate) async fn place(&self) -> Result<OwnedSemaphorePermit, Problem> {
        let places = Arc::clone(&self.places).acquire_owned();
        match time::timeout(QUEUE_TIME, places).await {
            Ok(Ok(place)) => Ok(place),
            _ => Err(Problem::busy(self.bounds.runs)),
        }
    }

    /// Computes on a worker thread; the work is cancelled when the caller is dropped.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Stop) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let place = self.place().await?;
        let stop = Stop::after(self.bounds.time());
        let _guard = CancelOnDrop(stop.clone());
        let task = task::spawn_blocking(move || {
            let _place = place;
            work(&stop)
        });
        task.await.unwrap_or_else(|_| Err(Problem::fault()))
    }
}
