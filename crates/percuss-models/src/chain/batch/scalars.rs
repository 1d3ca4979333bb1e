//! What there is one of in every run.

use crate::{
    chain::{
        column::ColumnRun,
        state::{Accumulators, BoundaryCondition},
    },
    lanes::Real,
};

percuss_core::per_lane! {
    /// What there is one of in every run.
    #[derive(Debug, Clone, Copy, Default)]
    pub(super) struct RunScalars<R: Real = f64> {
        pub(super) courant: R,
        pub(super) time: R,
        pub(super) step: R,
        pub(super) time_step: R,
        pub(super) stable_step: R,
        /// Whether projectile and target touch, and whether they have since the window began.
        pub(super) closed: R::Flag,
        pub(super) touched: R::Flag,
        pub(super) meetings: R,
        pub(super) contact_force: R,
        pub(super) impedance: R,
        pub(super) accumulated: Accumulators<R>,
        pub(super) largest_depth: R,
        pub(super) peak_force: R,
        pub(super) smallest_time_step: R,
        pub(super) contact_time: R,
        pub(super) back_position: R,
        /// Depth and step at which a run is over, time at which it is looked at.
        pub(super) perforated: R,
        pub(super) most_steps: R,
        pub(super) next_check: R,
        /// Speed of the tail below which the projectile may be at rest; −∞ once it has been.
        pub(super) slow_tail: R,
    }
}

impl RunScalars {
    /// Those of a chain on which nothing ever happens.
    pub(super) fn idle() -> Self {
        Self {
            courant: 1.0,
            stable_step: 1.0,
            closed: true,
            perforated: f64::INFINITY,
            most_steps: f64::INFINITY,
            next_check: f64::INFINITY,
            slow_tail: f64::NEG_INFINITY,
            ..Self::default()
        }
    }

    /// Those of a run between two steps.
    pub(super) fn of(run: &ColumnRun<'_>) -> Self {
        let (state, monitor, window) = (&run.solver.state, &run.monitor, &run.solver.window);
        let scenario = run.solver.scenario;
        let end_time = window.end_time(scenario).min(run.limits.end_time);
        Self {
            courant: run.solver.control.courant,
            time: state.time,
            step: state.step as f64,
            time_step: state.time_step,
            stable_step: state.stable_step,
            closed: (state.tip_segment()).is_some_and(|tip| state.interfaces[tip].closed),
            touched: window.touched,
            meetings: state.meetings as f64,
            contact_force: state.contact_force,
            impedance: match state.end {
                BoundaryCondition::Open { impedance, .. } => impedance,
                BoundaryCondition::Free | BoundaryCondition::Fixed => 0.0,
            },
            accumulated: state.accumulated,
            largest_depth: monitor.largest_depth,
            peak_force: monitor.peak_force,
            smallest_time_step: monitor.smallest_time_step,
            contact_time: monitor.contact_time,
            back_position: state.back_position,
            perforated: match scenario.target_thickness() {
                Some(_) => state.back_position,
                None => f64::INFINITY,
            },
            most_steps: run.limits.max_steps as f64,
            // The single run looks at the first step.
            next_check: if state.step == 0 { 0.0 } else { end_time },
            slow_tail: match monitor.at_rest {
                None => 0.5 * scenario.impact_velocity,
                Some(_) => f64::NEG_INFINITY,
            },
        }
    }

    /// Puts them into their run.
    pub(super) fn store(self, run: &mut ColumnRun<'_>) {
        let state = &mut run.solver.state;
        state.time = self.time;
        state.step = self.step as u64;
        state.time_step = self.time_step;
        state.stable_step = self.stable_step;
        state.contact_force = self.contact_force;
        state.meetings = self.meetings as u64;
        state.accumulated = self.accumulated;
        if let Some(tip) = state.tip_segment() {
            state.interfaces[tip].closed = self.closed;
        }
        let monitor = &mut run.monitor;
        monitor.largest_depth = self.largest_depth;
        monitor.peak_force = self.peak_force;
        monitor.smallest_time_step = self.smallest_time_step;
        monitor.contact_time = self.contact_time;
        run.solver.window.touched = self.touched;
    }
}
