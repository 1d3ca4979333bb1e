//! One step of every lane: `State::advance` and `RunMonitor::follow` of a column, in the same order.

use super::bundle::Bundle;
use crate::{
    chain::solver::choose_time_step,
    lanes::{LANES, Lanes},
};

/// What a step has for every lane besides the state.
#[derive(Clone, Copy)]
pub(super) struct Step {
    /// Length of the step before, of this one, and of the kick between them.
    pub(super) before: Lanes,
    pub(super) length: Lanes,
    pub(super) kick: Lanes,
    /// Inverse of its length.
    pub(super) rate: Lanes,
}

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
        self.kick_joints(face, &step);
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
        let (before, scalars) = (self.scalars.time_step, &self.scalars);
        let (courant, stable) = (scalars.courant, scalars.stable_step);
        let mut step = Step {
            before,
            length: before,
            kick: before,
            rate: before,
        };
        for l in 0..LANES {
            let length = choose_time_step(before.0[l], courant.0[l] * stable.0[l]);
            step.length.0[l] = length;
            step.kick.0[l] = 0.5 * (before.0[l] + length);
            step.rate.0[l] = 1.0 / length;
        }
        step
    }
}
