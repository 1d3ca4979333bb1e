//! Scheme `conservative`: the 1-D column as a solver.

use super::{end::Window, mesh, results::Results, solver::StepControl, state::State, tate};
use crate::{
    Error, Scenario,
    error::NumericalError,
    history::{PROFILE_ELEMENTS, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    options::{ChainOptions, ErosionCriterion, ErosionStrain},
    outcome::{Outcome, RunResult, Termination},
    solver::{
        Control,
        archive::Archive,
        driver::Drive,
        frames::Fields,
        interface::{Audit, BalanceTolerance, Extremes, Retry, Solver, slowed},
        limits::Limits,
        monitor::{Clock, Probe, RunMonitor},
    },
};

/// Courant number below which a run is not repeated.
const SMALLEST_COURANT: f64 = 0.05;
/// Steps between two audits.
pub(super) const AUDIT_INTERVAL: u64 = 128;
/// Section of the first time step below which a run would never end.
const COLLAPSED_STEP: f64 = 1e-4;

/// Tolerances of the balances of the chain.
pub(super) const TOLERANCE: BalanceTolerance = BalanceTolerance {
    energy: 1e-3,
    momentum: 1e-9,
};

/// The projectile and the target column as chains of point masses and springs.
#[derive(Debug)]
pub(crate) struct Column<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) state: State,
    pub(super) control: StepControl,
    pub(super) window: Window,
    pub(super) limits: Limits,
}

/// A run of the column.
pub(super) type ColumnRun<'a> = Drive<'a, Column<'a>>;

impl<'a> Column<'a> {
    /// The column at the moment of impact.
    pub(super) fn new(scenario: &'a Scenario, courant: f64) -> Self {
        let options = &scenario.options.chain;
        let mut state = mesh::build(scenario);
        let mut longest_step = f64::INFINITY;
        let erosion_strain = match options.erosion_criterion() {
            ErosionCriterion::Tate => {
                longest_step = tate::longest_step(&state, scenario.impact_velocity);
                tate::USED_UP_STRAIN
            }
            ErosionCriterion::Strain => erosion_strain(options),
        };
        let control = StepControl::new(options, courant, erosion_strain, longest_step);
        state.stable_step *= control.first_step_factor(&state, scenario.impact_velocity);
        Self {
            scenario,
            state,
            control,
            window: Window::default(),
            limits: Limits::new(scenario, options.end_time, options.max_steps())
                .or_at_rest(scenario, options.end_at_rest()),
        }
    }

    fn results(&self) -> Results<'_> {
        Results {
            scenario: self.scenario,
            state: &self.state,
            erosion_strain: self.control.erosion_strain,
        }
    }
}

/// Strain at which an element erodes.
pub(super) fn erosion_strain(options: &ChainOptions) -> f64 {
    match options.erosion_strain() {
        ErosionStrain::At(strain) => strain,
        ErosionStrain::Never => f64::INFINITY,
    }
}

impl<'a> Solver<'a> for Column<'a> {
    const NAMES: (&'static str, &'static str) = ("chain", "conservative");
    const AUDIT: Audit = Audit {
        interval: AUDIT_INTERVAL,
        report_interval: AUDIT_INTERVAL,
        tolerance: TOLERANCE,
        retry: Retry::OfBalance {
            smallest: SMALLEST_COURANT,
        },
    };

    fn build(scenario: &'a Scenario, courant: f64, _: &mut Control<'_>) -> Result<Self, Error> {
        Ok(Self::new(scenario, courant))
    }

    fn size(&self) -> usize {
        self.state.elements.len()
    }

    fn courant(scenario: &Scenario) -> (Option<f64>, f64) {
        (scenario.options.chain.courant, ChainOptions::COURANT)
    }

    fn limits(&self) -> Limits {
        self.limits
    }

    #[inline(always)]
    fn advance(&mut self) -> Result<(), NumericalError> {
        self.state.advance(&self.control)
    }

    #[inline(always)]
    fn clock(&self) -> Clock {
        Clock {
            step: self.state.step,
            time: self.state.time,
            time_step: self.state.time_step,
        }
    }

    #[inline(always)]
    fn probe(&mut self, _: &RunMonitor) -> Probe {
        let state = &self.state;
        let touches = self.window.follow(state, self.scenario);
        Probe {
            depth: state.depth(),
            contact_force: state.contact_force,
            contact_time: if touches { state.time_step } else { 0.0 },
        }
    }

    fn is_at_rest(&self) -> bool {
        let state = &self.state;
        if state.tip_segment().is_none() {
            return false;
        }
        // The tail is the last to hear of the impact: no need to sum up before it slows down.
        let tail = state.segments[0].first_node;
        state.nodes.velocity[tail] < 0.5 * self.scenario.impact_velocity
            && state.projectile_motion().1 <= 0.0
    }

    fn energy(&self) -> EnergyLedger {
        self.state.energy()
    }

    fn momentum(&self) -> MomentumLedger {
        self.state.momentum()
    }

    fn progress(&self) -> f64 {
        slowed(
            self.state.projectile_motion(),
            self.scenario.impact_velocity,
        )
    }

    fn check(&self, monitor: &RunMonitor) -> Result<(), NumericalError> {
        let state = &self.state;
        if state.time_step >= COLLAPSED_STEP * monitor.first_time_step {
            return Ok(());
        }
        let mut error = self.clock().failure(
            format!(
                "the time step has fallen to {:.1e} of the first one, because an element is crushed to nothing,",
                state.time_step / monitor.first_time_step
            ),
            "set or lower `chain.erosion_strain`".to_owned(),
        );
        let length = |e: &usize| state.elements.part(*e, |block| &block.length);
        error.element = state
            .segments
            .iter()
            .flat_map(|segment| segment.elements())
            .min_by(|a, b| length(a).total_cmp(&length(b)));
        Err(error)
    }

    fn event(&mut self, monitor: &RunMonitor) -> Result<Option<Termination>, NumericalError> {
        let used_up = |depth: f64| {
            self.clock().failure(
                format!(
                    "the column that stands for a semi-infinite target is used up at a depth of {:.2} mm",
                    depth * 1e3
                ),
                "give the last layer a thickness".to_owned(),
            )
        };
        if let Some(termination) = self.state.event(self.scenario).map_err(used_up)? {
            return Ok(Some(termination));
        }
        let end_time = self.limits.end_time;
        Ok(self
            .window
            .end(&self.state, self.scenario, monitor, end_time))
    }

    fn sample(&self, _: &RunMonitor) -> Sample {
        self.state.sample()
    }

    fn profile(&self) -> Profile {
        self.state.profile(PROFILE_ELEMENTS)
    }

    fn fields(&self) -> Fields<'_> {
        Fields::Elements(self.state.profile(usize::MAX).elements)
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.window)?;
        self.state.archive(archive)
    }

    fn outcome(&self, termination: Termination, monitor: &RunMonitor) -> (Outcome, String) {
        let impact_velocity = self.scenario.impact_velocity;
        self.window
            .outcome(termination, &self.state, monitor, impact_velocity)
    }

    fn extremes(&self) -> Extremes {
        self.results().extremes()
    }

    fn complete(&self, result: &mut RunResult, monitor: &RunMonitor) {
        self.results().complete(result, monitor);
    }
}
