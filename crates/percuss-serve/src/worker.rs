//! Runs on threads of their own: a few at a time, for a limited time, and no longer than somebody waits for them.

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

use crate::{Bounds, bounds::PATIENCE, problem::Problem};

/// Places to compute in.
#[derive(Debug, Clone)]
pub(crate) struct Workers {
    places: Arc<Semaphore>,
    bounds: Bounds,
}

/// Says to a run when it is to end.
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

    /// What a run is told when it asks whether to go on.
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

    /// The problem of a run that was told to end.
    pub(crate) fn ended(&self) -> Problem {
        match self.cancelled.load(Ordering::Relaxed) {
            true => Problem::cancelled(),
            false => Problem::too_slow(self.seconds),
        }
    }
}

/// Ends a run when whoever waits for it has gone.
struct CancelOnDrop(Stop);

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.cancel();
    }
}

impl Workers {
    pub(crate) fn new(bounds: Bounds) -> Self {
        Self {
            places: Arc::new(Semaphore::new(bounds.runs)),
            bounds,
        }
    }

    pub(crate) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// A place to compute in, as soon as there is one.
    pub(crate) async fn place(&self) -> Result<OwnedSemaphorePermit, Problem> {
        let places = Arc::clone(&self.places).acquire_owned();
        match time::timeout(PATIENCE, places).await {
            Ok(Ok(place)) => Ok(place),
            _ => Err(Problem::busy(self.bounds.runs)),
        }
    }

    /// Computes on a thread of its own. The work is told to stop when the caller is dropped.
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
