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
    /// Takes steps until a lane needs_scalar for the single run or none are left; says which ones do.
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
        self.now = 1 - self.now;
        self.end(&step, &estimate)
    }

    /// Chooses the time steps.
    #[inline(always)]
    fn begin(&self) -> Step {
        let (before, stable, courant) = (
            self.scalars.time_step.0,
            self.scalars.stable_step.0,
            self.scalars.courant.0,
        );
        let mut length = [0.0; LANES];
        let mut kick = [0.0; LANES];
        let mut rate = [0.0; LANES];
        for l in 0..LANES {
            length[l] = choose_time_step(before[l], courant[l] * stable[l]);
            kick[l] = 0.5 * (before[l] + length[l]);
            rate[l] = 1.0 / length[l];
        }
        Step {
            before: Lanes(before),
            length: Lanes(length),
            kick: Lanes(kick),
            rate: Lanes(rate),
        }
    }
}
