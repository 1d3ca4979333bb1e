//! Worker threads: a limited number of runs, each with a time limit and cancelled with its request.

use std::{
    ops::ControlFlow,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

use tokio::{
    sync::{OwnedSemaphorePermit, Semaphore},
    task, time,
};

use crate::{RequestLimits, limits::QUEUE_TIME, problem::Problem};

/// Time between two attempts of a background computation to take its place back.
const ATTEMPT: Duration = Duration::from_millis(5);

/// Pool of workers.
#[derive(Debug, Clone)]
pub(crate) struct Workers {
    places: Arc<Semaphore>,
    /// Number of requests that wait for a place; background computations give theirs up for them.
    waiting: Arc<AtomicUsize>,
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

/// Counts a request that waits for a place.
struct Waiting(Arc<AtomicUsize>);

impl Waiting {
    fn new(waiting: &Arc<AtomicUsize>) -> Self {
        waiting.fetch_add(1, Ordering::Relaxed);
        Self(Arc::clone(waiting))
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Place of a background computation, which gives way to every other request.
#[derive(Debug)]
pub(crate) struct BackgroundPlace {
    workers: Workers,
    place: Option<OwnedSemaphorePermit>,
}

impl BackgroundPlace {
    /// Leaves the place to requests that wait for one, and returns when it is back or when `flow` breaks.
    pub(crate) fn give_way(&mut self, flow: impl Fn() -> ControlFlow<()>) -> ControlFlow<()> {
        loop {
            flow()?;
            let is_wanted = self.workers.waiting.load(Ordering::Relaxed) > 0;
            if is_wanted {
                self.place = None;
            } else if self.place.is_none() {
                let places = Arc::clone(&self.workers.places);
                self.place = places.try_acquire_owned().ok();
            }
            if self.place.is_some() {
                return ControlFlow::Continue(());
            }
            thread::sleep(ATTEMPT);
        }
    }
}

impl Workers {
    pub(crate) fn new(bounds: RequestLimits) -> Self {
        Self {
            places: Arc::new(Semaphore::new(bounds.runs)),
            waiting: Arc::default(),
            bounds,
        }
    }

    pub(crate) fn bounds(&self) -> &RequestLimits {
        &self.bounds
    }

    /// Waits for a free worker.
    pub(crate) async fn place(&self) -> Result<OwnedSemaphorePermit, Problem> {
        let _waiting = Waiting::new(&self.waiting);
        self.place_within(QUEUE_TIME).await
    }

    async fn place_within(&self, limit: Duration) -> Result<OwnedSemaphorePermit, Problem> {
        let places = Arc::clone(&self.places).acquire_owned();
        match time::timeout(limit, places).await {
            Ok(Ok(place)) => Ok(place),
            _ => Err(Problem::busy(self.bounds.runs)),
        }
    }

    /// Waits for a worker of a background computation, as long as a run may take.
    pub(crate) async fn background_place(&self) -> Result<BackgroundPlace, Problem> {
        let place = self.place_within(self.bounds.time()).await?;
        Ok(BackgroundPlace {
            workers: self.clone(),
            place: Some(place),
        })
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
