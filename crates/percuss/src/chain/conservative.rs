//! Scheme `conservative`: the run from impact to its end.

use super::{
    between::Moment,
    mesh,
    results::Results,
    solver::StepControl,
    state::State,
    tate,
    watch::{Watch, event},
};
use crate::{
    Error, Scenario,
    courant_retry::{AttemptError, CourantRetry},
    error::NumericalError,
    history::Recorder,
    ledger::{EnergyLedger, MomentumLedger},
    options::{ErosionClosure, ErosionStrain},
    outcome::{RunResult, Termination},
    scenario::{TargetBody, modelled_thickness},
    solver::{Control, Progress},
};

/// Courant number when a case gives none.
const DEFAULT_COURANT: f64 = 0.8;
/// A run whose case gives no Courant number is repeated with half of it until its books balance, down to this one.
const SMALLEST_COURANT: f64 = 0.05;
/// Strain at which an element erodes when a case gives none.
const DEFAULT_EROSION_STRAIN: f64 = 2.0;
/// Time steps after which a run is ended when a case gives none.
const DEFAULT_MAX_STEPS: u64 = 20_000_000;
/// Steps between two looks at the books.
pub(super) const AUDIT_INTERVAL: u64 = 128;
/// Part of the first time step below which a run would never end.
const COLLAPSED_STEP: f64 = 1e-4;

/// A run of the conservative scheme.
#[derive(Debug)]
pub struct Conservative<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) state: State,
    pub(super) control: StepControl,
    pub(super) watch: Watch,
    pub(super) end_time: f64,
    pub(super) max_steps: u64,
}

impl<'a> Conservative<'a> {
    /// The chain at the moment of impact.
    pub fn new(scenario: &'a Scenario) -> Self {
        Self::with_courant(
            scenario,
            scenario.options.chain.courant.unwrap_or(DEFAULT_COURANT),
        )
    }

    fn with_courant(scenario: &'a Scenario, courant: f64) -> Self {
        let options = &scenario.options.chain;
        let mut state = mesh::build(scenario);
        let mut longest_step = f64::INFINITY;
        let erosion_strain = match (options.erosion_closure(), options.erosion_strain) {
            (ErosionClosure::Tate, _) => {
                longest_step = tate::longest_step(&state, scenario.impact_speed);
                tate::USED_UP_STRAIN
            }
            (ErosionClosure::Strain, Some(ErosionStrain::At(strain))) => strain,
            (ErosionClosure::Strain, Some(ErosionStrain::Never)) => f64::INFINITY,
            (ErosionClosure::Strain, None) => DEFAULT_EROSION_STRAIN,
        };
        let control = StepControl::new(options, courant, erosion_strain, longest_step);
        state.stable_step *= control.first_step_factor(&state, scenario.impact_speed);
        Self {
            scenario,
            state,
            control,
            watch: Watch::default(),
            end_time: end_time(scenario),
            max_steps: options.max_steps.unwrap_or(DEFAULT_MAX_STEPS),
        }
    }

    /// Runs to the end from the state as it is.
    ///
    /// # Errors
    /// [`Error::Numerical`] when an element inverts, the time step collapses, a semi-infinite target is used up or the
    /// books do not balance; [`Error::Cancelled`].
    pub fn run(mut self, control: &mut Control<'_>) -> Result<RunResult, Error> {
        self.run_on(control)
    }

    /// Runs to the end, and leaves the last state behind.
    pub(super) fn run_on(&mut self, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let given = self.scenario.options.chain.courant;
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
            *self = Self::with_courant(self.scenario, courant.number());
        }
    }

    fn attempt(&mut self, control: &mut Control<'_>) -> Result<RunResult, AttemptError> {
        let mut recorder = control.record.then(Recorder::new);
        self.record(&mut recorder);
        let termination = if self.scenario.impact_speed == 0.0 {
            Termination::NothingMoves
        } else {
            loop {
                self.state.advance(&self.control)?;
                self.watch.follow(&self.state, self.scenario);
                self.record(&mut recorder);
                if let Some(termination) = self.ended(control)? {
                    break termination;
                }
            }
        };
        self.finish(termination, recorder)
    }

    /// Whether the shot is over after a step that the watch has followed.
    pub(super) fn ended(
        &mut self,
        control: &mut Control<'_>,
    ) -> Result<Option<Termination>, AttemptError> {
        match event(&self.state, self.scenario) {
            Ok(None) => {}
            Ok(ended) => return Ok(ended),
            Err(depth) => return Err(self.used_up(depth).into()),
        }
        if self.state.time >= self.end_time {
            return Ok(Some(Termination::EndTime));
        }
        if self.state.step >= self.max_steps {
            return Ok(Some(Termination::StepLimit));
        }
        if self.state.step.is_multiple_of(AUDIT_INTERVAL) {
            self.look(self.state.energy(), self.state.momentum())?;
            control.report(self.progress())?;
        }
        if !self
            .watch
            .is_quiet(&self.state, self.scenario, self.end_time)
        {
            return Ok(None);
        }
        let state = &self.state;
        let tip = state.tip_segment().map(|tip| state.joints.get(tip));
        Ok(Some(match tip {
            Some(_) if state.left_the_plate() => Termination::PlugFree,
            Some(Some(joint)) if !joint.closed => Termination::Parted,
            Some(_) => Termination::Quiescent,
            None => Termination::ProjectileConsumed,
        }))
    }

    /// Looks at the books between two steps, and at the time step.
    pub(super) fn look(
        &mut self,
        energy: EnergyLedger,
        momentum: MomentumLedger,
    ) -> Result<(), AttemptError> {
        self.audit_books(energy, momentum)?;
        Ok(self.check_time_step()?)
    }

    /// Looks at the books a last time and sums up.
    pub(super) fn finish(
        &mut self,
        termination: Termination,
        recorder: Option<Recorder>,
    ) -> Result<RunResult, AttemptError> {
        self.audit()?;
        let results = Results {
            scenario: self.scenario,
            state: &self.state,
            watch: &self.watch,
            erosion_strain: self.control.erosion_strain,
        };
        Ok(results.sum_up(termination, recorder))
    }

    fn audit(&mut self) -> Result<(), AttemptError> {
        self.audit_books(self.state.energy(), self.state.momentum())
    }

    fn audit_books(
        &mut self,
        energy: EnergyLedger,
        momentum: MomentumLedger,
    ) -> Result<(), AttemptError> {
        let residuals = [energy.residual(), momentum.residual()];
        let moment = self.moment();
        let audited = self
            .watch
            .residuals
            .audit(residuals, moment, self.control.courant);
        audited.map_err(AttemptError::Unbalanced)
    }

    fn check_time_step(&self) -> Result<(), NumericalError> {
        if self.state.time_step >= COLLAPSED_STEP * self.watch.first_time_step {
            return Ok(());
        }
        let mut error = self.moment().failure(
            format!(
                "the time step has fallen to {:.1e} of the first one, because an element is crushed to nothing,",
                self.state.time_step / self.watch.first_time_step
            ),
            "set or lower `chain.erosion_strain`".to_owned(),
        );
        let length = |e: &usize| self.state.elements[*e].length;
        error.element = self
            .state
            .segments
            .iter()
            .flat_map(|segment| segment.elements())
            .min_by(|a, b| length(a).total_cmp(&length(b)));
        Err(error)
    }

    fn used_up(&self, depth: f64) -> NumericalError {
        self.moment().failure(
            format!(
                "the column that stands for a semi-infinite target is used up at a depth of {:.2} mm",
                depth * 1e3
            ),
            "give the last layer a thickness".to_owned(),
        )
    }

    fn progress(&self) -> Progress {
        let motion = self.state.projectile_motion();
        let depth = self.watch.largest_depth;
        let moment = self.moment();
        moment.progress(self.end_time, motion, self.scenario.impact_speed, depth)
    }

    fn record(&self, recorder: &mut Option<Recorder>) {
        let state = &self.state;
        self.moment()
            .record(recorder, || state.sample(), || state.profile());
    }

    fn moment(&self) -> Moment {
        Moment {
            step: self.state.step,
            time: self.state.time,
        }
    }
}

/// Time at which a run without an `end_time` gives up: many times what waves and the shot itself take.
fn end_time(scenario: &Scenario) -> f64 {
    if let Some(time) = scenario.options.chain.end_time {
        return time.si();
    }
    let rod = &scenario.projectile;
    let speed = scenario.impact_speed.max(1.0);
    let mut time = 2.0 * rod.length / rod.material.bar_wave_speed() + 2.0 * rod.length / speed;
    match &scenario.target {
        TargetBody::Layers { layers, .. } => {
            for plate in layers {
                let thickness = modelled_thickness(plate, scenario);
                time += 2.0 * thickness / plate.material.bar_wave_speed()
                    + 2.0 * (thickness + plate.gap) / speed;
            }
        }
        TargetBody::RigidWall => {}
        TargetBody::ConstantPressure(pressure) => {
            time += rod.material.density.si() * rod.length * speed / pressure;
        }
    }
    20.0 * time
}
