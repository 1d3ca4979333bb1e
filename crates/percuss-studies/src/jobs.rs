//! Progress of jobs that run side by side.

use std::{
    ops::ControlFlow,
    sync::{Mutex, PoisonError},
};

/// What is told of the progress: a part of 1, from any thread but never from two at once. [`ControlFlow::Break`] stops the jobs.
pub(crate) type Progress<'a> = dyn FnMut(f64) -> ControlFlow<()> + Send + 'a;

/// Jobs with weights, and how far each is.
pub(crate) struct Jobs<'a> {
    weights: Vec<f64>,
    state: Mutex<State<'a>>,
}

struct State<'a> {
    fractions: Vec<f64>,
    progress: &'a mut Progress<'a>,
    flow: ControlFlow<()>,
}

impl<'a> Jobs<'a> {
    pub(crate) fn new(weights: Vec<f64>, progress: &'a mut Progress<'a>) -> Self {
        let state = State {
            fractions: vec![0.0; weights.len()],
            progress,
            flow: ControlFlow::Continue(()),
        };
        Self {
            weights,
            state: Mutex::new(state),
        }
    }

    /// Tells how far a job is, and whether it goes on. Who has stopped the jobs is not asked again for the others.
    pub(crate) fn report(&self, job: usize, fraction: f64) -> ControlFlow<()> {
        // A caller whose callback has panicked gets its panic anyway.
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let state = &mut *state;
        state.fractions[job] = fraction.clamp(0.0, 1.0);
        let done = state
            .fractions
            .iter()
            .zip(&self.weights)
            .map(|(f, w)| f * w);
        let whole: f64 = self.weights.iter().sum();
        if state.flow.is_continue() {
            state.flow = (state.progress)(done.sum::<f64>() / whole);
        }
        state.flow
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jobs_count_by_their_weight_until_they_are_stopped() {
        let mut heard = Vec::new();
        let mut progress = |part: f64| {
            heard.push(part);
            match part >= 0.5 {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        let jobs = Jobs::new(vec![3.0, 1.0], &mut progress);
        assert!(jobs.report(1, 1.0).is_continue());
        assert!(jobs.report(0, 0.5).is_break());
        assert!(jobs.report(1, 2.0).is_break());
        drop(jobs);
        assert_eq!(heard, [0.25, 0.625]);
    }
}
