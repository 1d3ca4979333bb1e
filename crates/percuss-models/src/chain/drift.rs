//! The way of the nodes in a step, and what it does to the elements.

use pulp::{Arch, NullaryFnOnce};

use super::{
    element::approach_rate,
    flow::{FlowConstants, FlowingElements},
    part::Section,
    penetration::Limit,
    solver::{StepControl, strain_limited_step},
    state::{Element, Segment, State},
};
use crate::{
    error::NumericalError,
    lanes::{LANES, Lanes, PerLane},
    material::{LaneStrength, LawVisitor},
    options::Kinematics,
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
    type Output = Result<(), NumericalError>;

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
}

/// An element that flows, or flowed in the last step.
#[derive(Debug, Clone, Copy)]
pub(super) struct YieldingElement {
    /// Its place in its segment.
    element: usize,
    /// Plastic strain of the last step.
    step_before: f64,
    /// Whether it flows in this one.
    flows: bool,
}

impl State {
    /// Moves the nodes and updates every element.
    pub(super) fn drift(
        &mut self,
        control: &StepControl,
        time_step: f64,
    ) -> Result<(), NumericalError> {
        Arch::new().dispatch(Drift {
            state: self,
            control,
            time_step,
        })
    }

    #[inline(always)]
    fn drift_here(&mut self, control: &StepControl, time_step: f64) -> Result<(), NumericalError> {
        let mut found = Found {
            stable_step: f64::INFINITY,
            fastest: 0.0,
        };
        let limit = self.penetration_limit();
        for s in 0..self.segments.len() {
            let segment = self.segments[s];
            if let Err(element) = self.drift_segment(segment, control, time_step, limit, &mut found)
            {
                return Err(inverted(self.step, self.time, element));
            }
        }
        self.stable_step = found.stable_step.min(strain_limited_step(found.fastest));
        Ok(())
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
        let is_logarithmic = part.kinematics == Kinematics::Logarithmic;
        let is_viscous = control.is_viscous();
        let first_element = segment.elements().start;
        let limit = limit.filter(|limit| segment.elements().contains(&limit.element));
        // What flows by a law with known equations waits until it can do so side by side, in logarithmic strain.
        let law = part.strength.in_lanes();
        let law = law.filter(|_| is_logarithmic && !is_viscous && limit.is_none());
        let mut plastic_work = 0.0;
        let working = &mut self.working;
        working.clear();
        let nodes = &mut self.nodes[segment.first_node..=segment.last_node];
        let elements = &mut self.elements[segment.elements()];
        let Some((first, others)) = nodes.split_first_mut() else {
            return Ok(());
        };
        first.position += first.velocity * time_step;
        let (mut position, mut velocity) = (first.position, first.velocity);
        for (i, (element, node)) in elements.iter_mut().zip(others).enumerate() {
            node.position += node.velocity * time_step;
            let distance = node.position - position;
            let held = velocity == 0.0 && node.velocity == 0.0;
            let closing = velocity - node.velocity;
            (position, velocity) = (node.position, node.velocity);
            if held && element.is_settled() {
                // Where no wave has come, or border shear holds, nothing changes.
                found.allow(element.stable_step(part));
                continue;
            }
            if let Some(limit) = limit.filter(|limit| limit.element == first_element + i) {
                plastic_work += element.penetrate(part, distance, time_step, limit);
            }
            let length = distance + element.advance;
            if length <= 0.0 {
                return Err(first_element + i);
            }
            // Only the mouth of a cone advances, and a division takes long.
            let approach = match element.advance_step {
                0.0 => closing,
                advance => closing - advance / time_step,
            };
            if is_logarithmic {
                found.approaches(approach_rate(approach, length));
            }
            let step_before = element.stretch(part, length);
            let flows = !element.yield_point.holds(element.spring.stress.abs());
            if law.is_some() && (flows || step_before != 0.0) {
                working.push(YieldingElement {
                    element: i,
                    step_before,
                    flows,
                });
                continue;
            }
            if flows {
                element.flow(part, time_step);
            }
            plastic_work += element.volume * element.settle(part, step_before);
            let mut limit = element.stable_step(part);
            if is_viscous {
                limit *= control.damp(element, part, approach);
            }
            found.allow(limit);
        }
        if let Some(law) = law.filter(|_| working.iter().any(|working| working.flows)) {
            law.visit(FlowTogether {
                elements: &mut *elements,
                working: &*working,
                part,
                time_step,
            });
        }
        for working in working {
            let element = &mut elements[working.element];
            plastic_work += element.volume * element.settle(part, working.step_before);
            found.allow(element.stable_step(part));
        }
        self.accumulated.plastic[part.role as usize] += plastic_work;
        Ok(())
    }
}

/// Lets those elements flow that do.
pub(super) struct FlowTogether<'a> {
    elements: &'a mut [Element],
    working: &'a [YieldingElement],
    part: &'a Section,
    time_step: f64,
}

impl LawVisitor<f64> for FlowTogether<'_> {
    type Output = ();

    #[inline(always)]
    fn visit<L>(mut self, law: &L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        self.flow(*law);
    }
}

impl FlowTogether<'_> {
    #[inline(always)]
    fn flow<L>(&mut self, law: L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let working = self.working;
        let mut waiting = working.iter().filter(|working| working.flows);
        loop {
            let mut places = [0; LANES];
            let mut count = 0;
            while count < LANES
                && let Some(working) = waiting.next()
            {
                places[count] = working.element;
                count += 1;
            }
            if count == 0 {
                return;
            }
            let last = places[count - 1];
            places[count..].fill(last);
            self.flow_eight(&places, count, law);
        }
    }

    /// Lets elements flow side by side: of the places, so many count.
    #[inline(always)]
    fn flow_eight<L>(&mut self, places: &[usize; LANES], count: usize, law: L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let Self { elements, part, .. } = self;
        let mut flowing = FlowingElements {
            law,
            per_time: Lanes::all(1.0 / self.time_step),
            ..FlowingElements::default()
        };
        let constants = FlowConstants::of(part);
        for (p, &place) in places.iter().enumerate() {
            let element = &elements[place];
            flowing.constants.set_lane(p, constants);
            flowing.spring.set_lane(p, element.spring);
            flowing.plastic.set_lane(p, element.plastic);
            flowing.points.set_lane(p, element.yield_point);
        }
        flowing.flow(&Lanes::all(1.0));
        for (p, &place) in places[..count].iter().enumerate() {
            let element = &mut elements[place];
            element.spring = flowing.spring.lane(p);
            element.plastic = flowing.plastic.lane(p);
            element.yield_point = flowing.points.lane(p);
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
