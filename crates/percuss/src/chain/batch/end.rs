//! The end of a step: `Watch::follow` in every lane, and which lanes the single run has to look at.

use super::{
    bundle::{Back, Bundle},
    step::{Found, Step},
};
use crate::{
    chain::solver::LARGEST_STRAIN_STEP,
    lanes::{LANES, Lanes, larger, smaller},
};

impl Bundle {
    /// Ends the step and finds the lanes that the single run has to look at.
    #[inline(always)]
    pub(super) fn end(&mut self, step: &Step, found: &Found) -> [bool; LANES] {
        let [projectile, target] = self.mesh.elements;
        let back = self.nodes[projectile + 1 + target].position.0;
        let (mut face, mut tail) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            face[l] = self.nodes[self.faces[l]].position.0[l];
            tail[l] = self.nodes[self.tails[l]].velocity.0[l];
        }
        let is_open = self.mesh.back == Back::Open;
        let mut depth = [0.0; LANES];
        let mut calls = [false; LANES];
        let mut may_rest = false;
        let erodes = match found.erodes {
            true => self.eroding(),
            false => [false; LANES],
        };
        let whole = &mut self.whole;
        for l in 0..LANES {
            whole.time_step.0[l] = step.length.0[l];
            whole.time.0[l] += step.length.0[l];
            whole.step.0[l] += 1.0;
            let of_approach = LARGEST_STRAIN_STEP / found.fastest.0[l];
            whole.stable_step.0[l] = smaller(of_approach, found.stable_step.0[l]);
            let drift = back[l] - whole.back_position.0[l];
            depth[l] = if is_open { face[l] - drift } else { face[l] };
            calls[l] = erodes[l]
                | (depth[l] >= whole.perforated.0[l])
                | (whole.time.0[l] >= whole.next_look.0[l])
                | (whole.step.0[l] >= whole.most_steps.0[l]);
            may_rest |= tail[l] < whole.slow_tail.0[l];
        }
        if may_rest {
            let momentum = self.projectile_momentum();
            for l in 0..LANES {
                calls[l] |= (tail[l] < self.whole.slow_tail.0[l]) & (momentum.0[l] <= 0.0);
            }
        }
        let whole = &mut self.whole;
        for l in 0..LANES {
            if calls[l] {
                continue;
            }
            whole.largest_depth.0[l] = larger(depth[l], whole.largest_depth.0[l]);
            whole.peak_force.0[l] = larger(whole.contact_force.0[l], whole.peak_force.0[l]);
            whole.smallest_time_step.0[l] =
                smaller(whole.time_step.0[l], whole.smallest_time_step.0[l]);
            if whole.closed.0[l] > 0.0 {
                whole.contact_time.0[l] += whole.time_step.0[l];
                whole.touched.0[l] = 1.0;
            }
        }
        calls
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
