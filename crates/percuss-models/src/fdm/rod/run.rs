//! Geometry `rod` as a solver.

use serde::{Deserialize, Serialize};

use super::{law::RodLaw, mesh, results};
use crate::{
    Error, Scenario,
    error::NumericalError,
    fdm::{
        audit::{self, AUDIT},
        grid::{BoundaryCondition, Cells, Grid},
    },
    history::{PROFILE_ELEMENTS, Profile, Sample},
    ledger::{EnergyLedger, MomentumLedger},
    options::{FdmOptions, RodOptions},
    outcome::{Outcome, REST_FRACTION, RunResult, Termination},
    solver::{
        Control,
        archive::Archive,
        driver::Drive,
        frames::Fields,
        interface::{Audit, Extremes, Solver, slowed},
        limits::Limits,
        monitor::{Clock, Probe, RunMonitor},
    },
};

/// Part of the initial energy that may still dissipate in a window of a run whose bodies touch.
const QUIET_FRACTION: f64 = 1e-6;
/// The same after separation: vibrations then change neither depth nor velocity.
const PARTED_FRACTION: f64 = 1e-4;

/// Projectile and target as rods.
#[derive(Debug)]
pub(in crate::fdm) struct Rod<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) options: RodOptions,
    pub(super) grid: Grid<RodLaw>,
    courant: f64,
    limits: Limits,
    window: Window,
    /// Time before the last step [s].
    before: f64,
}

/// A run in the geometry `rod`.
pub(in crate::fdm) type RodRun<'a> = Drive<'a, Rod<'a>>;

/// One round trip of a wave in the projectile, in which a run that is over changes no more.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Window {
    start: f64,
    dissipation: f64,
    depth: f64,
    touched: bool,
}

impl Rod<'_> {
    fn has_passed(&self) -> bool {
        let thickness = self.scenario.target_thickness();
        thickness.is_some_and(|thickness| self.grid.depth() >= thickness)
    }

    /// Whether the run is over at the end of a window.
    fn is_quiet(&mut self, monitor: &RunMonitor) -> bool {
        let rod = &self.scenario.projectile;
        if self.grid.time < self.window.start + 2.0 * rod.length / rod.material.bar_wave_speed() {
            return false;
        }
        let [projectile, target] = self.grid.stored();
        let accumulated = &self.grid.accumulated;
        let dissipation = projectile.plastic
            + target.plastic
            + projectile.viscous
            + target.viscous
            + accumulated.friction_work;
        let before = std::mem::replace(
            &mut self.window,
            Window {
                start: self.grid.time,
                dissipation,
                depth: monitor.largest_depth,
                touched: false,
            },
        );
        let flow = (dissipation - before.dissipation) / accumulated.initial_energy;
        if !before.touched {
            let remaining = self.limits.end_time - self.grid.time;
            return flow <= PARTED_FRACTION && !self.will_meet(remaining);
        }
        // A projectile that is still being pushed back has not got its rebound speed yet.
        let (mass, momentum) = self.grid.motion(0);
        let still = (momentum / mass).abs() <= REST_FRACTION * self.scenario.impact_velocity;
        let deepening = monitor.largest_depth > before.depth * (1.0 + 1e-9);
        monitor.at_rest.is_some() && !deepening && still && flow <= QUIET_FRACTION
    }

    /// Whether the projectile in free flight will meet what is ahead of it within a time.
    fn will_meet(&self, horizon: f64) -> bool {
        if self.grid.closed.first() != Some(&false) {
            return false;
        }
        let tip = self.grid.span(0).1;
        let gap = self.grid.nodes.position[tip + 1] - self.grid.nodes.position[tip];
        let mean = |role| {
            let (mass, momentum) = self.grid.motion(role);
            if mass > 0.0 { momentum / mass } else { 0.0 }
        };
        // A target that is held vibrates about its place; one that is free flies at its mean speed.
        let away = if self.grid.ends[1] == BoundaryCondition::Free {
            mean(1)
        } else {
            0.0
        };
        let approach = mean(0) - away;
        approach > 0.0 && gap < approach * horizon
    }
}

impl<'a> Solver<'a> for Rod<'a> {
    const NAMES: (&'static str, &'static str) = ("fdm", "rod");
    const AUDIT: Audit = AUDIT;

    fn build(scenario: &'a Scenario, courant: f64, _: &mut Control<'_>) -> Result<Self, Error> {
        let options = options_of(scenario);
        Ok(Self {
            scenario,
            grid: mesh::build(scenario, &options),
            limits: limits(scenario).1,
            options,
            courant,
            window: Window::default(),
            before: 0.0,
        })
    }

    fn size(&self) -> usize {
        self.grid.cells.count()
    }

    fn courant(scenario: &Scenario) -> (Option<f64>, f64) {
        (
            scenario.options.fdm.courant,
            FdmOptions::default().courant(),
        )
    }

    fn limits(&self) -> Limits {
        self.limits
    }

    fn advance(&mut self) -> Result<(), NumericalError> {
        self.before = self.grid.time;
        self.grid.advance(self.courant, f64::INFINITY)
    }

    fn clock(&self) -> Clock {
        self.grid.clock()
    }

    fn probe(&mut self, _: &RunMonitor) -> Probe {
        self.window.touched |= self.grid.touches();
        audit::probe(&self.grid, self.before)
    }

    fn is_at_rest(&self) -> bool {
        audit::is_at_rest(&self.grid, self.scenario.impact_velocity)
    }

    fn energy(&self) -> EnergyLedger {
        self.grid.energy()
    }

    fn momentum(&self) -> MomentumLedger {
        self.grid.momentum()
    }

    fn progress(&self) -> f64 {
        slowed(self.grid.motion(0), self.scenario.impact_velocity)
    }

    fn check(&self, monitor: &RunMonitor) -> Result<(), NumericalError> {
        audit::check_time_step(&self.grid, monitor)
    }

    fn event(&mut self, monitor: &RunMonitor) -> Result<Option<Termination>, NumericalError> {
        if self.has_passed() {
            return Ok(Some(Termination::PassedBackFace));
        }
        let parted = self.grid.closed.first() == Some(&false);
        Ok(self.is_quiet(monitor).then_some(if parted {
            Termination::Parted
        } else {
            Termination::Quiescent
        }))
    }

    fn sample(&self, _: &RunMonitor) -> Sample {
        self.grid.sample()
    }

    fn profile(&self) -> Profile {
        self.grid.profile(PROFILE_ELEMENTS)
    }

    fn fields(&self) -> Fields<'_> {
        Fields::Elements(self.grid.profile(usize::MAX).elements)
    }

    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.window)?;
        archive.item(&mut self.before)?;
        self.grid.archive(archive)
    }

    fn outcome(&self, termination: Termination, monitor: &RunMonitor) -> (Outcome, String) {
        let outcome = results::outcome(self, termination, monitor);
        (outcome, String::new())
    }

    fn extremes(&self) -> Extremes {
        audit::extremes(&self.grid)
    }

    fn complete(&self, result: &mut RunResult, monitor: &RunMonitor) {
        results::complete(self, result, monitor);
    }
}

/// Courant number and limits of a run before it starts.
pub(in crate::fdm) fn limits(scenario: &Scenario) -> (f64, Limits) {
    let options = options_of(scenario);
    let limits = Limits::new(scenario, options.end_time, options.max_steps)
        .or_at_rest(scenario, options.end_at_rest);
    (options.courant, limits)
}

fn options_of(scenario: &Scenario) -> RodOptions {
    scenario.options.fdm.of_rod(&scenario.options.chain)
}
