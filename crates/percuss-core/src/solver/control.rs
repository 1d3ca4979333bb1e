//! Control of a run by its caller: progress, cancellation, histories, fields, checkpoints, resumption.

use std::ops::ControlFlow;

use super::frames::Frame;
use crate::Error;

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Time step.
    pub step: u64,
    /// Time [s].
    pub time: f64,
    /// Estimated part done, 0 to 1: the end of a run is not known beforehand.
    pub fraction: f64,
    /// Depth reached [m].
    pub depth: f64,
}

/// Where a run leaves its state now and then.
pub trait Checkpoints {
    /// Whether a checkpoint is wanted now; asked every few steps.
    fn is_due(&mut self) -> bool;

    /// Takes a checkpoint; [`ControlFlow::Break`] ends the run with [`Error::Cancelled`].
    fn keep(&mut self, bytes: &[u8]) -> ControlFlow<()>;

    /// Whether the run is to stop while it is set up, when there is nothing to keep yet.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Elements that are set up between two questions whether to go on: a few milliseconds.
const SET_UP_INTERVAL: usize = 1 << 13;

/// What gets the fields of a run.
pub type OnFrame<'a> = &'a mut dyn FnMut(&Frame<'_>) -> ControlFlow<()>;

/// What a caller wants of a run: histories, progress, a way to stop it.
#[derive(Default)]
pub struct Control<'a> {
    /// Whether to keep time histories.
    pub record: bool,
    /// Called now and then; [`ControlFlow::Break`] ends the run with [`Error::Cancelled`].
    pub progress: Option<&'a mut dyn FnMut(Progress) -> ControlFlow<()>>,
    /// Gets the fields of a model that [has some](crate::solver::Model::has_fields), at even intervals of time from the start to the
    /// end. A run that is repeated with smaller steps starts over: a frame of step 0 replaces all before it. [`ControlFlow::Break`] ends
    /// the run with [`Error::Cancelled`].
    pub frames: Option<OnFrame<'a>>,
    /// Gets checkpoints of a model that [has fields](crate::solver::Model::has_fields). A law of the caller's own needs a fingerprint for
    /// them.
    pub checkpoints: Option<&'a mut dyn Checkpoints>,
    /// A checkpoint of the same case to continue from; models without fields ignore it. With `record`, it must hold a history.
    pub resume: Option<&'a [u8]>,
}

impl Control<'_> {
    /// A run that keeps its time histories.
    pub fn recording() -> Self {
        Self {
            record: true,
            ..Self::default()
        }
    }

    /// Asks the caller, while a run is set up, whether to go on.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when the caller stops the run.
    pub fn ask(&mut self) -> Result<(), Error> {
        let is_stopped = self.checkpoints.as_ref().is_some_and(|c| c.is_stopped());
        go_on(
            match is_stopped {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            },
            0,
            0.0,
        )?;
        self.report(Progress {
            step: 0,
            time: 0.0,
            fraction: 0.0,
            depth: 0.0,
        })
    }

    /// Does something with every item of a body that is set up, as long as the caller lets the run go on; `size` is how many elements an
    /// item has.
    ///
    /// # Errors
    /// As [`Control::ask`].
    pub fn set_up<T>(
        &mut self,
        items: impl IntoIterator<Item = T>,
        size: usize,
        mut each: impl FnMut(T),
    ) -> Result<(), Error> {
        let interval = (SET_UP_INTERVAL / size.max(1)).max(1);
        for (number, item) in items.into_iter().enumerate() {
            if number.is_multiple_of(interval) {
                self.ask()?;
            }
            each(item);
        }
        Ok(())
    }

    /// Reports progress to the caller.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when the caller stops the run.
    pub fn report(&mut self, progress: Progress) -> Result<(), Error> {
        match &mut self.progress {
            Some(callback) => go_on(callback(progress), progress.step, progress.time),
            None => Ok(()),
        }
    }
}

/// The error that ends a run which its caller stops.
pub fn go_on(flow: ControlFlow<()>, step: u64, time: f64) -> Result<(), Error> {
    match flow {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Cancelled {
            step,
            time_us: time * 1e6,
        }),
    }
}

/// The error that ends a study whose caller stops it between two runs.
pub fn go_on_to_next_run(flow: ControlFlow<()>) -> Result<(), Error> {
    go_on(flow, 0, 0.0)
}

impl std::fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Control")
            .field("record", &self.record)
            .finish_non_exhaustive()
    }
}
