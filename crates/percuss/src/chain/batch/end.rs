//! The end of a step: `RunMonitor::follow` in every lane, and which lanes the single run has to look at.

use super::{
    bundle::{Back, Bundle},
    step::{Step, StepEstimate},
};
use crate::{
    chain::solver::strain_limited_step,
    lanes::{LaneMask, Lanes, Mask, Real, lanes, larger, smaller},
};

impl Bundle {
    /// Ends the step and finds the lanes that the single run has to look at.
    #[inline(always)]
    pub(super) fn end(&mut self, step: &Step, estimate: &StepEstimate) -> LaneMask {
        let [projectile, target] = self.mesh.elements;
        let mut depth = lanes(|l| self.nodes[self.faces[l]].position.0[l]);
        let tail = lanes(|l| self.nodes[self.tails[l]].velocity.0[l]);
        if self.mesh.back == Back::Open {
            let back = self.nodes[projectile + 1 + target].position;
            depth -= back - self.scalars.back_position;
        }
        let scalars = &mut self.scalars;
        scalars.time_step = step.length;
        scalars.time += step.length;
        scalars.step += Lanes::all(1.0);
        scalars.stable_step = smaller(strain_limited_step(estimate.fastest), estimate.stable_step);
        let mut needs_scalar = depth.at_least(scalars.perforated)
            | scalars.time.at_least(scalars.next_check)
            | scalars.step.at_least(scalars.most_steps);
        let slows = tail.below(scalars.slow_tail);
        if estimate.erodes {
            needs_scalar = needs_scalar | self.eroding();
        }
        if slows.any() {
            let momentum = self.projectile_momentum();
            needs_scalar = needs_scalar | slows & momentum.at_most(Lanes::all(0.0));
        }
        self.monitor(depth, !needs_scalar);
        needs_scalar
    }

    /// Includes the step in the extremes of some lanes; the single run does so in the others.
    #[inline(always)]
    fn monitor(&mut self, depth: Lanes, lanes: LaneMask) {
        let scalars = &mut self.scalars;
        let follow = |of: &mut Lanes, next: Lanes| *of = Lanes::select(lanes, next, *of);
        let depth = larger(depth, scalars.largest_depth);
        let force = larger(scalars.contact_force, scalars.peak_force);
        let time_step = smaller(scalars.time_step, scalars.smallest_time_step);
        let touching = Lanes::select(scalars.closed, scalars.time_step, Lanes::all(0.0));
        let contact_time = scalars.contact_time + touching;
        follow(&mut scalars.largest_depth, depth);
        follow(&mut scalars.peak_force, force);
        follow(&mut scalars.smallest_time_step, time_step);
        follow(&mut scalars.contact_time, contact_time);
        scalars.touched = scalars.touched | (scalars.closed & lanes);
    }

    /// Lanes in which an element is about to erode.
    #[cold]
    #[inline(never)]
    fn eroding(&self) -> LaneMask {
        let mut erodes = LaneMask::default();
        for (b, body) in self.bodies.iter().enumerate() {
            for e in self.mesh.elements_of(b) {
                let length = self.nodes[e + b + 1].position - self.nodes[e + b].position;
                let is_close = length.at_most(body.shortest) | length.at_least(body.longest);
                erodes = erodes | is_close & !LaneMask::of_bits(self.marks[e].gone);
            }
        }
        erodes
    }

    /// Momentum of the projectile.
    #[inline(always)]
    fn projectile_momentum(&self) -> Lanes {
        let count = self.mesh.elements[0];
        let mut sum = Lanes::all(0.0);
        for (node, &mass) in self.nodes[..=count].iter().zip(&self.masses) {
            sum += mass * node.velocity;
        }
        sum
    }
}
