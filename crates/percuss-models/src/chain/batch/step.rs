//! One step of every lane: `State::advance` and `RunMonitor::follow` of a column, in the same order.

use super::bundle::Bundle;
use crate::{
    chain::solver::StepTimes,
    lanes::{LANES, Lanes, PerLane},
};

/// Times of a step of every lane.
pub(super) type Step = StepTimes<Lanes>;

/// What a step finds out about the elements.
pub(super) struct StepEstimate {
    pub(super) stable_step: Lanes,
    /// Largest rate of approach, as a part of the length.
    pub(super) fastest: Lanes,
    /// Whether an element of any lane is about to erode.
    pub(super) erodes: bool,
}

impl Bundle {
    /// Takes steps until a lane needs the single run or none are left; says which ones do.
    #[inline(always)]
    pub(super) fn advance(&mut self, left: &mut u64) -> [bool; LANES] {
        while *left > 0 {
            *left -= 1;
            let needs_scalar = self.step();
            if needs_scalar.iter().any(|&needs_scalar| needs_scalar) {
                return needs_scalar;
            }
        }
        [false; LANES]
    }

    #[inline(always)]
    fn step(&mut self) -> [bool; LANES] {
        let step = self.begin();
        let force_behind = self.kick_projectile(&step);
        let [projectile, target] = self.mesh.elements;
        let [tip, face] = [projectile, projectile + 1];
        self.kick_contact(force_behind, &step);
        self.kick_target(&step);
        self.close_joints(&step);
        for end in [tip, face, face + target] {
            self.drift(end, &step);
        }
        let estimate = self.update(&step);
        self.end(&step, &estimate)
    }

    /// Chooses the time steps.
    #[inline(always)]
    fn begin(&self) -> Step {
        let scalars = &self.scalars;
        let (before, courant, stable) = (scalars.time_step, scalars.courant, scalars.stable_step);
        let mut step = Step::default();
        for l in 0..LANES {
            let allowed = courant.0[l] * stable.0[l];
            step.set_lane(l, StepTimes::choose(before.0[l], allowed));
        }
        step
    }
}
