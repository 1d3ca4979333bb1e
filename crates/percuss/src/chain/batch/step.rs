//! One step of every lane: `State::advance` and `RunMonitor::follow` of a column, in the same order.

use super::bundle::Bundle;
use crate::{
    chain::{pair::Times, solver::choose_time_step},
    lanes::{LaneMask, Lanes, Mask, Real},
};

/// What a step has for every lane besides the state.
#[derive(Clone, Copy)]
pub(super) struct Step {
    /// Length of this one, and inverse of it.
    pub(super) length: Lanes,
    pub(super) rate: Lanes,
    /// Length of the kick between the step before and this one, and of the step before.
    pub(super) times: Times<Lanes>,
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
    pub(super) fn advance(&mut self, left: &mut u64) -> LaneMask {
        while *left > 0 {
            *left -= 1;
            let needs_scalar = self.step();
            if needs_scalar.any() {
                return needs_scalar;
            }
        }
        LaneMask::default()
    }

    #[inline(always)]
    fn step(&mut self) -> LaneMask {
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
        let scalars = &self.scalars;
        let before = scalars.time_step;
        let length = choose_time_step(before, scalars.courant * scalars.stable_step);
        Step {
            length,
            rate: length.inverse(),
            times: Times {
                kick: (before + length) * 0.5,
                drift: before,
            },
        }
    }
}
