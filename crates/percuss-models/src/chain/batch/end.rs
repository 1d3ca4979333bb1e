//! The end of a step: `RunMonitor::follow` in every lane, and which lanes the single run has to look at.

use super::{
    bundle::Bundle,
    step::{Step, StepEstimate},
};
use crate::{
    chain::solver::strain_limited_step,
    lanes::{LANES, Lanes, larger, smaller},
    problem::RearFaceCondition,
};

impl Bundle {
    /// Ends the step and finds the lanes that the single run has to look at.
    #[inline(always)]
    pub(super) fn end(&mut self, step: &Step, estimate: &StepEstimate) -> [bool; LANES] {
        let [projectile, target] = self.mesh.elements;
        let back = self.nodes[projectile + 1 + target].position.0;
        let (mut face, mut tail) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            face[l] = self.nodes[self.contacts[l][1]].position.0[l];
            tail[l] = self.nodes[self.tails[l]].velocity.0[l];
        }
        let is_open = self.mesh.back == RearFaceCondition::NonReflecting;
        let mut depth = [0.0; LANES];
        let mut needs_scalar = [false; LANES];
        let mut may_rest = false;
        let erodes = match estimate.erodes {
            true => self.eroding(),
            false => [false; LANES],
        };
        let scalars = &mut self.scalars;
        for l in 0..LANES {
            scalars.time_step.0[l] = step.length.0[l];
            scalars.time.0[l] += step.length.0[l];
            scalars.step.0[l] += 1.0;
            let of_approach = strain_limited_step(estimate.fastest.0[l]);
            scalars.stable_step.0[l] = smaller(of_approach, estimate.stable_step.0[l]);
            let drift = back[l] - scalars.back_position.0[l];
            depth[l] = if is_open { face[l] - drift } else { face[l] };
            needs_scalar[l] = erodes[l]
                | (depth[l] >= scalars.perforated.0[l])
                | (scalars.time.0[l] >= scalars.next_check.0[l])
                | (scalars.step.0[l] >= scalars.most_steps.0[l]);
            may_rest |= tail[l] < scalars.slow_tail.0[l];
        }
        if may_rest {
            let momentum = self.projectile_momentum();
            for l in 0..LANES {
                needs_scalar[l] |= (tail[l] < self.scalars.slow_tail.0[l]) & (momentum.0[l] <= 0.0);
            }
        }
        let scalars = &mut self.scalars;
        for l in 0..LANES {
            if needs_scalar[l] {
                continue;
            }
            scalars.largest_depth.0[l] = larger(depth[l], scalars.largest_depth.0[l]);
            scalars.peak_force.0[l] = larger(scalars.contact_force.0[l], scalars.peak_force.0[l]);
            scalars.smallest_time_step.0[l] =
                smaller(scalars.time_step.0[l], scalars.smallest_time_step.0[l]);
            if scalars.closed.0[l] {
                scalars.contact_time.0[l] += scalars.time_step.0[l];
                scalars.touched.0[l] = true;
            }
        }
        needs_scalar
    }

    /// Lanes in which an element is about to erode.
    #[cold]
    #[inline(never)]
    fn eroding(&self) -> [bool; LANES] {
        let mut erodes = [false; LANES];
        for (b, body) in self.bodies.iter().enumerate() {
            for e in self.mesh.elements_of(b) {
                let [back, front] = [e + b, e + b + 1].map(|node| self.nodes[node].position.0);
                for l in 0..LANES {
                    let length = front[l] - back[l];
                    let limits = body.shortest.0[l]..body.longest.0[l];
                    let is_here = self.marks[e].gone >> l & 1 == 0;
                    erodes[l] |= is_here & ((length <= limits.start) | (length >= limits.end));
                }
            }
        }
        erodes
    }

    /// Momentum of the projectile.
    #[inline(always)]
    fn projectile_momentum(&self) -> Lanes {
        let count = self.mesh.elements[0];
        let mut sum = Lanes::all(0.0);
        for (node, mass) in self.nodes[..=count].iter().zip(&self.masses) {
            for l in 0..LANES {
                sum.0[l] += mass.0[l] * node.velocity.0[l];
            }
        }
        sum
    }
}
