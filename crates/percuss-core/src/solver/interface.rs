//! Interface of a numerical model to the time loop.

use super::{
    Control,
    archive::Archive,
    frames::Fields,
    gauge::Gauge,
    limits::Limits,
    monitor::{Clock, Probe, RunMonitor},
};
use crate::{
    Error, Scenario,
    error::NumericalError,
    history::{ElementState, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    outcome::{Outcome, RunResult, Termination},
};

/// One explicit time integration of a case. [`Drive`](super::driver::Drive) does everything between two steps.
pub trait Solver<'a>: Sized {
    /// Names of model and scheme in results.
    const NAMES: (&'static str, &'static str);
    /// How the balances of its runs are checked.
    const AUDIT: Audit;

    /// The bodies at the moment of impact. Where that may take more than a tenth of a second, `control` is asked whether to go on.
    ///
    /// # Errors
    /// [`Error::NotApplicable`]; [`Error::Cancelled`].
    fn build(
        scenario: &'a Scenario,
        courant: f64,
        control: &mut Control<'_>,
    ) -> Result<Self, Error>;

    /// Elements, cells or particles that a step goes through.
    fn size(&self) -> usize;

    /// Courant number that a case gives, and the default.
    fn courant(scenario: &Scenario) -> (Option<f64>, f64);

    /// When a run ends at the latest.
    fn limits(&self) -> Limits;

    /// Advances by one step.
    ///
    /// # Errors
    /// When the state cannot be continued.
    fn advance(&mut self) -> Result<(), NumericalError>;

    /// Step, time and time step.
    fn clock(&self) -> Clock;

    /// Depth and contact after a step, which `monitor` has not followed yet.
    fn probe(&mut self, monitor: &RunMonitor) -> Probe;

    /// Whether the projectile's momentum is used up.
    fn is_at_rest(&self) -> bool;

    /// Energy balance now [J].
    fn energy(&self) -> EnergyLedger;

    /// Momentum balance now [N s].
    fn momentum(&self) -> MomentumLedger;

    /// Part of the run that is done, estimated by the motion: 0 to 1.
    fn progress(&self) -> f64;

    /// Checks at every audit invariants of the solver itself.
    ///
    /// # Errors
    /// When the run cannot come to its end.
    fn check(&self, _monitor: &RunMonitor) -> Result<(), NumericalError> {
        Ok(())
    }

    /// Why the run is over after a step, if it is.
    ///
    /// # Errors
    /// When it cannot go on.
    fn event(&mut self, monitor: &RunMonitor) -> Result<Option<Termination>, NumericalError>;

    /// Entry of the time history now.
    fn sample(&self, monitor: &RunMonitor) -> Sample;

    /// States at gauges.
    fn gauges(&self, gauges: &[Gauge]) -> Vec<ElementState> {
        if gauges.is_empty() {
            return Vec::new();
        }
        match self.fields() {
            Fields::Elements(elements) => {
                gauges.iter().map(|gauge| gauge.read(&elements)).collect()
            }
            Fields::Particles { .. } => Vec::new(),
        }
    }

    /// States of all elements now.
    fn profile(&self) -> Profile;

    /// Fields of the current state.
    fn fields(&self) -> Fields<'_> {
        Fields::Elements(self.profile().elements)
    }

    /// Writes or reads everything that a step changes.
    ///
    /// # Errors
    /// [`Error::Checkpoint`].
    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error>;

    /// Outcome, and the criterion that it was found by; empty where the termination says it.
    fn outcome(&self, termination: Termination, monitor: &RunMonitor) -> (Outcome, String);

    /// Mesh and extremes of the material.
    fn extremes(&self) -> Extremes;

    /// Adds to a result what the driver does not have.
    fn complete(&self, result: &mut RunResult, monitor: &RunMonitor);
}

/// How often and how strictly the balances are checked.
#[derive(Debug, Clone, Copy)]
pub struct Audit {
    /// Steps between two checks.
    pub interval: u64,
    /// Steps between two reports of progress and checkpoints.
    pub report_interval: u64,
    /// Largest errors of energy and momentum, as parts of the initial ones.
    pub tolerance: BalanceTolerance,
    /// Repetition of a run that fails.
    pub retry: Retry,
}

/// Largest balance errors of a run that counts.
#[derive(Debug, Clone, Copy)]
pub struct BalanceTolerance {
    /// Of the energy, as a part of the initial energy.
    pub energy: f64,
    /// Of the momentum, as a part of the initial momentum.
    pub momentum: f64,
}

/// What is done about a run that fails at the default Courant number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Retry {
    /// It fails.
    Never,
    /// It is repeated with half the Courant number, down to this one, when a balance does not close.
    OfBalance {
        /// Smallest Courant number.
        smallest: f64,
    },
    /// The same, after any numerical error.
    OfAnyError {
        /// Smallest Courant number.
        smallest: f64,
    },
}

/// Mesh and extremes of the material of projectile and target.
#[derive(Debug, Clone, Copy, Default)]
pub struct Extremes {
    /// Elements at the start.
    pub elements: (usize, usize),
    /// Elements that have eroded.
    pub eroded_elements: (usize, usize),
    /// Largest plastic strain.
    pub largest_plastic_strain: (f64, f64),
    /// Largest temperature [K].
    pub largest_temperature: (f64, f64),
}

/// Part of its speed that a projectile of a mass [kg] and a momentum [N s] has lost.
pub fn slowed((mass, momentum): (f64, f64), impact_velocity: f64) -> f64 {
    if mass > 0.0 {
        1.0 - momentum / (mass * impact_velocity)
    } else {
        1.0
    }
}
