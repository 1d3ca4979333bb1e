//! Constitutive update of all elements in a step.

use std::ops::Range;

use super::{
    bundle::{Bundle, LIMITS_AT_ONCE},
    interfaces::Interface,
    step::{Step, StepEstimate},
};
use crate::{
    lanes::{LANES, LaneMask, Lanes, Mask, Real, larger, smaller},
    power::small_log_ratio,
};

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
        let body = self.bodies[b];
        let of_nodes = elements.start + b..elements.end + b + 1;
        let (nodes, moves) = (&self.nodes[of_nodes.clone()], &self.moves[of_nodes]);
        let ends = nodes.iter().zip(&nodes[1..]);
        let ends = ends.zip(moves.iter().zip(&moves[1..]));
        let springs = self.springs[elements.clone()].iter_mut();
        let springs = springs.zip(&self.yields[elements.clone()]);
        let marks = self.marks[elements.clone()].iter_mut();
        let marks = marks.zip(&mut self.limits[elements.clone()]);
        let mut fastest = estimate.fastest;
        let mut is_eroding = false;
        let mut working = 0;
        for (e, (((spring, yields), (mark, limit)), (ends, moves))) in
            elements.zip(springs.zip(marks).zip(ends))
        {
            // Where no wave has come, or border shear holds, nothing changes.
            if !(moves.0 | moves.1) & mark.settled {
                continue;
            }
            let length = ends.1.position - ends.0.position;
            let (elastic, is_exact) = small_log_ratio(spring.unloaded_length, length);
            spring.bear(body.law.modulus * elastic);
            let mut flows = spring.stress.size().above(yields.stress) | !is_exact;
            let mut changes = !spring.stress.equals(spring.stress_before);
            let mut erodes = length.at_most(body.shortest) | length.at_least(body.longest);
            spring.push(body.volume, length);
            *limit = spring.stable_step(length, body.compliance, body.slowness);
            let closing = (ends.0.velocity - ends.1.velocity).size();
            let mut approach = closing * length.inverse();
            if mark.gone != 0 {
                let gone = LaneMask::of_bits(mark.gone);
                let zero = Lanes::all(0.0);
                (flows, changes, erodes) = (flows & !gone, changes & !gone, erodes & !gone);
                spring.stress = Lanes::select(gone, zero, spring.stress);
                approach = Lanes::select(gone, zero, approach);
                part(&mut spring.axial_force, limit, gone);
            }
            fastest = larger(approach, fastest);
            is_eroding |= erodes.any();
            let flows = flows.any();
            let works = flows | mark.flowed;
            mark.settled = !(changes.any() | works);
            mark.flowed = flows;
            self.working[working] = e;
            working += usize::from(works);
        }
        estimate.fastest = fastest;
        estimate.erodes |= is_eroding;
        working
    }

    /// Lets the elements of a body flow that are beyond the yield surface, and settles those that flowed in the last step.
    #[inline(always)]
    fn flow(&mut self, b: usize, working: usize, step: &Step) {
        if working == 0 {
            return;
        }
        let mut gathered = 0;
        let mut flowing = self.flowing(b, step.rate);
        for w in 0..working {
            let e = self.working[w];
            let plastic = &mut self.plastics[e];
            self.steps_before[w] = plastic.step;
            plastic.step = Lanes::all(0.0);
            if !self.marks[e].flowed {
                continue;
            }
            let length = self.nodes[e + b + 1].position - self.nodes[e + b].position;
            let spring = &self.springs[e];
            let (_, is_exact) = small_log_ratio(spring.unloaded_length, length);
            let flows = spring.stress.size().above(self.yields[e].stress) | !is_exact;
            let lanes = flows.bits() & !self.marks[e].gone;
            if lanes.count_ones() >= MANY {
                self.flow_in_place(e, lanes, length, &mut flowing);
            } else {
                let places = SET_LANES[usize::from(lanes)].map(|lane| (e as u32, lane));
                self.gathered[gathered..gathered + LANES].copy_from_slice(&places);
                gathered += lanes.count_ones() as usize;
            }
        }
        self.flow_gathered(b, gathered, step);
        self.settle(b, working);
    }

    /// Sets forces and stable steps of elements that flow or flowed, and adds up their plastic work.
    #[inline(always)]
    fn settle(&mut self, b: usize, working: usize) {
        let body = self.bodies[b];
        let mut work = Lanes::all(0.0);
        let total = &mut self.scalars.accumulated.plastic[b];
        let of_body = |interface: &&Interface| self.mesh.holds(b, interface.ahead);
        let mut interfaces = self.interfaces.iter().filter(of_body).peekable();
        for (&e, &step_before) in self.working[..working].iter().zip(&self.steps_before) {
            // The work of every piece is a sum of its own.
            while let Some(interface) = interfaces.next_if(|interface| interface.ahead <= e + b) {
                let l = interface.lane;
                total.0[l] += work.0[l];
                work.0[l] = 0.0;
            }
            let length = self.nodes[e + b + 1].position - self.nodes[e + b].position;
            let (spring, limit) = (&mut self.springs[e], &mut self.limits[e]);
            spring.push(body.volume, length);
            work += body.volume * spring.plastic_work(step_before, self.plastics[e].step);
            *limit = spring.stable_step(length, body.compliance, body.slowness);
            if self.marks[e].gone != 0 {
                let gone = LaneMask::of_bits(self.marks[e].gone);
                part(&mut spring.axial_force, limit, gone);
            }
        }
        *total += work;
    }

    /// Largest time step that is stable for all elements.
    #[inline(always)]
    fn stable_step(&self) -> Lanes {
        // Several at once: none waits for the one before it.
        let mut least = [Lanes::all(f64::INFINITY); LIMITS_AT_ONCE];
        for limits in self.limits.chunks_exact(LIMITS_AT_ONCE) {
            for i in 0..LIMITS_AT_ONCE {
                least[i] = smaller(limits[i], least[i]);
            }
        }
        let [a, b, c, d] = least;
        smaller(smaller(a, b), smaller(c, d))
    }
}

/// Takes the force of an element away in lanes where it has eroded.
#[inline(always)]
fn part(force: &mut Lanes, limit: &mut Lanes, gone: LaneMask) {
    *force = Lanes::select(gone, Lanes::all(0.0), *force);
    *limit = Lanes::select(gone, Lanes::all(f64::INFINITY), *limit);
}
