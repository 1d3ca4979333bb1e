//! The time loop of every numerical model: balances, retries, the end, histories, fields, checkpoints.

use super::{
    Control, Progress,
    archive::Archive,
    checkpoint,
    courant_retry::{AttemptError, CourantRetry},
    frames::{Fields, Frame, FrameClock},
    gauge::Gauge,
    go_on,
    interface::{Retry, Solver},
    limits::Limits,
    monitor::{Clock, RunMonitor},
};
use crate::{
    Error, Scenario,
    error::NumericalError,
    history::{Recorder, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    outcome::{Numerics, RunResult, Termination},
    scenario::TargetBody,
    units::Time,
};

/// Largest part of the energy that changes of the time step may take: less than 1 % of the depth.
const LARGEST_STEP_CHANGE: f64 = 5e-3;
/// Elements times steps between two reports of progress at most: less than half a second.
const REPORTED_WORK: u64 = 1_000_000;

/// A run of a solver from impact to its end.
#[derive(Debug)]
pub struct Drive<'a, S> {
    scenario: &'a Scenario,
    /// State of the solver.
    pub solver: S,
    /// Extremes and balance errors so far.
    pub monitor: RunMonitor,
    /// When it ends at the latest.
    pub limits: Limits,
    courant: CourantRetry,
    recorder: Option<Recorder>,
    gauges: Vec<Gauge>,
    frames: FrameClock,
    /// Steps between two reports of progress.
    report_interval: u64,
    /// Whether the state is that of a checkpoint.
    resumed: bool,
}

impl<'a, S: Solver<'a>> Drive<'a, S> {
    /// The run at the moment of impact, or at the checkpoint from which `control` resumes.
    ///
    /// # Errors
    /// As [`Solver::build`]; [`Error::Checkpoint`].
    pub fn new(scenario: &'a Scenario, control: &mut Control<'_>) -> Result<Self, Error> {
        if control.checkpoints.is_some() {
            // Now, not at the first checkpoint, which comes after a minute.
            checkpoint::fingerprint(scenario)?;
        }
        if let Some(bytes) = control.resume {
            return Self::resume(scenario, bytes, control);
        }
        let (given, default) = S::courant(scenario);
        let smallest = match S::AUDIT.retry {
            Retry::Never => f64::INFINITY,
            Retry::OfBalance { smallest } | Retry::OfAnyError { smallest } => smallest,
        };
        let courant = CourantRetry::new(given, default, smallest);
        Self::with_courant(scenario, courant, control)
    }

    fn with_courant(
        scenario: &'a Scenario,
        courant: CourantRetry,
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        let solver = S::build(scenario, courant.number(), control)?;
        let elements = match scenario.gauges.is_empty() {
            true => Vec::new(),
            false => match solver.fields() {
                Fields::Elements(elements) => elements,
                Fields::Particles { .. } => Vec::new(),
            },
        };
        let gauges = scenario.gauges.iter();
        let most = REPORTED_WORK / (solver.size() as u64).max(1);
        Ok(Self {
            scenario,
            limits: solver.limits(),
            gauges: gauges.map(|place| Gauge::new(place, &elements)).collect(),
            solver,
            monitor: RunMonitor::default(),
            courant,
            recorder: None,
            frames: FrameClock::new(scenario),
            report_interval: S::AUDIT.report_interval.min(most.max(1)),
            resumed: false,
        })
    }

    /// The run at a checkpoint of this case.
    fn resume(
        scenario: &'a Scenario,
        bytes: &[u8],
        control: &mut Control<'_>,
    ) -> Result<Self, Error> {
        let (_, content) = checkpoint::open(bytes, S::NAMES.0, scenario)?;
        let mut archive = Archive::reader(content);
        let (given, default) = S::courant(scenario);
        let mut courant = CourantRetry::new(given, default, f64::INFINITY);
        archive.item(&mut courant)?;
        let mut run = Self::with_courant(scenario, courant, control)?;
        run.archive(&mut archive)?;
        if control.record && run.recorder.is_none() {
            return Err(checkpoint::without_history());
        }
        run.resumed = true;
        Ok(run)
    }

    /// Runs to the end from the state as it is.
    ///
    /// # Errors
    /// [`Error::Numerical`] when the state cannot be continued or the balances do not close; [`Error::Cancelled`].
    pub fn run(self, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let mut run = self;
        loop {
            let failed = match run.attempt(control) {
                Ok(mut result) => {
                    result.warnings.extend(run.courant.warning());
                    return Ok(result);
                }
                Err(failed) => failed,
            };
            match failed.retried(S::AUDIT.retry) {
                Ok(error) => run.courant.halve(error)?,
                Err(error) => return Err(error),
            }
            // The old state goes before the new one takes as much memory.
            let (scenario, courant) = (run.scenario, run.courant.clone());
            drop(run);
            run = Self::with_courant(scenario, courant, control)?;
        }
    }

    fn attempt(&mut self, control: &mut Control<'_>) -> Result<RunResult, AttemptError> {
        if !self.resumed {
            let scenario = self.scenario;
            let recorder = || Recorder::new(&scenario.gauges, scenario.history_interval);
            self.recorder = control.record.then(recorder);
            self.record();
        }
        self.show(control)?;
        let termination = if self.scenario.impact_velocity == 0.0 {
            Termination::NothingMoves
        } else {
            loop {
                self.solver.advance()?;
                self.follow();
                self.record();
                self.show(control)?;
                if let Some(termination) = self.after_step(control)? {
                    break termination;
                }
            }
        };
        let result = self.finish(termination)?;
        self.frame(self.frames.last(self.solver.clock().time), true, control)?;
        Ok(result)
    }

    /// Includes a step in the extremes.
    #[inline(always)]
    pub fn follow(&mut self) {
        let probe = self.solver.probe(&self.monitor);
        let clock = self.solver.clock();
        let solver = &self.solver;
        self.monitor.follow(clock, probe, || solver.is_at_rest());
    }

    /// Audits a step that has been followed: why the run is over, if it is.
    pub fn after_step(
        &mut self,
        control: &mut Control<'_>,
    ) -> Result<Option<Termination>, AttemptError> {
        let Clock { step, time, .. } = self.solver.clock();
        if step.is_multiple_of(S::AUDIT.interval) {
            self.audit(self.solver.energy(), self.solver.momentum())?;
        }
        let reports = step.is_multiple_of(self.report_interval);
        if reports {
            control.report(self.progress())?;
        }
        if let Some(termination) = self.solver.event(&self.monitor)? {
            return Ok(Some(termination));
        }
        let rests = |below: f64| {
            let at_rest = self.monitor.at_rest;
            at_rest.is_some_and(|(_, depth)| depth < below)
        };
        if self.limits.at_rest_below.is_some_and(rests) {
            return Ok(Some(Termination::AtRest));
        }
        if time >= self.limits.end_time {
            return Ok(Some(Termination::EndTime));
        }
        if step >= self.limits.max_steps {
            return Ok(Some(Termination::StepLimit));
        }
        // After everything that the step changes, so that a run that continues from here misses none of it.
        if reports {
            self.leave_checkpoint(control)?;
        }
        Ok(None)
    }

    /// Checks the balances, and invariants of the solver itself, between two steps.
    pub fn audit(
        &mut self,
        energy: EnergyLedger,
        momentum: MomentumLedger,
    ) -> Result<(), AttemptError> {
        self.check_balances(energy, momentum)?;
        Ok(self.solver.check(&self.monitor)?)
    }

    fn check_balances(
        &mut self,
        energy: EnergyLedger,
        momentum: MomentumLedger,
    ) -> Result<(), AttemptError> {
        let step_change = energy.step_change();
        if step_change.abs() > LARGEST_STEP_CHANGE {
            return Err(AttemptError::Unbalanced(self.lower_courant(format!(
                "changes of the time step took {step_change:.2e} of the initial energy, above {LARGEST_STEP_CHANGE:e}"
            ))));
        }
        let (energy, momentum) = (energy.residual(), momentum.residual());
        let errors = &mut self.monitor.balance_error;
        errors.energy = errors.energy.max(energy.abs());
        errors.momentum = errors.momentum.max(momentum.abs());
        let tolerance = S::AUDIT.tolerance;
        for (quantity, error, tolerance) in [
            ("energy", energy, tolerance.energy),
            ("momentum", momentum, tolerance.momentum),
        ] {
            if error.is_nan() || error.abs() > tolerance {
                return Err(AttemptError::Unbalanced(self.lower_courant(format!(
                    "the {quantity} balance does not close: its error is {error:.2e} of the initial {quantity}, above {tolerance:e}"
                ))));
            }
        }
        Ok(())
    }

    fn lower_courant(&self, what: String) -> NumericalError {
        self.solver.clock().failure(
            what,
            format!(
                "lower `{}.courant` (now {})",
                S::NAMES.0,
                self.courant.number()
            ),
        )
    }

    fn progress(&self) -> Progress {
        let Clock { step, time, .. } = self.solver.clock();
        let of_time = time / self.limits.end_time;
        Progress {
            step,
            time,
            fraction: of_time.max(0.95 * self.solver.progress()).clamp(0.0, 1.0),
            depth: self.monitor.largest_depth,
        }
    }

    /// Checks the balances a last time and makes the result.
    pub fn finish(&mut self, termination: Termination) -> Result<RunResult, AttemptError> {
        let (energy, momentum) = (self.solver.energy(), self.solver.momentum());
        self.check_balances(energy, momentum)?;
        let (solver, monitor) = (&self.solver, &self.monitor);
        let clock = solver.clock();
        let (outcome, criterion) = solver.outcome(termination, monitor);
        let (model, scheme) = S::NAMES;
        let mut result = RunResult::new(model, scheme, outcome, termination);
        result.criterion = criterion;
        result.time_to_rest = monitor.at_rest.map(|(time, _)| time);
        result.peak_force = Some(monitor.peak_force);
        result.contact_time = Some(monitor.contact_time);
        result.end_time = Some(clock.time);
        let extremes = solver.extremes();
        result.numerics = Some(Numerics {
            steps: clock.step,
            first_time_step: monitor.first_time_step,
            smallest_time_step: monitor.smallest_time_step,
            elements: extremes.elements,
            eroded_elements: extremes.eroded_elements,
            largest_plastic_strain: extremes.largest_plastic_strain,
            largest_temperature: extremes.largest_temperature,
            energy,
            momentum,
            energy_residual: monitor.balance_error.energy,
            momentum_residual: monitor.balance_error.momentum,
        });
        let recorder = self.recorder.take();
        let given = self.scenario.history_interval;
        if let Some(longer) = recorder.as_ref().and_then(|it| it.longer_interval(given)) {
            result.warnings.push(format!(
                "at `history.interval` the run has too many samples: its histories keep one every {}",
                Time::new(longer)
            ));
        }
        result.history = recorder.map(|recorder| {
            let gauges = solver.gauges(&self.gauges);
            let last = sample(solver, monitor, self.scenario);
            recorder.finish(last, gauges, solver.profile())
        });
        solver.complete(&mut result, monitor);
        if termination == Termination::AtRest {
            result.without_rebound();
        }
        Ok(result)
    }

    fn record(&mut self) {
        let Some(recorder) = &mut self.recorder else {
            return;
        };
        let Clock { step, time, .. } = self.solver.clock();
        if recorder.wants_sample(step, time) {
            let gauges = self.solver.gauges(&self.gauges);
            let now = sample(&self.solver, &self.monitor, self.scenario);
            recorder.sample(now, gauges);
        }
        if recorder.wants_profile(step) {
            recorder.profile(self.solver.profile());
        }
    }

    /// Gives the fields to the caller when they are due.
    fn show(&mut self, control: &mut Control<'_>) -> Result<(), Error> {
        if control.frames.is_none() {
            return Ok(());
        }
        match self.frames.tick(self.solver.clock().time) {
            Some(number) => self.frame(number, false, control),
            None => Ok(()),
        }
    }

    fn frame(&self, number: u64, last: bool, control: &mut Control<'_>) -> Result<(), Error> {
        let Some(callback) = &mut control.frames else {
            return Ok(());
        };
        let Clock { step, time, .. } = self.solver.clock();
        let frame = Frame {
            number,
            last,
            step,
            time,
            depth: self.monitor.depth,
            fields: self.solver.fields(),
        };
        go_on(callback(&frame), step, time)
    }

    fn leave_checkpoint(&mut self, control: &mut Control<'_>) -> Result<(), Error> {
        let Some(checkpoints) = &mut control.checkpoints else {
            return Ok(());
        };
        if !checkpoints.is_due() {
            return Ok(());
        }
        let Clock { step, time, .. } = self.solver.clock();
        let mut archive = Archive::writer();
        archive.item(&mut self.courant)?;
        self.archive(&mut archive)?;
        let content = archive.into_bytes();
        let bytes = checkpoint::seal(S::NAMES.0, self.scenario, (step, time), &content)?;
        go_on(checkpoints.keep(&bytes), step, time)
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.monitor)?;
        archive.item(&mut self.recorder)?;
        archive.item(&mut self.frames)?;
        self.solver.archive(archive)
    }
}

impl Clock {
    /// A numerical error at this time.
    pub fn failure(self, what: String, remedy: String) -> NumericalError {
        NumericalError {
            what,
            step: self.step,
            time_us: self.time * 1e6,
            element: None,
            remedy,
        }
    }
}

/// State now; a wall and a constant pressure have no rear face, and a wall no face that moves.
fn sample<'a, S: Solver<'a>>(solver: &S, monitor: &RunMonitor, scenario: &Scenario) -> Sample {
    let mut sample = solver.sample(monitor);
    if scenario.layers().is_empty() {
        sample.back_velocity = f64::NAN;
        sample.back_force = f64::NAN;
    }
    if scenario.target == TargetBody::RigidWall {
        sample.interface_velocity = f64::NAN;
    }
    sample
}
