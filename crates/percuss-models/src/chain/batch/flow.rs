//! Flow of elements where they are, or gathered from all lanes.

use super::{bundle::Bundle, step::Step};
use crate::{
    chain::flow::{FlowConstants, FlowingElements},
    lanes::{LANES, Lanes, PerLane},
    material::LaneStrength,
};

impl Bundle {
    /// Lets an element of a body flow in those lanes that have a 1.
    #[inline(always)]
    pub(super) fn flow_in_place<L>(
        &mut self,
        law: &L,
        [b, e]: [usize; 2],
        lanes: &Lanes,
        step: &Step,
    ) where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let mut flowing = FlowingElements {
            spring: self.springs[e],
            plastic: self.plastics[e],
            points: self.points[e],
            per_time: step.rate,
        };
        flowing.flow(law, &self.bodies[b].flow, lanes);
        self.springs[e] = flowing.spring;
        self.plastics[e] = flowing.plastic;
        self.points[e] = flowing.points;
    }

    /// Lets elements of a body flow in single lanes, eight such places at a time.
    ///
    /// Room for eight more places than `count` lets the last one stand in for those that are missing.
    #[inline(always)]
    pub(super) fn flow_gathered<L>(&mut self, law: &L, b: usize, count: usize, step: &Step)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        if count == 0 {
            return;
        }
        let last = self.gathered[count - 1];
        self.gathered[count..count + LANES].fill(last);
        for first in (0..count).step_by(LANES) {
            self.flow_eight(law, b, first, step);
        }
    }

    #[inline(always)]
    fn flow_eight<L>(&mut self, law: &L, b: usize, first: usize, step: &Step)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let places = &self.gathered[first..first + LANES];
        let of_body = &self.bodies[b].flow;
        let mut flowing = FlowingElements::default();
        let mut laws = L::default();
        let mut constants = FlowConstants::<Lanes>::default();
        for (p, &(element, lane)) in places.iter().enumerate() {
            let (e, l) = (element as usize, lane as usize % LANES);
            flowing.spring.set_lane(p, self.springs[e].lane(l));
            flowing.plastic.set_lane(p, self.plastics[e].lane(l));
            flowing.points.set_lane(p, self.points[e].lane(l));
            constants.set_lane(p, of_body.lane(l));
            laws.set_lane(p, law.lane(l));
            flowing.per_time.set_lane(p, step.rate.lane(l));
        }
        flowing.flow(&laws, &constants, &Lanes::all(1.0));
        for (p, &(element, lane)) in places.iter().enumerate() {
            let (e, l) = (element as usize, lane as usize % LANES);
            self.springs[e].set_lane(l, flowing.spring.lane(p));
            self.plastics[e].set_lane(l, flowing.plastic.lane(p));
            self.points[e].set_lane(l, flowing.points.lane(p));
        }
    }
}
