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
}

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
    /// end; [`ControlFlow::Break`] ends the run with [`Error::Cancelled`].
    pub frames: Option<OnFrame<'a>>,
    /// Gets checkpoints of a model that [has fields](crate::solver::Model::has_fields).
    pub checkpoints: Option<&'a mut dyn Checkpoints>,
    /// A checkpoint of the same case to continue from; models without fields ignore it.
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

impl std::fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Control")
            .field("record", &self.record)
            .finish_non_exhaustive()
    }
}
