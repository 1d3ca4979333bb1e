//! Constitutive update of all elements in a step.

use std::ops::Range;

use super::{
    bundle::Bundle,
    flow::{SET_LANES, flow},
    lanes::{LANES, Lanes, smaller},
    step::{Found, Step},
};

impl Bundle {
    /// Updates the elements: first all of them as if elastic, then those that flow. Nothing has to be guessed that way.
    #[inline(always)]
    pub(super) fn update(&mut self, step: &Step) -> Found {
        let mut found = Found {
            stable_step: Lanes::all(0.0),
            fastest: Lanes::all(0.0),
            erodes: false,
        };
        for b in 0..self.bodies.len() {
            let elements = self.mesh.elements_of(b);
            self.respond(b, elements.clone(), &mut found);
            self.flow(b, elements, step);
        }
        found.stable_step = self.stable_step();
        found
    }

    /// Updates the elements of a body as if nothing flowed.
    #[inline(always)]
    fn respond(&mut self, b: usize, elements: Range<usize>, found: &mut Found) {
        let body = self.bodies[b];
        let now = self.now;
        let of_nodes = elements.start + b..elements.end + b + 1;
        let (nodes, moves) = (&self.nodes[of_nodes.clone()], &self.moves[of_nodes]);
        let ends = nodes.iter().zip(&nodes[1..]);
        let ends = ends.zip(moves.iter().zip(&moves[1..]));
        let springs = self.springs[elements.clone()].iter_mut();
        let springs = springs.zip(&mut self.limits[elements.clone()]);
        let mut fastest = found.fastest;
        let mut erodes = false;
        for (((spring, limit), mark), (ends, moves)) in
            springs.zip(&mut self.marks[elements]).zip(ends)
        {
            // Where no wave has come, or border shear holds, nothing changes.
            if !(moves.0 | moves.1) & mark.settled {
                continue;
            }
            let response = spring.respond([ends.0, ends.1], &body, now, fastest);
            *limit = response.limit;
            fastest = response.fastest;
            erodes |= response.erodes;
            mark.settled = !(response.changes | response.flows | mark.flowed);
            mark.flows = response.flows;
        }
        found.fastest = fastest;
        found.erodes |= erodes;
    }

    /// Lets the elements of a body flow that are beyond the yield surface.
    #[inline(always)]
    fn flow(&mut self, b: usize, elements: Range<usize>, step: &Step) {
        let body = self.bodies[b];
        let now = self.now;
        let (mut working, mut flowing) = (0, 0);
        for e in elements {
            let mark = &mut self.marks[e];
            if !(mark.flows | mark.flowed) {
                continue;
            }
            mark.flowed = mark.flows;
            self.working[working] = e;
            working += 1;
            self.flows[e].step_before = self.flows[e].plastic_step;
            self.flows[e].plastic_step = Lanes::all(0.0);
            if !mark.flows {
                continue;
            }
            let ends = [&self.nodes[e + b], &self.nodes[e + b + 1]];
            let lanes = self.springs[e].flowing(ends, now);
            let places = SET_LANES[usize::from(lanes)].map(|lane| (e as u32, lane));
            self.flowing[flowing..flowing + LANES].copy_from_slice(&places);
            flowing += lanes.count_ones() as usize;
        }
        let chain = (&mut self.springs[..], &mut self.flows[..], &self.nodes[b..]);
        flow(&mut self.flowing, flowing, chain, &body, &step.rate, now);
        let mut work = self.whole.plastic_work[b];
        let mut done = Lanes::all(0.0);
        for &e in &self.working[..working] {
            let ends = [&self.nodes[e + b], &self.nodes[e + b + 1]];
            self.limits[e] = self.springs[e].settle(&self.flows[e], ends, &body, now, &mut done);
        }
        for l in 0..LANES {
            work.0[l] += done.0[l];
        }
        self.whole.plastic_work[b] = work;
    }

    /// Largest time step that is stable for all elements.
    #[inline(always)]
    fn stable_step(&self) -> Lanes {
        let mut least = Lanes::all(f64::INFINITY);
        for limit in &self.limits {
            for l in 0..LANES {
                least.0[l] = smaller(limit.0[l], least.0[l]);
            }
        }
        least
    }
}
