//! The whole state of a run, to go on from with the same bits.

use serde::{Deserialize, Serialize};

use super::{
    Particle,
    body::Sums,
    field::{Field, Strip},
    run::Run,
    solver::{Books, Pending},
    watch::Watch,
};
use crate::{Error, checkpoint, frames::FrameClock, history::Recorder};

/// State of a body: the strips say how far its particles have spread, and the field moves them in the next step.
#[derive(Serialize, Deserialize)]
struct BodyState {
    particles: Vec<Particle>,
    strips: Vec<Strip>,
    field: Field,
    rows_in_order: usize,
    /// Of the back face [m].
    displacement: Vec<f64>,
}

/// State between two steps.
#[derive(Serialize, Deserialize)]
struct State {
    step: u64,
    time: f64,
    time_step: f64,
    sums: Vec<Sums>,
    books: Books,
    pending: Pending,
    bodies: Vec<BodyState>,
    watch: Watch,
    clock: FrameClock,
    recorder: Option<Recorder>,
}

/// What of a run's state its loop owns.
pub(super) struct Keeping {
    pub(super) clock: FrameClock,
    pub(super) recorder: Option<Recorder>,
}

impl Run<'_> {
    /// The state as a checkpoint. What is taken out for writing is back in place afterwards.
    pub(super) fn checkpoint(&mut self, keeping: &mut Keeping) -> Result<Vec<u8>, Error> {
        let solver = &mut self.solver;
        let at = (solver.step, solver.time);
        let bodies = solver.bodies.iter_mut().zip(&mut solver.supports);
        let mut state = State {
            step: solver.step,
            time: solver.time,
            time_step: solver.time_step,
            sums: std::mem::take(&mut solver.sums),
            books: solver.books,
            pending: solver.pending,
            bodies: bodies
                .map(|(body, supports)| BodyState {
                    particles: std::mem::take(&mut body.particles),
                    strips: std::mem::take(&mut body.strips),
                    field: std::mem::take(&mut body.field),
                    rows_in_order: body.rows_in_order,
                    displacement: std::mem::take(&mut supports.displacement),
                })
                .collect(),
            watch: self.watch.clone(),
            clock: keeping.clock,
            recorder: keeping.recorder.take(),
        };
        let bytes = checkpoint::write("axi", self.scenario, at, &state);
        keeping.recorder = state.recorder.take();
        self.put(state);
        bytes
    }

    /// Goes back to the state of a checkpoint of this case.
    pub(super) fn restore(&mut self, bytes: &[u8]) -> Result<Keeping, Error> {
        let mut state: State = checkpoint::read(bytes, "axi", self.scenario)?;
        let keeping = Keeping {
            clock: state.clock,
            recorder: state.recorder.take(),
        };
        self.put(state);
        Ok(keeping)
    }

    fn put(&mut self, state: State) {
        let solver = &mut self.solver;
        solver.step = state.step;
        solver.time = state.time;
        solver.time_step = state.time_step;
        solver.sums = state.sums;
        solver.books = state.books;
        solver.pending = state.pending;
        self.watch = state.watch;
        let bodies = solver.bodies.iter_mut().zip(&mut solver.supports);
        for ((body, supports), from) in bodies.zip(state.bodies) {
            body.particles = from.particles;
            body.strips = from.strips;
            body.field = from.field;
            body.rows_in_order = from.rows_in_order;
            supports.displacement = from.displacement;
        }
    }
}
