//! When a shot is over, and how it ended.

use super::{crater, solver::Solver};
use crate::{
    outcome::{Outcome, Termination},
    scenario::Scenario,
};

/// Part of the impact speed below which a projectile counts as stopped.
const REST_FRACTION: f64 = 0.01;
/// Part of the initial energy that may still dissipate in a window of a run that is over.
const QUIET_FRACTION: f64 = 1e-3;
/// Part of the impact speed by which a projectile that has come through may still slow in a window.
const FREE_FRACTION: f64 = 1e-3;

/// Part of the largest force so far below which bodies do not touch: nodes of the grid that two bodies share still exchange the impulses
/// of what rings in them.
const TOUCHING_FRACTION: f64 = 1e-2;

/// What is followed during a run.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Watch {
    pub(super) depth: f64,
    pub(super) largest_depth: f64,
    pub(super) peak_force: f64,
    pub(super) first_time_step: f64,
    pub(super) smallest_time_step: f64,
    pub(super) energy_residual: f64,
    pub(super) momentum_residual: f64,
    /// Total time during which the projectile presses on the target [s].
    pub(super) contact_time: f64,
    /// Whether it presses in the step that comes next.
    touches: bool,
    /// Time up to which the run was followed [s].
    followed: f64,
    /// Time and depth at which the projectile's momentum was first used up.
    pub(super) at_rest: Option<(f64, f64)>,
    /// Whether the crater floor passed the original back face.
    pub(super) perforated: bool,
    window_start: f64,
    window_dissipation: f64,
    window_depth: f64,
    window_speed: f64,
}

impl Watch {
    /// A watch of a solver at the moment of impact.
    pub(super) fn new(solver: &Solver) -> Self {
        Self {
            touches: solver.pending.contact_force > 0.0,
            ..Self::default()
        }
    }

    /// Keeps up extremes and the state of the projectile after a step.
    pub(super) fn follow(&mut self, solver: &Solver, thickness: Option<f64>) {
        let before = self.depth;
        if solver.bodies.len() > 1 {
            match crater::floor(&solver.bodies[1..], solver.cell) {
                Some(depth) => self.depth = depth,
                None => self.perforated = true,
            }
            self.largest_depth = self.largest_depth.max(self.depth);
            self.perforated |= thickness.is_some_and(|thickness| self.depth >= thickness);
        }
        self.peak_force = self.peak_force.max(solver.pending.contact_force);
        if self.touches {
            self.contact_time += solver.time - self.followed;
        }
        self.touches = solver.pending.contact_force > TOUCHING_FRACTION * self.peak_force;
        self.followed = solver.time;
        if solver.step <= 1 {
            self.first_time_step = solver.time_step;
            self.smallest_time_step = solver.time_step;
        }
        self.smallest_time_step = self.smallest_time_step.min(solver.time_step);
        // Debris of an eroding rod flies back while the rod goes on: its floor must have stopped too.
        let stopped = self.depth <= before;
        if self.at_rest.is_none() && stopped && solver.sums[0].momentum <= 0.0 {
            self.at_rest = Some((solver.time, self.depth));
        }
        self.energy_residual = self.energy_residual.max(solver.energy().residual().abs());
        self.momentum_residual = self
            .momentum_residual
            .max(solver.momentum().residual().abs());
    }

    /// Why the shot is over, if it is: looked at once in a round trip of a wave in the projectile.
    pub(super) fn end(&mut self, solver: &Solver, scenario: &Scenario) -> Option<Termination> {
        let projectile = &solver.sums[0];
        if projectile.mass <= 0.0 {
            return Some(Termination::ProjectileConsumed);
        }
        let rod = &scenario.projectile;
        if solver.time < self.window_start + 2.0 * rod.length / rod.material.bar_wave_speed() {
            return None;
        }
        let speed = projectile.momentum / projectile.mass;
        let books = &solver.books;
        let dissipation = books.work[0][1] + books.work[1][1] + books.transfer + books.contact;
        let flow = (dissipation - self.window_dissipation) / books.initial_energy;
        let deepening = self.largest_depth > self.window_depth * (1.0 + 1e-3);
        let slowing = (self.window_speed - speed).abs() / scenario.impact_speed;
        self.window_start = solver.time;
        self.window_dissipation = dissipation;
        self.window_depth = self.largest_depth;
        self.window_speed = speed;
        // A plate that dishes carries the crater floor past its original back face and may throw the projectile back.
        if self.perforated && speed > 0.0 {
            return (slowing <= FREE_FRACTION).then_some(Termination::LeftTarget);
        }
        // What still rings changes neither depth nor length.
        let over = self.at_rest.is_some() && !deepening && flow <= QUIET_FRACTION;
        over.then_some(if speed < -REST_FRACTION * scenario.impact_speed {
            Termination::Parted
        } else {
            Termination::Quiescent
        })
    }

    /// How a run ended that was ended for a reason.
    pub(super) fn outcome(
        &self,
        termination: Termination,
        solver: &Solver,
        impact_speed: f64,
    ) -> Outcome {
        let projectile = &solver.sums[0];
        if termination == Termination::NothingMoves {
            return Outcome::AtRest;
        }
        if projectile.mass <= 0.0 {
            return Outcome::ProjectileEroded;
        }
        let ratio = projectile.momentum / (projectile.mass * impact_speed);
        if self.perforated && ratio > REST_FRACTION {
            return Outcome::Perforated;
        }
        if matches!(termination, Termination::EndTime | Termination::StepLimit)
            && self.at_rest.is_none()
        {
            return Outcome::OutOfTime;
        }
        if ratio < -REST_FRACTION {
            Outcome::Rebounded
        } else {
            Outcome::AtRest
        }
    }
}
