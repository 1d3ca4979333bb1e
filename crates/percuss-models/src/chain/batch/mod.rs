//! Many independent runs at once: eight of them side by side, each in a lane of the processor's vector unit.
//!
//! [`Bundle`] advances the state of eight runs, lane by lane, by the functions of the single run and in its order: no lane knows
//! of another one, so that a run ends with the same bits in whatever company it was computed. Whatever is rare (the end of a run,
//! erosion) is left to the single run: the lane's state is put into its [`ColumnRun`], and what that makes of it is put back.

// Loops over the lanes run along many arrays at once.
#![allow(clippy::needless_range_loop)]

mod accepts;
mod balance;
mod bundle;
mod contact;
mod end;
mod erosion;
mod exchange;
mod flow;
mod interfaces;
mod kick;
mod scalars;
mod step;
#[cfg(test)]
mod tests;
mod update;

use std::{
    collections::BTreeMap,
    ops::ControlFlow,
    sync::atomic::{AtomicBool, Ordering},
};

use pulp::{Arch, NullaryFnOnce};

pub(crate) use accepts::accepts;
use bundle::{Bundle, Mesh};

use super::{
    column::{AUDIT_INTERVAL, ColumnRun},
    state::BodySums,
};
use crate::{
    Error, Scenario,
    lanes::{LANES, Lanes},
    options::constraint_factor,
    outcome::RunResult,
    scenario::TargetBody,
    solver::{Control, Progress},
};

/// Stages of [`AUDIT_INTERVAL`] steps that an empty lane waits for others to end: runs that start together have their waves in
/// the same places.
const REFILL_DELAY: u32 = 4;

/// The caller stopped the batch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stopped;

/// A run in a lane.
struct LaneRun<'a> {
    /// Its place among the runs.
    index: usize,
    run: ColumnRun<'a>,
}

/// Results of runs that [`accepts`] accepts, in their order: those of a single run.
///
/// # Errors
/// [`Stopped`].
pub fn run(
    scenarios: &[&Scenario],
    stop: &AtomicBool,
) -> Result<Vec<Result<RunResult, Error>>, Stopped> {
    let mut results: Vec<Option<Result<RunResult, Error>>> = Vec::new();
    results.resize_with(scenarios.len(), || None);
    let mut meshes: BTreeMap<Mesh, Vec<usize>> = BTreeMap::new();
    for (index, scenario) in scenarios.iter().enumerate() {
        meshes.entry(Mesh::of(scenario)).or_default().push(index);
    }
    for (mesh, mut runs) in meshes {
        // Runs that resemble each other have their waves in the same places: less is computed in vain. The slowest goes first.
        runs.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|index| scenarios[index]);
            let by_reach = reach(a).total_cmp(&reach(b));
            by_reach.then(a.impact_velocity.total_cmp(&b.impact_velocity))
        });
        let mut scheduler = BatchScheduler {
            bundle: Bundle::new(mesh),
            lanes: [const { None }; LANES],
            scenarios,
            results: &mut results,
            stop,
        };
        scheduler.run(runs)?;
    }
    let results = results.into_iter();
    // Every run is in one of the lists and leaves its lane with a result.
    Ok(results.flatten().collect())
}

/// Length of target whose border shear is in balance with the stress of its front, as a part of what a border shear and a constraint
/// factor of 1 give: how far from the front elements move.
fn reach(scenario: &Scenario) -> f64 {
    let options = &scenario.options.chain;
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        return 0.0;
    };
    let (struck, factor) = (&layers[0], options.constraint_factor());
    constraint_factor(factor, &struck.material, struck.start_temperature()) / options.border_shear()
}

struct BatchScheduler<'a, 'b> {
    bundle: Bundle,
    lanes: [Option<LaneRun<'a>>; LANES],
    scenarios: &'b [&'a Scenario],
    results: &'b mut [Option<Result<RunResult, Error>>],
    stop: &'b AtomicBool,
}

impl BatchScheduler<'_, '_> {
    fn run(&mut self, mut waiting: Vec<usize>) -> Result<(), Stopped> {
        let arch = Arch::new();
        let mut delay = 0;
        loop {
            let empty = self.lanes.iter().filter(|lane| lane.is_none()).count();
            if empty == LANES && waiting.is_empty() {
                return Ok(());
            }
            if empty == LANES || delay == 0 {
                self.fill_lanes(&mut waiting);
                delay = REFILL_DELAY;
            } else if empty > 0 {
                delay -= 1;
            }
            // Lanes change runs between these stages, so that the audits of all are due at the same time.
            let mut left = AUDIT_INTERVAL;
            while left > 0 {
                let bundle = &mut self.bundle;
                let needs_scalar = arch.dispatch(Advance {
                    bundle,
                    left: &mut left,
                });
                let sums = (left == 0).then(|| arch.dispatch(Sum(&self.bundle)));
                for (lane, needs_scalar) in needs_scalar.into_iter().enumerate() {
                    match &sums {
                        _ if needs_scalar => self.service_lane(lane)?,
                        Some(sums) => self.audit(lane, sums)?,
                        None => {}
                    }
                }
            }
            if self.stop.load(Ordering::Relaxed) {
                return Err(Stopped);
            }
        }
    }

    /// Fills the empty lanes.
    fn fill_lanes(&mut self, waiting: &mut Vec<usize>) {
        for (lane, seat) in self.lanes.iter_mut().enumerate() {
            if seat.is_none()
                && let Some(index) = waiting.pop()
            {
                match ColumnRun::new(self.scenarios[index], &mut Control::default()) {
                    Ok(run) => {
                        self.bundle.load_lane(lane, &run);
                        *seat = Some(LaneRun { index, run });
                    }
                    Err(error) => self.results[index] = Some(Err(error)),
                }
            }
        }
    }

    /// Lets the single run audit a lane.
    fn audit(&mut self, lane: usize, sums: &[BodySums<Lanes>; 2]) -> Result<(), Stopped> {
        let Some(occupant) = &mut self.lanes[lane] else {
            return Ok(());
        };
        match self.bundle.audit(lane, sums, &mut occupant.run) {
            Ok(()) => Ok(()),
            Err(_) => self.retire(lane, None),
        }
    }

    /// Lets the single run look at a lane after a step.
    fn service_lane(&mut self, lane: usize) -> Result<(), Stopped> {
        let Some(occupant) = &mut self.lanes[lane] else {
            return Ok(());
        };
        let run = &mut occupant.run;
        let mut watch = listen(self.stop);
        let mut control = Control {
            progress: Some(&mut watch),
            ..Control::default()
        };
        if !self.bundle.store_lane(lane, run) {
            return self.retire(lane, None);
        }
        let left = |run: &ColumnRun<'_>| -> usize {
            let segments = run.solver.state.segments.iter();
            segments.map(|segment| segment.elements().len()).sum()
        };
        let before = left(run);
        let erosion_strain = run.solver.control.erosion_strain;
        run.solver.state.erode(erosion_strain);
        let erodes = left(run) < before;
        run.follow();
        let result = match run.after_step(&mut control) {
            Ok(None) if !erodes || self.bundle.erode(lane, run) => {
                self.bundle.follow(lane, run);
                return Ok(());
            }
            Ok(None) => return self.leave(lane),
            Ok(Some(termination)) => run.finish(termination).ok().map(Ok),
            Err(_) => None,
        };
        self.retire(lane, result)
    }

    /// Empties a lane whose single run goes on from here.
    fn leave(&mut self, lane: usize) -> Result<(), Stopped> {
        let Some(LaneRun { index, run }) = self.lanes[lane].take() else {
            return Ok(());
        };
        self.bundle.clear_lane(lane);
        let mut watch = listen(self.stop);
        let mut control = Control {
            progress: Some(&mut watch),
            ..Control::default()
        };
        self.keep(index, run.run(&mut control))
    }

    /// Empties a lane. What fails there does so in the single run too, which knows what comes next.
    fn retire(
        &mut self,
        lane: usize,
        result: Option<Result<RunResult, Error>>,
    ) -> Result<(), Stopped> {
        let Some(LaneRun { index, .. }) = self.lanes[lane].take() else {
            return Ok(());
        };
        self.bundle.clear_lane(lane);
        let alone = || {
            let mut watch = listen(self.stop);
            let mut control = Control {
                progress: Some(&mut watch),
                ..Control::default()
            };
            ColumnRun::new(self.scenarios[index], &mut control)?.run(&mut control)
        };
        let result = result.unwrap_or_else(alone);
        self.keep(index, result)
    }

    fn keep(&mut self, index: usize, result: Result<RunResult, Error>) -> Result<(), Stopped> {
        if let Err(Error::Cancelled { .. }) = result {
            return Err(Stopped);
        }
        self.results[index] = Some(result);
        Ok(())
    }
}

/// Ends a run when the batch is to stop.
fn listen(stop: &AtomicBool) -> impl FnMut(Progress) -> ControlFlow<()> {
    |_| match stop.load(Ordering::Relaxed) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}

/// Steps until a lane needs_scalar or none are left, compiled once for every instruction set.
struct Advance<'b> {
    bundle: &'b mut Bundle,
    left: &'b mut u64,
}

impl NullaryFnOnce for Advance<'_> {
    type Output = [bool; LANES];

    #[inline(always)]
    fn call(self) -> [bool; LANES] {
        self.bundle.advance(self.left)
    }
}

/// Sums up energy and momentum.
struct Sum<'b>(&'b Bundle);

impl NullaryFnOnce for Sum<'_> {
    type Output = [BodySums<Lanes>; 2];

    #[inline(always)]
    fn call(self) -> [BodySums<Lanes>; 2] {
        self.0.sums()
    }
}
