//! Extremes and balance errors of a run, followed from step to step.

use serde::{Deserialize, Serialize};

/// Where a run stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Steps so far.
    pub step: u64,
    /// Time [s].
    pub time: f64,
    /// Time step [s].
    pub time_step: f64,
}

/// What a solver reports after a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Probe {
    /// Depth of the crater floor [m].
    pub depth: f64,
    /// Force between projectile and target [N].
    pub contact_force: f64,
    /// Part of the step in which they touched [s].
    pub contact_time: f64,
}

/// Extremes and balance errors of a run so far.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct RunMonitor {
    /// Depth of the crater floor [m].
    pub depth: f64,
    /// Its largest value so far, not below 0 [m].
    pub largest_depth: f64,
    /// Largest contact force [N].
    pub peak_force: f64,
    /// Its time [s].
    pub peak_time: f64,
    /// First time step [s].
    pub first_time_step: f64,
    /// Smallest time step [s].
    pub smallest_time_step: f64,
    /// Time during which projectile and target touched [s].
    pub contact_time: f64,
    /// Time [s] and depth [m] at which the projectile's momentum was first used up.
    pub at_rest: Option<(f64, f64)>,
    /// Largest balance errors.
    pub balance_error: BalanceError,
}

/// Largest errors of the balances, as parts of the initial energy and momentum.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct BalanceError {
    /// Of the energy.
    pub energy: f64,
    /// Of the momentum.
    pub momentum: f64,
}

impl RunMonitor {
    /// Depth of the crater floor when the projectile's momentum was used up, not below 0; the largest one where it never was [m].
    pub fn depth_at_rest(&self) -> f64 {
        // A floor that sprang back beyond the original face is no depth.
        self.at_rest
            .map_or(self.largest_depth, |(_, depth)| depth.max(0.0))
    }

    /// Includes a step; `is_at_rest` is asked until it is true once.
    #[inline(always)]
    pub(super) fn follow(&mut self, clock: Clock, probe: Probe, is_at_rest: impl FnOnce() -> bool) {
        self.depth = probe.depth;
        self.largest_depth = self.largest_depth.max(probe.depth);
        if probe.contact_force > self.peak_force {
            self.peak_force = probe.contact_force;
            self.peak_time = clock.time;
        }
        if clock.step <= 1 {
            self.first_time_step = clock.time_step;
            self.smallest_time_step = clock.time_step;
        }
        self.smallest_time_step = self.smallest_time_step.min(clock.time_step);
        self.contact_time += probe.contact_time;
        if self.at_rest.is_none() && is_at_rest() {
            self.at_rest = Some((clock.time, probe.depth));
        }
    }
}
