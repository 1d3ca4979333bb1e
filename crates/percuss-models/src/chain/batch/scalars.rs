//! What there is one of in every shot, and how it gets into a lane and out of it again.

use crate::{
    chain::{column::ColumnRun, state::BoundaryCondition},
    lanes::Lanes,
};

/// What there is one of in every shot.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LaneScalars {
    pub(super) courant: Lanes,
    pub(super) time: Lanes,
    pub(super) step: Lanes,
    pub(super) time_step: Lanes,
    pub(super) stable_step: Lanes,
    /// 1 where projectile and target touch, 0 where they do not.
    pub(super) closed: Lanes,
    pub(super) meetings: Lanes,
    pub(super) contact_force: Lanes,
    pub(super) impedance: Lanes,
    pub(super) plastic_work: [Lanes; 2],
    pub(super) friction_work: Lanes,
    pub(super) friction_impulse: Lanes,
    pub(super) contact_loss: Lanes,
    pub(super) support_impulse: Lanes,
    pub(super) boundary_work: Lanes,
    pub(super) largest_depth: Lanes,
    pub(super) peak_force: Lanes,
    pub(super) smallest_time_step: Lanes,
    pub(super) contact_time: Lanes,
    /// 1 where they have touched since the window began.
    pub(super) touched: Lanes,
    pub(super) back_position: Lanes,
    /// Depth and step at which a shot is over, time at which it is looked at.
    pub(super) perforated: Lanes,
    pub(super) most_steps: Lanes,
    pub(super) next_check: Lanes,
    /// Speed of the tail below which the projectile may be at rest; −∞ once it has been.
    pub(super) slow_tail: Lanes,
}

impl LaneScalars {
    pub(super) fn load_lane(&mut self, lane: usize, run: &ColumnRun<'_>) {
        self.clear_lane(lane);
        let state = &run.solver.state;
        self.courant.0[lane] = run.solver.control.courant;
        self.stable_step.0[lane] = state.stable_step;
        self.closed.0[lane] = f64::from(state.interfaces[0].closed);
        if let BoundaryCondition::Open { impedance, .. } = state.end {
            self.impedance.0[lane] = impedance;
        }
        self.back_position.0[lane] = state.back_position;
        self.most_steps.0[lane] = run.limits.max_steps as f64;
        if run.solver.scenario.target_thickness().is_some() {
            self.perforated.0[lane] = state.back_position;
        }
        // The single run looks at the first step.
        self.next_check.0[lane] = 0.0;
    }

    pub(super) fn store_lane(&self, lane: usize, run: &mut ColumnRun<'_>) {
        let state = &mut run.solver.state;
        state.time = self.time.0[lane];
        state.step = self.step.0[lane] as u64;
        state.time_step = self.time_step.0[lane];
        state.stable_step = self.stable_step.0[lane];
        state.contact_force = self.contact_force.0[lane];
        state.meetings = self.meetings.0[lane] as u64;
        let accumulated = &mut state.accumulated;
        accumulated.plastic = self.plastic_work.map(|work| work.0[lane]);
        accumulated.friction_work = self.friction_work.0[lane];
        accumulated.friction_impulse = self.friction_impulse.0[lane];
        accumulated.contact_loss = self.contact_loss.0[lane];
        accumulated.support_impulse = self.support_impulse.0[lane];
        accumulated.boundary_work = self.boundary_work.0[lane];
        let monitor = &mut run.monitor;
        monitor.largest_depth = self.largest_depth.0[lane];
        monitor.peak_force = self.peak_force.0[lane];
        monitor.smallest_time_step = self.smallest_time_step.0[lane];
        monitor.contact_time = self.contact_time.0[lane];
        run.solver.window.touched = self.touched.0[lane] > 0.0;
    }

    pub(super) fn follow(&mut self, lane: usize, run: &ColumnRun<'_>) {
        let (monitor, window) = (&run.monitor, &run.solver.window);
        self.largest_depth.0[lane] = monitor.largest_depth;
        self.peak_force.0[lane] = monitor.peak_force;
        self.smallest_time_step.0[lane] = monitor.smallest_time_step;
        self.contact_time.0[lane] = monitor.contact_time;
        self.touched.0[lane] = f64::from(window.touched);
        self.next_check.0[lane] = window
            .end_time(run.solver.scenario)
            .min(run.limits.end_time);
        self.slow_tail.0[lane] = match monitor.at_rest {
            None => 0.5 * run.solver.scenario.impact_velocity,
            Some(_) => f64::NEG_INFINITY,
        };
    }

    pub(super) fn clear_lane(&mut self, lane: usize) {
        for of in [
            &mut self.time,
            &mut self.step,
            &mut self.time_step,
            &mut self.closed,
            &mut self.meetings,
            &mut self.contact_force,
            &mut self.impedance,
            &mut self.friction_work,
            &mut self.friction_impulse,
            &mut self.contact_loss,
            &mut self.support_impulse,
            &mut self.boundary_work,
            &mut self.largest_depth,
            &mut self.peak_force,
            &mut self.smallest_time_step,
            &mut self.contact_time,
            &mut self.touched,
            &mut self.back_position,
        ]
        .into_iter()
        .chain(&mut self.plastic_work)
        {
            of.0[lane] = 0.0;
        }
        for of in [&mut self.courant, &mut self.stable_step, &mut self.closed] {
            of.0[lane] = 1.0;
        }
        for of in [
            &mut self.perforated,
            &mut self.most_steps,
            &mut self.next_check,
        ] {
            of.0[lane] = f64::INFINITY;
        }
        self.slow_tail.0[lane] = f64::NEG_INFINITY;
    }
}
