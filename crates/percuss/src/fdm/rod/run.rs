//! A run of the rod from impact to its end.

use super::{
    law::RodLaw,
    mesh,
    results::{Ending, sum_up},
};
use crate::{
    Error, Scenario,
    courant_retry::{AttemptError, CourantRetry},
    fdm::grid::{AUDIT_INTERVAL, End, Grid, Watch},
    history::Recorder,
    options::FdmOptions,
    outcome::{RunResult, Termination},
    scenario::{TargetBody, modelled_thickness},
    solver::{Control, Progress},
};

/// Courant number when a case gives none.
const DEFAULT_COURANT: f64 = 0.7;
/// A run at the default Courant number is repeated with half of it until its energy balance closes, down to this one.
const SMALLEST_COURANT: f64 = 0.04;
const DEFAULT_MAX_STEPS: u64 = 20_000_000;
/// Part of the impact speed below which a projectile counts as stopped.
const REST_FRACTION: f64 = 0.01;
/// Part of the initial energy that may still dissipate in a window of a run whose bodies touch.
const QUIET_FRACTION: f64 = 1e-6;
/// The same when they have parted: what rings inside them then changes neither depth nor speed.
const PARTED_FRACTION: f64 = 1e-4;

/// A shot in the geometry `rod`.
#[derive(Debug)]
pub struct Rod<'a> {
    scenario: &'a Scenario,
    options: FdmOptions,
    grid: Grid<RodLaw>,
    watch: Watch,
    courant: f64,
    window: Window,
}

/// What a window of one round trip of a wave in the projectile began with.
#[derive(Debug, Default)]
struct Window {
    start: f64,
    dissipation: f64,
    depth: f64,
    touched: bool,
}

impl<'a> Rod<'a> {
    /// The grid at the moment of impact.
    pub fn new(scenario: &'a Scenario) -> Self {
        let options = scenario
            .options
            .fdm
            .with_defaults_of(&scenario.options.chain);
        let courant = options.courant.unwrap_or(DEFAULT_COURANT);
        Self::with_courant(scenario, options, courant)
    }

    fn with_courant(scenario: &'a Scenario, options: FdmOptions, courant: f64) -> Self {
        Self {
            scenario,
            grid: mesh::build(scenario, &options),
            options,
            watch: Watch::default(),
            courant,
            window: Window::default(),
        }
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// [`Error::Numerical`] when a cell is crushed to nothing or the energy balance does not close; [`Error::Cancelled`].
    pub fn run(mut self, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let given = self.options.courant;
        let mut courant = CourantRetry::new(given, DEFAULT_COURANT, SMALLEST_COURANT);
        loop {
            match self.attempt(control) {
                Ok(mut result) => {
                    result.warnings.extend(courant.warning());
                    return Ok(result);
                }
                Err(AttemptError::Unbalanced(error)) => courant.halve(error)?,
                Err(AttemptError::Other(error)) => return Err(error),
            }
            self = Self::with_courant(self.scenario, self.options, courant.number());
        }
    }

    fn attempt(&mut self, control: &mut Control<'_>) -> Result<RunResult, AttemptError> {
        let mut recorder = control.record.then(Recorder::new);
        let end_time = self.end_time();
        let max_steps = self.options.max_steps.unwrap_or(DEFAULT_MAX_STEPS);
        self.record(&mut recorder);
        let termination = loop {
            if self.scenario.impact_speed == 0.0 {
                break Termination::NothingMoves;
            }
            self.grid.advance(self.courant, f64::INFINITY)?;
            self.watch.follow(&self.grid, self.scenario.impact_speed);
            self.window.touched |= self.grid.touches();
            self.record(&mut recorder);
            if self.has_passed() {
                break Termination::PassedBackFace;
            }
            if self.grid.time >= end_time {
                break Termination::EndTime;
            }
            if self.grid.step >= max_steps {
                break Termination::StepLimit;
            }
            if self.grid.step.is_multiple_of(AUDIT_INTERVAL) {
                self.audit()?;
                self.watch.check_time_step(&self.grid)?;
                control.report(self.progress(end_time))?;
            }
            if self.is_quiet(end_time) {
                break if self.grid.closed.first() == Some(&false) {
                    Termination::Parted
                } else {
                    Termination::Quiescent
                };
            }
        };
        self.audit()?;
        Ok(sum_up(
            &Ending {
                scenario: self.scenario,
                options: &self.options,
                grid: &self.grid,
                watch: &self.watch,
                termination,
                rest_fraction: REST_FRACTION,
            },
            recorder,
        ))
    }

    fn audit(&mut self) -> Result<(), AttemptError> {
        let audit = self.watch.audit(&self.grid, self.courant);
        audit.map_err(AttemptError::Unbalanced)
    }

    fn has_passed(&self) -> bool {
        let thickness = self.scenario.target_thickness();
        thickness.is_some_and(|thickness| self.grid.depth() >= thickness)
    }

    /// Time at which a run without an `end_time` gives up: many times what waves and the shot itself take.
    fn end_time(&self) -> f64 {
        if let Some(time) = self.options.end_time {
            return time.si();
        }
        let rod = &self.scenario.projectile;
        let speed = self.scenario.impact_speed.max(1.0);
        let passage =
            |length: f64, wave_speed: f64| 2.0 * length / wave_speed + 2.0 * length / speed;
        let mut time = passage(rod.length, rod.material.bar_wave_speed());
        match &self.scenario.target {
            TargetBody::Layers { layers, .. } => {
                for plate in layers {
                    let thickness = modelled_thickness(plate, self.scenario);
                    time += passage(thickness, plate.material.bar_wave_speed());
                }
            }
            TargetBody::RigidWall => {}
            TargetBody::ConstantPressure(pressure) => {
                time += rod.material.density.si() * rod.length * speed / pressure;
            }
        }
        20.0 * time
    }

    /// Whether the shot is over: looked at once in a round trip of a wave in the projectile.
    fn is_quiet(&mut self, end_time: f64) -> bool {
        let rod = &self.scenario.projectile;
        if self.grid.time < self.window.start + 2.0 * rod.length / rod.material.bar_wave_speed() {
            return false;
        }
        let [projectile, target] = self.grid.stored();
        let books = &self.grid.books;
        let dissipation = projectile.plastic
            + target.plastic
            + projectile.viscous
            + target.viscous
            + books.friction_work;
        let before = std::mem::replace(
            &mut self.window,
            Window {
                start: self.grid.time,
                dissipation,
                depth: self.watch.largest_depth,
                touched: false,
            },
        );
        let flow = (dissipation - before.dissipation) / books.initial_energy;
        if !before.touched {
            let remaining = end_time - self.grid.time;
            return flow <= PARTED_FRACTION && !self.will_meet(remaining);
        }
        // A projectile that is still being pushed back has not got its rebound speed yet.
        let (mass, momentum) = self.grid.motion(0);
        let still = (momentum / mass).abs() <= REST_FRACTION * self.scenario.impact_speed;
        let deepening = self.watch.largest_depth > before.depth * (1.0 + 1e-9);
        self.watch.at_rest.is_some() && !deepening && still && flow <= QUIET_FRACTION
    }

    /// Whether the projectile in free flight will meet what is ahead of it within a time.
    fn will_meet(&self, horizon: f64) -> bool {
        if self.grid.closed.first() != Some(&false) {
            return false;
        }
        let tip = self.grid.span(0).1;
        let gap = self.grid.nodes[tip + 1].position - self.grid.nodes[tip].position;
        let mean = |role| {
            let (mass, momentum) = self.grid.motion(role);
            if mass > 0.0 { momentum / mass } else { 0.0 }
        };
        // A target that is held vibrates about its place; one that is free flies at its mean speed.
        let away = if self.grid.ends[1] == End::Free {
            mean(1)
        } else {
            0.0
        };
        let approach = mean(0) - away;
        approach > 0.0 && gap < approach * horizon
    }

    fn progress(&self, end_time: f64) -> Progress {
        let (mass, momentum) = self.grid.motion(0);
        let slowed = 1.0 - momentum / (mass * self.scenario.impact_speed);
        Progress {
            step: self.grid.step,
            time: self.grid.time,
            fraction: (self.grid.time / end_time)
                .max(0.95 * slowed)
                .clamp(0.0, 1.0),
            depth: self.watch.largest_depth,
        }
    }

    fn record(&self, recorder: &mut Option<Recorder>) {
        let Some(recorder) = recorder else { return };
        if recorder.wants_sample(self.grid.step) {
            recorder.sample(self.grid.sample());
        }
        if recorder.wants_profile(self.grid.step) {
            recorder.profile(self.grid.profile());
        }
    }
}
