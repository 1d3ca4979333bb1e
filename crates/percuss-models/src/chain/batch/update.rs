//! Constitutive update of all elements in a step.

use std::ops::Range;

use super::{
    bundle::{Body, Bundle, LIMITS_AT_ONCE, Node},
    interfaces::Interface,
    step::{Step, StepEstimate},
};
use crate::{
    chain::element::{Spring, approach_rate},
    lanes::{LANES, Lanes, PerLane, bits_of, lanes, larger, settled, smaller},
    material::{LaneStrength, LawVisitor},
    power::log_ratio,
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

/// Flow of the elements of a body.
struct Flow<'a> {
    bundle: &'a mut Bundle,
    b: usize,
    working: usize,
    step: &'a Step,
}

impl LawVisitor<Lanes> for Flow<'_> {
    type Output = ();

    #[inline(always)]
    fn visit<L>(self, law: &L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        self.bundle.flow(law, self.b, self.working, self.step);
    }
}

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
            if working > 0 {
                // The laws are apart from what flows by them.
                let laws = std::mem::take(&mut self.laws);
                if let Some(law) = laws.get(b) {
                    law.visit(Flow {
                        bundle: self,
                        b,
                        working,
                        step,
                    });
                }
                self.laws = laws;
            }
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
        let springs = springs.zip(&mut self.forces[elements.clone()]);
        let springs = springs.zip(&self.points[elements.clone()]);
        let marks = self.marks[elements.clone()].iter_mut();
        let marks = marks.zip(&mut self.limits[elements.clone()]);
        let mut fastest = estimate.fastest;
        let mut is_eroding = false;
        let mut working = 0;
        for (e, ((((spring, force), point), (mark, limit)), (ends, moves))) in
            elements.zip(springs.zip(marks).zip(ends))
        {
            // Where no wave has come, or border shear holds, nothing changes.
            if !(moves.0 | moves.1) & mark.settled {
                continue;
            }
            let ends = [ends.0, ends.1];
            let response = match mark.gone {
                0 => respond::<false>(spring, &point.elastic_to(), ends, &body, 0),
                gone => respond::<true>(spring, &point.elastic_to(), ends, &body, gone),
            };
            (*force, *limit) = (response.force, response.limit);
            for l in 0..LANES {
                fastest.0[l] = larger(response.approach.0[l], fastest.0[l]);
            }
            is_eroding |= response.erodes;
            let works = response.flows | mark.flowed;
            mark.settled = !(response.changes | works);
            mark.flowed = response.flows;
            self.working[working] = e;
            working += usize::from(works);
        }
        estimate.fastest = fastest;
        estimate.erodes |= is_eroding;
        working
    }

    /// Lets the elements of a body flow that are beyond the yield surface, and settles those that flowed in the last step.
    #[inline(always)]
    fn flow<L>(&mut self, law: &L, b: usize, working: usize, step: &Step)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let mut gathered = 0;
        for w in 0..working {
            let e = self.working[w];
            let plastic = &mut self.plastics[e];
            self.steps_before[w] = plastic.step;
            plastic.step = Lanes::all(0.0);
            if !self.marks[e].flowed {
                continue;
            }
            let flowing = self.flowing(e);
            let lanes = bits_of(&flowing);
            if lanes.count_ones() >= MANY {
                self.flow_in_place(law, [b, e], &flowing, step);
            } else {
                let places = SET_LANES[usize::from(lanes)].map(|lane| (e as u32, lane));
                self.gathered[gathered..gathered + LANES].copy_from_slice(&places);
                gathered += lanes.count_ones() as usize;
            }
        }
        self.flow_gathered(law, b, gathered, step);
        self.settle(b, working);
    }

    /// 1 in every lane in which an element flows after a response, 0 in the others.
    #[inline(always)]
    fn flowing(&self, e: usize) -> Lanes {
        let elastic_to = self.points[e].elastic_to();
        let stress = self.springs[e].stress;
        let flows = |l: usize| stress[l].abs() > elastic_to[l];
        let mut flowing = settled(lanes(|l| if flows(l) { 1.0 } else { 0.0 }));
        let gone = self.marks[e].gone;
        if gone != 0 {
            for l in (0..LANES).filter(|l| gone >> l & 1 == 1) {
                flowing[l] = 0.0;
            }
        }
        flowing
    }

    /// Sets forces and stable steps of elements that flow or flowed, and adds up their plastic work.
    #[inline(always)]
    fn settle(&mut self, b: usize, working: usize) {
        let body = self.bodies[b];
        let mut work = Lanes::all(0.0);
        let total = &mut self.scalars.accumulated.plastic[b];
        let of_body = |interface: &&Interface| self.mesh.holds(b, interface.ahead);
        let mut interfaces = self.interfaces.iter().filter(of_body).peekable();
        for (&e, step_before) in self.working[..working].iter().zip(&self.steps_before) {
            // The work of every piece is a sum of its own.
            while let Some(interface) = interfaces.next_if(|interface| interface.ahead <= e + b) {
                let l = interface.lane;
                total.0[l] += work.0[l];
                work.0[l] = 0.0;
            }
            let [back, front] = [e + b, e + b + 1].map(|node| self.nodes[node].position.0);
            let (spring, step_before) = (self.springs[e], step_before.0);
            let step = self.plastics[e].step.0;
            let [mut force, mut limit] = [Lanes::all(0.0); 2];
            for l in 0..LANES {
                let (one, length) = (spring.lane(l), front[l] - back[l]);
                force.0[l] = one.force(body.volume.0[l], length);
                work.0[l] += body.volume.0[l] * one.plastic_work(step_before[l], step[l]);
                limit.0[l] = one.stable_step(length, body.compliance.0[l], body.slowness.0[l]);
            }
            let gone = self.marks[e].gone;
            if gone != 0 {
                for l in (0..LANES).filter(|l| gone >> l & 1 == 1) {
                    force.0[l] = 0.0;
                    limit.0[l] = f64::INFINITY;
                }
            }
            (self.forces[e], self.limits[e]) = (force, limit);
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

/// What became of an element.
struct Response {
    force: Lanes,
    /// Largest stable time step where it does not flow.
    limit: Lanes,
    /// Speed at which its ends approach or part, as a part of the length.
    approach: Lanes,
    /// Whether any lane flows.
    flows: bool,
    /// Whether the stress of any lane has changed.
    changes: bool,
    /// Whether it is about to erode in any lane.
    erodes: bool,
}

/// Brings an element to the length that its ends give it, as if nothing flowed; it may have eroded in some lanes.
#[inline(always)]
fn respond<const ERODED: bool>(
    spring: &mut Spring<Lanes>,
    elastic_to: &Lanes,
    [back, front]: [&Node; 2],
    body: &Body<Lanes>,
    gone: u8,
) -> Response {
    let positions = [back.position.0, front.position.0];
    let velocities = [back.velocity.0, front.velocity.0];
    let (before, elastic_to) = (*spring, elastic_to.0);
    let mut after = before;
    let [mut force, mut limit, mut approach] = [Lanes::all(0.0); 3];
    let (mut flows, mut changes, mut erodes) = (false, false, false);
    for l in 0..LANES {
        let is_here = !ERODED || gone >> l & 1 == 0;
        let length = positions[1][l] - positions[0][l];
        let mut one = before.lane(l);
        let elastic = log_ratio(one.unloaded_length, length);
        one.bear(body.flow.modulus.0[l] * elastic);
        flows |= is_here & (one.stress.abs() > elastic_to[l]);
        changes |= is_here & (one.stress != one.stress_before);
        erodes |= is_here & ((length <= body.shortest.0[l]) | (length >= body.longest.0[l]));
        let stable = one.stable_step(length, body.compliance.0[l], body.slowness.0[l]);
        let rate = approach_rate(velocities[0][l] - velocities[1][l], length);
        after.stress_before.0[l] = one.stress_before;
        after.stress.0[l] = if is_here { one.stress } else { 0.0 };
        let pushes = one.force(body.volume.0[l], length);
        force.0[l] = if is_here { pushes } else { 0.0 };
        limit.0[l] = if is_here { stable } else { f64::INFINITY };
        approach.0[l] = if is_here { rate } else { 0.0 };
    }
    spring.stress_before = after.stress_before;
    spring.stress = after.stress;
    Response {
        force,
        limit,
        approach,
        flows,
        changes,
        erodes,
    }
}
