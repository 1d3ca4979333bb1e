//! End of a run, and its outcome.

use super::{opening::is_open, solver::Grid};
use crate::{
    options::Edge,
    outcome::{Outcome, REST_FRACTION, Termination},
    problem::RearFaceCondition,
    scenario::Scenario,
    solver::monitor::RunMonitor,
};

/// Part of the initial energy that may still dissipate in a window of a run that is over.
const QUIET_FRACTION: f64 = 1e-3;
/// Part of the impact velocity by which a projectile that has come through may still slow in a window.
const FREE_FRACTION: f64 = 1e-3;

/// Part of the projectile that has to leave the modelled space, which ends two of its lengths behind the rear face: the rest has come through.
const PASSED_FRACTION: f64 = 0.01;

/// One round trip of a wave in the projectile, in which a run that is over changes no more.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Window {
    /// Whether the crater floor passed the original rear face.
    pub(super) perforated: bool,
    /// Whether the target was open at the end of the last window in which that was looked at.
    open: bool,
    start: f64,
    dissipation: f64,
    depth: f64,
    speed: f64,
}

impl Window {
    /// Why a run is over at the end of a window, if it is.
    pub(super) fn end(
        &mut self,
        grid: &Grid,
        scenario: &Scenario,
        monitor: &RunMonitor,
    ) -> Option<Termination> {
        let projectile = &grid.sums[0];
        if projectile.mass <= 0.0 {
            return Some(Termination::ProjectileConsumed);
        }
        let rod = &scenario.projectile;
        // Metal that flies along in front of it may seem to connect a projectile with the target.
        let has_passed = grid.accumulated.passed > PASSED_FRACTION * rod.mass;
        if has_passed && scenario.rear_face() == Some(RearFaceCondition::Free) {
            self.open = is_held(scenario) || self.sees_opening(grid, scenario);
            return Some(match self.open {
                true => Termination::LeftTarget,
                false => Termination::Parted,
            });
        }
        if grid.time < self.start + 2.0 * rod.length / rod.material.bar_wave_speed() {
            return None;
        }
        let speed = projectile.momentum / projectile.mass;
        let accumulated = &grid.accumulated;
        let dissipation = accumulated.work[0][1]
            + accumulated.work[1][1]
            + accumulated.transfer
            + accumulated.contact;
        let flow = (dissipation - self.dissipation) / accumulated.initial_energy;
        let deepening = monitor.largest_depth > self.depth * (1.0 + 1e-3);
        let slowing = (self.speed - speed).abs() / scenario.impact_velocity;
        self.start = grid.time;
        self.dissipation = dissipation;
        self.depth = monitor.largest_depth;
        self.speed = speed;
        // A plate that dishes carries the crater floor past its original rear face and may throw the projectile back.
        if self.perforated && speed > 0.0 {
            self.open = self.sees_opening(grid, scenario);
            if self.open {
                return (slowing <= FREE_FRACTION).then_some(Termination::LeftTarget);
            }
        }
        // What still rings changes neither depth nor length.
        let over = monitor.at_rest.is_some() && !deepening && flow <= QUIET_FRACTION;
        over.then_some(if speed < -REST_FRACTION * scenario.impact_velocity {
            Termination::Parted
        } else {
            Termination::Quiescent
        })
    }

    /// Whether every layer of the target is open: what has been carried out of the modelled space whole is as it was when it was last seen.
    fn sees_opening(&self, grid: &Grid, scenario: &Scenario) -> bool {
        let is_gone = grid.sums[1..].iter().all(|layer| layer.mass <= 0.0);
        match is_gone && !is_held(scenario) {
            true => self.open,
            false => has_opened(grid, 0.5 * scenario.projectile.diameter),
        }
    }

    /// Outcome of a run that was ended for a reason.
    pub(super) fn outcome(
        &self,
        termination: Termination,
        grid: &Grid,
        monitor: &RunMonitor,
        impact_velocity: f64,
    ) -> Outcome {
        let projectile = &grid.sums[0];
        if termination == Termination::NothingMoves {
            return Outcome::AtRest;
        }
        if projectile.mass <= 0.0 {
            return Outcome::ProjectileEroded;
        }
        let ratio = projectile.momentum / (projectile.mass * impact_velocity);
        if self.open && ratio > REST_FRACTION {
            return Outcome::Perforated;
        }
        if matches!(termination, Termination::EndTime | Termination::StepLimit)
            && monitor.at_rest.is_none()
        {
            return Outcome::OutOfTime;
        }
        // A light target that is free to fly is carried along.
        if ratio < -REST_FRACTION {
            Outcome::Rebounded
        } else if ratio > REST_FRACTION {
            Outcome::Separated
        } else {
            Outcome::AtRest
        }
    }
}

/// Whether the edge of the target holds it.
pub(super) fn is_held(scenario: &Scenario) -> bool {
    scenario.options.axi.edge != Some(Edge::Free)
}

/// Whether every layer of the target is open.
fn has_opened(grid: &Grid, projectile_radius: f64) -> bool {
    let layers = &grid.bodies[1..];
    layers
        .iter()
        .all(|layer| is_open(layer, &grid.mesh, projectile_radius))
}
