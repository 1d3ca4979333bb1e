//! The way of the nodes in a step, and what it does to the elements.

use std::ops::Range;

use pulp::{Arch, NullaryFnOnce};

use super::{
    element::approach_rate,
    flow::{FlowConstants, FlowingElements},
    part::Section,
    penetration::Limit,
    solver::{StepControl, strain_limited_step},
    state::{Element, Node, Nodes, Segment, State},
};
use crate::{
    error::NumericalError,
    lanes::{
        LANES, LaneFlags, Lanes, PerLane, any, blocks_of, flags, lanes, larger, load, settled,
        smaller,
    },
    material::{LaneLaw, LaneStrength, LawVisitor},
    options::Kinematics,
    power::log_ratio,
};

#[cfg(test)]
#[path = "drift_tests.rs"]
mod tests;

/// A drift, compiled once for every instruction set.
struct Drift<'a> {
    state: &'a mut State,
    control: &'a StepControl,
    time_step: f64,
}

impl NullaryFnOnce for Drift<'_> {
    type Output = Result<f64, NumericalError>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        self.state.drift_here(self.control, self.time_step)
    }
}

/// What sets the next time step.
struct Found {
    stable_step: f64,
    /// Largest rate at which the ends of an element approach or part, as a part of its length [1/s].
    fastest: f64,
    largest_strain: f64,
}

impl Found {
    /// A stable time step of an element.
    #[inline(always)]
    fn allow(&mut self, time_step: f64) {
        if time_step < self.stable_step {
            self.stable_step = time_step;
        }
    }

    /// A rate at which its ends approach or part.
    #[inline(always)]
    fn approaches(&mut self, rate: f64) {
        if rate > self.fastest {
            self.fastest = rate;
        }
    }

    #[inline(always)]
    fn strains(&mut self, strain: f64) {
        if strain.abs() > self.largest_strain {
            self.largest_strain = strain.abs();
        }
    }
}

/// Eight numbers of a list from a place on, or those that there are, and zeros.
#[inline(always)]
fn eight(all: &[f64], first: usize) -> Lanes {
    if first + LANES <= all.len() {
        return load(all, first);
    }
    let mut numbers = Lanes::all(0.0);
    let rest = &all[first.min(all.len())..];
    numbers[..rest.len()].copy_from_slice(rest);
    numbers
}

/// A block with elements that flow, flowed in the last step, or are viscous.
#[derive(Debug, Clone, Copy)]
pub(super) struct WorkingBlock {
    block: usize,
    /// Its elements of the segment.
    own: LaneFlags,
    /// 1 for those that flow in this step, 0 for others.
    flows: Lanes,
    /// Plastic strains of the last step.
    steps_before: Lanes,
    /// Those that move, or did so in the last step, and the speeds at which their ends approach [m/s].
    awake: LaneFlags,
    approaches: Lanes,
}

impl State {
    /// Moves the nodes and updates every element; gives the largest strain of any.
    pub(super) fn drift(
        &mut self,
        control: &StepControl,
        time_step: f64,
    ) -> Result<f64, NumericalError> {
        Arch::new().dispatch(Drift {
            state: self,
            control,
            time_step,
        })
    }

    #[inline(always)]
    fn drift_here(&mut self, control: &StepControl, time_step: f64) -> Result<f64, NumericalError> {
        let mut found = Found {
            stable_step: f64::INFINITY,
            fastest: 0.0,
            largest_strain: 0.0,
        };
        // Those that belong to no element any more fly on: nothing looks at them.
        let nodes = self.nodes.position.iter_mut().zip(&self.nodes.velocity);
        for (position, velocity) in nodes {
            *position += velocity * time_step;
        }
        let limit = self.penetration_limit();
        for s in 0..self.segments.len() {
            let segment = self.segments[s];
            if let Err(element) = self.drift_segment(segment, control, time_step, limit, &mut found)
            {
                return Err(inverted(self.step, self.time, element));
            }
        }
        self.stable_step = found.stable_step.min(strain_limited_step(found.fastest));
        Ok(found.largest_strain)
    }

    /// Fails with the number of an element that was compressed to nothing.
    #[inline(always)]
    fn drift_segment(
        &mut self,
        segment: Segment,
        control: &StepControl,
        time_step: f64,
        limit: Option<Limit>,
        found: &mut Found,
    ) -> Result<(), usize> {
        let part = &self.parts[segment.part];
        let elements = segment.elements();
        let limit = limit.filter(|limit| limit.element == elements.start);
        // What has a law with known equations is computed side by side.
        let law = part.strength.in_lanes();
        let alone = match law {
            Some(_) => usize::from(limit.is_some()),
            None => elements.len(),
        };
        let mut plastic_work = 0.0;
        for (i, e) in elements.clone().take(alone).enumerate() {
            let drift = ElementDrift {
                ends: [
                    self.nodes.at(e + segment.shift),
                    self.nodes.at(e + segment.shift + 1),
                ],
                part,
                time_step,
                limit: limit.filter(|_| i == 0),
            };
            let work = (self.elements).change(e, |element| drift.alone(element, control, found));
            plastic_work += work.ok_or(e)?;
        }
        let mut drift = SegmentDrift {
            blocks: self.elements.blocks_mut(),
            nodes: &self.nodes,
            shift: segment.shift,
            elements: elements.start + alone..elements.end,
            working: &mut self.working,
            part,
            control,
            time_step,
        };
        match part.kinematics {
            Kinematics::Logarithmic => drift.bear::<false>(found)?,
            Kinematics::SmallStrain => drift.bear::<true>(found)?,
        }
        if let Some(law) = law {
            drift.flow(&law);
        }
        drift.settle(&mut plastic_work, found);
        self.accumulated.plastic[part.role as usize] += plastic_work;
        Ok(())
    }
}

/// An element on its way.
struct ElementDrift<'a> {
    ends: [Node; 2],
    part: &'a Section,
    time_step: f64,
    limit: Option<Limit>,
}

impl ElementDrift<'_> {
    /// Brings it to where its ends are and returns its plastic work [J]; `None` when it is compressed to nothing.
    #[inline(always)]
    fn alone(
        &self,
        element: &mut Element,
        control: &StepControl,
        found: &mut Found,
    ) -> Option<f64> {
        let (part, [back, front]) = (self.part, self.ends);
        if back.velocity == 0.0 && front.velocity == 0.0 && element.is_settled() {
            // Where no wave has come, or border shear holds, nothing changes.
            found.strains(element.strain);
            found.allow(element.stable_step(part));
            return Some(0.0);
        }
        let distance = front.position - back.position;
        let mut work = 0.0;
        if let Some(limit) = self.limit {
            work += element.penetrate(part, distance, self.time_step, limit);
        }
        let length = distance + element.advance;
        if length <= 0.0 {
            return None;
        }
        let approach = back.velocity - front.velocity - element.advance_step / self.time_step;
        if part.kinematics == Kinematics::Logarithmic {
            found.approaches(approach_rate(approach, length));
        }
        work += element.volume * element.deform(part, length, self.time_step);
        found.strains(element.strain);
        let mut stable = element.stable_step(part);
        if control.is_viscous() {
            stable *= control.damp(element, part, approach);
        }
        found.allow(stable);
        Some(work)
    }
}

/// Elements of a segment on their way, eight at a time, by the equations of one.
struct SegmentDrift<'a> {
    blocks: &'a mut [Element<Lanes>],
    nodes: &'a Nodes,
    /// Number of a node less that of the element in front of it.
    shift: usize,
    elements: Range<usize>,
    working: &'a mut Vec<WorkingBlock>,
    part: &'a Section,
    control: &'a StepControl,
    time_step: f64,
}

impl SegmentDrift<'_> {
    /// Brings the elements to where their ends are, as if nothing flowed. Fails with the number of one that is compressed to nothing.
    #[inline(always)]
    fn bear<const SMALL_STRAIN: bool>(&mut self, found: &mut Found) -> Result<(), usize> {
        self.working.clear();
        let part = self.part;
        let mut fastest = Lanes::all(0.0);
        let mut largest_strain = Lanes::all(0.0);
        let mut longest_step = Lanes::all(f64::INFINITY);
        for (b, own) in blocks_of(self.elements.clone()) {
            let block = &mut self.blocks[b];
            let first = b * LANES + self.shift;
            let from = eight(&self.nodes.velocity, first);
            let to = eight(&self.nodes.velocity, first + 1);
            let moves = |l: usize| (from[l] != 0.0) | (to[l] != 0.0);
            let is_awake = |l: usize| own.0[l] & (moves(l) | !block.lane(l).is_settled());
            let awake = flags(is_awake);
            if !any(&awake) {
                // Where no wave has come, or border shear holds, nothing changes.
                let stable = stable_steps(block, part);
                for l in 0..LANES {
                    let stable = if own.0[l] { stable[l] } else { f64::INFINITY };
                    longest_step[l] = smaller(stable, longest_step[l]);
                    let strain = if own.0[l] { block.strain[l].abs() } else { 0.0 };
                    largest_strain[l] = larger(strain, largest_strain[l]);
                }
                continue;
            }
            let back = eight(&self.nodes.position, first);
            let front = eight(&self.nodes.position, first + 1);
            let (before, axial) = (block.spring, block.plastic.axial);
            let (advance, advance_step) = (block.advance, block.advance_step);
            let (volume, elastic_to) = (block.volume, block.yield_point.elastic_to());
            let steps_before = block.plastic.step;
            let (rest_length, rest_area) = (block.rest_length, block.rest_area);
            let mut borne = Borne::<Lanes>::default();
            for l in 0..LANES {
                let length = front[l] - back[l] + advance[l];
                let closing = from[l] - to[l];
                let mut spring = before.lane(l);
                let elastic = if SMALL_STRAIN {
                    (rest_length[l] - length) / rest_length[l] - axial[l]
                } else {
                    log_ratio(spring.unloaded_length, length)
                };
                spring.bear(part.modulus * elastic);
                let [force, stable] = if SMALL_STRAIN {
                    [spring.stress * rest_area[l], rest_length[l] * part.slowness]
                } else {
                    let stable = spring.stable_step(length, part.compliance, part.slowness);
                    [spring.force(volume[l], length), stable]
                };
                let approach = closing - advance_step[l] / self.time_step;
                let rate = if SMALL_STRAIN {
                    0.0
                } else {
                    approach_rate(approach, length)
                };
                let flows = own.0[l] & (spring.stress.abs() > elastic_to[l]);
                let one = Borne {
                    length,
                    strain: axial[l] + elastic,
                    stress: spring.stress,
                    force,
                    approach,
                    flows: if flows { 1.0 } else { 0.0 },
                    works: if flows | (own.0[l] & (steps_before[l] != 0.0)) {
                        1.0
                    } else {
                        0.0
                    },
                    inverted: if own.0[l] & (length <= 0.0) { 1.0 } else { 0.0 },
                    rate: if own.0[l] { rate } else { 0.0 },
                    stable: if own.0[l] { stable } else { f64::INFINITY },
                };
                borne.set_lane(l, one);
            }
            let borne = settled(borne);
            if any(&borne.inverted) {
                let inverted = (0..LANES).find(|&l| borne.inverted[l] > 0.0);
                return Err(b * LANES + inverted.unwrap_or(0));
            }
            for l in 0..LANES {
                let own = own.0[l];
                let [length, strain] = [block.length[l], block.strain[l]];
                block.length.choose(l, own, borne.length[l], length);
                block.strain.choose(l, own, borne.strain[l], strain);
                let [force, step] = [block.axial_force[l], steps_before[l]];
                block.axial_force.choose(l, own, borne.force[l], force);
                block.plastic.step.choose(l, own, 0.0, step);
                let [stress, last] = [before.stress[l], before.stress_before[l]];
                block.spring.stress.choose(l, own, borne.stress[l], stress);
                block.spring.stress_before.choose(l, own, stress, last);
                fastest[l] = larger(borne.rate[l], fastest[l]);
                let strain = if own { borne.strain[l].abs() } else { 0.0 };
                largest_strain[l] = larger(strain, largest_strain[l]);
            }
            if any(&borne.works) || self.control.is_viscous() {
                self.working.push(WorkingBlock {
                    block: b,
                    own,
                    flows: borne.flows,
                    steps_before,
                    awake: LaneFlags(awake.map(|awake| awake > 0.0)),
                    approaches: borne.approach,
                });
                continue;
            }
            for l in 0..LANES {
                longest_step[l] = smaller(borne.stable[l], longest_step[l]);
            }
        }
        for l in 0..LANES {
            found.approaches(fastest[l]);
            found.strains(largest_strain[l]);
            found.allow(longest_step[l]);
        }
        Ok(())
    }

    /// Lets those elements flow that do.
    #[inline(always)]
    fn flow(&mut self, law: &LaneLaw) {
        if self.working.iter().any(|working| any(&working.flows)) {
            law.visit(FlowTogether {
                blocks: &mut *self.blocks,
                working: &*self.working,
                part: self.part,
                time_step: self.time_step,
            });
        }
    }

    /// Settles the blocks in which something flows, flowed in the last step, or is viscous.
    #[inline(always)]
    fn settle(&mut self, plastic_work: &mut f64, found: &mut Found) {
        let (part, is_viscous) = (self.part, self.control.is_viscous());
        for working in &*self.working {
            let (block, own) = (&mut self.blocks[working.block], working.own);
            let (spring, volume, length) = (block.spring, block.volume, block.length);
            let steps = block.plastic.step;
            let mut work = Lanes::all(0.0);
            for l in 0..LANES {
                let (one, before) = (spring.lane(l), block.axial_force[l]);
                let force = match part.kinematics {
                    Kinematics::Logarithmic => one.force(volume[l], length[l]),
                    Kinematics::SmallStrain => one.stress * block.rest_area[l],
                };
                block.axial_force.choose(l, own.0[l], force, before);
                let done = volume[l] * one.plastic_work(working.steps_before[l], steps[l]);
                work[l] = if own.0[l] { done } else { 0.0 };
            }
            let mut stable = stable_steps(block, part);
            if is_viscous {
                for l in (0..LANES).filter(|l| working.awake.0[*l]) {
                    let mut one = block.lane(l);
                    stable[l] *= self.control.damp(&mut one, part, working.approaches[l]);
                    block.viscous_force[l] = one.viscous_force;
                }
            }
            for l in 0..LANES {
                *plastic_work += work[l];
                found.allow(if own.0[l] { stable[l] } else { f64::INFINITY });
            }
        }
    }
}

percuss_core::per_lane! {
    /// An element at a new length, as if nothing flowed.
    #[derive(Debug, Clone, Copy, Default)]
    struct Borne<R = f64> {
        length: R,
        strain: R,
        stress: R,
        force: R,
        /// 1 where it flows, where it does or did so in the last step, and where it is compressed to nothing; 0 elsewhere.
        flows: R,
        works: R,
        inverted: R,
        /// Speed at which its ends approach [m/s].
        approach: R,
        /// Speed at which they approach or part, as a part of its length [1/s].
        rate: R,
        /// Stable time step [s].
        stable: R,
    }
}

/// Stable time steps of the elements of a block, without viscosity [s].
#[inline(always)]
fn stable_steps(block: &Element<Lanes>, part: &Section) -> Lanes {
    let (spring, length, rest_length) = (block.spring, block.length, block.rest_length);
    match part.kinematics {
        Kinematics::Logarithmic => {
            lanes(|l| (spring.lane(l)).stable_step(length[l], part.compliance, part.slowness))
        }
        Kinematics::SmallStrain => lanes(|l| rest_length[l] * part.slowness),
    }
}

/// Lets those elements flow that do.
pub(super) struct FlowTogether<'a> {
    blocks: &'a mut [Element<Lanes>],
    working: &'a [WorkingBlock],
    part: &'a Section,
    time_step: f64,
}

impl LawVisitor<f64> for FlowTogether<'_> {
    type Output = ();

    #[inline(always)]
    fn visit<L>(self, law: &L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let mut constants = FlowConstants::<Lanes>::default();
        for l in 0..LANES {
            constants.set_lane(l, FlowConstants::of(self.part));
        }
        for working in self.working {
            if !any(&working.flows) {
                continue;
            }
            let block = &mut self.blocks[working.block];
            let mut flowing = FlowingElements {
                spring: block.spring,
                plastic: block.plastic,
                points: block.yield_point,
                per_time: Lanes::all(1.0 / self.time_step),
            };
            flowing.flow(law, &constants, &working.flows);
            block.spring = flowing.spring;
            block.plastic = flowing.plastic;
            block.yield_point = flowing.points;
        }
    }
}

fn inverted(step: u64, time: f64, element: usize) -> NumericalError {
    NumericalError {
        what: "an element was compressed to nothing".to_owned(),
        step,
        time_us: time * 1e6,
        element: Some(element),
        remedy: "use logarithmic kinematics, or lower `chain.courant` or `chain.erosion_strain`"
            .to_owned(),
    }
}
