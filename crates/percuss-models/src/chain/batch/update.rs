//! Constitutive update of all elements in a step.

use std::ops::Range;

use super::{
    bundle::{Bundle, LIMITS_AT_ONCE},
    flow::{flow_gathered, flow_in_place},
    interfaces::Interface,
    step::{Step, StepEstimate},
};
use crate::lanes::{LANES, Lanes, larger, smaller};

/// The lanes whose bits are set in a number, and after them others.
const SET_LANES: [[u32; LANES]; 256] = {
    let mut table = [[0; LANES]; 256];
    let mut bits = 0;
    while bits < 256 {
        let (mut count, mut lane) = (0, 0);
        while lane < LANES {
            if bits >> lane & 1 == 1 {
                table[bits][count] = lane as u32;
                count += 1;
            }
            lane += 1;
        }
        bits += 1;
    }
    table
};

/// Lanes from which it is cheaper to let an element flow where it is than to gather what flows from several elements.
const MANY: u32 = 3;

impl Bundle {
    /// Updates the elements: first all of them as if elastic, then those that flow. Nothing has to be guessed that way.
    #[inline(always)]
    pub(super) fn update(&mut self, step: &Step) -> StepEstimate {
        let mut estimate = StepEstimate {
            stable_step: Lanes::all(0.0),
            fastest: Lanes::all(0.0),
            erodes: false,
        };
        for b in 0..self.bodies.len() {
            let elements = self.mesh.elements_of(b);
            let working = self.respond(b, elements, &mut estimate);
            self.flow(b, working, step);
        }
        estimate.stable_step = self.stable_step();
        estimate
    }

    /// Updates the elements of a body as if nothing flowed; returns how many flow, or flowed in the last step.
    #[inline(always)]
    fn respond(&mut self, b: usize, elements: Range<usize>, estimate: &mut StepEstimate) -> usize {
        let body = self.bodies[b].elastic();
        let now = self.now;
        let of_nodes = elements.start + b..elements.end + b + 1;
        let (nodes, moves) = (&self.nodes[of_nodes.clone()], &self.moves[of_nodes]);
        let ends = nodes.iter().zip(&nodes[1..]);
        let ends = ends.zip(moves.iter().zip(&moves[1..]));
        let springs = self.springs[elements.clone()].iter_mut();
        let springs = springs.zip(&mut self.limits[elements.clone()]);
        let mut fastest = estimate.fastest;
        let mut erodes = false;
        let mut working = 0;
        for (e, (((spring, limit), mark), (ends, moves))) in elements
            .clone()
            .zip(springs.zip(&mut self.marks[elements.clone()]).zip(ends))
        {
            // Where no wave has come, or border shear holds, nothing changes.
            if !(moves.0 | moves.1) & mark.settled {
                continue;
            }
            let ends = [ends.0, ends.1];
            let response = match mark.gone {
                0 => spring.respond::<false>(ends, &body, now, 0),
                gone => spring.respond::<true>(ends, &body, now, gone),
            };
            *limit = response.limit;
            for l in 0..LANES {
                fastest.0[l] = larger(response.approach.0[l], fastest.0[l]);
            }
            erodes |= response.erodes;
            let works = response.flows | mark.flowed;
            mark.settled = !(response.changes | works);
            mark.flowed = response.flows;
            self.working[working] = e;
            working += usize::from(works);
        }
        estimate.fastest = fastest;
        estimate.erodes |= erodes;
        working
    }

    /// Lets the elements of a body flow that are beyond the yield surface, and settles those that flowed in the last step.
    #[inline(always)]
    fn flow(&mut self, b: usize, working: usize, step: &Step) {
        if working == 0 {
            return;
        }
        let body = &self.bodies[b];
        let now = self.now;
        let mut gathered = 0;
        for &e in &self.working[..working] {
            let flow = &mut self.flows[e];
            flow.step_before = flow.plastic_step;
            flow.plastic_step = Lanes::all(0.0);
            if !self.marks[e].flowed {
                continue;
            }
            let ends = [&self.nodes[e + b], &self.nodes[e + b + 1]];
            let spring = &mut self.springs[e];
            let lanes = spring.flowing(ends, now) & !self.marks[e].gone;
            if lanes.count_ones() >= MANY {
                flow_in_place(lanes, (spring, flow), ends, body, &step.rate, now);
            } else {
                let places = SET_LANES[usize::from(lanes)].map(|lane| (e as u32, lane));
                self.gathered[gathered..gathered + LANES].copy_from_slice(&places);
                gathered += lanes.count_ones() as usize;
            }
        }
        let chain = (&mut self.springs[..], &mut self.flows[..], &self.nodes[b..]);
        flow_gathered(&mut self.gathered, gathered, chain, body, &step.rate, now);
        let elastic = body.elastic();
        let mut work = Lanes::all(0.0);
        let total = &mut self.scalars.plastic_work[b];
        let of_body = |interface: &&Interface| self.mesh.holds(b, interface.ahead);
        let mut interfaces = self.interfaces.iter().filter(of_body).peekable();
        for &e in &self.working[..working] {
            // The work of every piece is a sum of its own.
            while let Some(interface) = interfaces.next_if(|interface| interface.ahead <= e + b) {
                let l = interface.lane;
                total.0[l] += work.0[l];
                work.0[l] = 0.0;
            }
            let ends = [&self.nodes[e + b], &self.nodes[e + b + 1]];
            let flow = &self.flows[e];
            let spring = &mut self.springs[e];
            let mut limit = spring.settle(flow, ends, &elastic, now, &mut work);
            if self.marks[e].gone != 0 {
                spring.part(&mut limit, self.marks[e].gone);
            }
            self.limits[e] = limit;
        }
        for l in 0..LANES {
            total.0[l] += work.0[l];
        }
    }

    /// Largest time step that is stable for all elements.
    #[inline(always)]
    fn stable_step(&self) -> Lanes {
        // Several at once: none waits for the one before it.
        let [mut a, mut b, mut c, mut d] = [Lanes::all(f64::INFINITY); LIMITS_AT_ONCE];
        for limits in self.limits.chunks_exact(LIMITS_AT_ONCE) {
            for l in 0..LANES {
                a.0[l] = smaller(limits[0].0[l], a.0[l]);
                b.0[l] = smaller(limits[1].0[l], b.0[l]);
                c.0[l] = smaller(limits[2].0[l], c.0[l]);
                d.0[l] = smaller(limits[3].0[l], d.0[l]);
            }
        }
        for l in 0..LANES {
            a.0[l] = smaller(smaller(a.0[l], b.0[l]), smaller(c.0[l], d.0[l]));
        }
        a
    }
}
