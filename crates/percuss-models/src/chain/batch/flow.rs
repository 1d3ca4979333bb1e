//! Flow of elements where they are, or gathered from all lanes.

use super::{bundle::Bundle, step::Step};
use crate::{
    chain::flow::{FlowingElements, YieldStress},
    lanes::{LANES, PerLane},
};

impl Bundle {
    /// Lets an element of a body flow in those lanes whose bits are set.
    #[inline(always)]
    pub(super) fn flow_in_place(&mut self, b: usize, e: usize, lanes: u8, step: &Step) {
        let mut flowing = FlowingElements {
            spring: self.springs[e],
            plastic: self.plastics[e],
            yields: YieldStress {
                stress: self.yields[e],
                slope: self.slopes[e],
            },
            law: self.bodies[b].law,
            per_time: step.rate,
        };
        let ends = [self.nodes[e + b].position, self.nodes[e + b + 1].position];
        flowing.flow(lanes, |l| ends[1].0[l] - ends[0].0[l]);
        self.springs[e] = flowing.spring;
        self.plastics[e] = flowing.plastic;
        self.yields[e] = flowing.yields.stress;
        self.slopes[e] = flowing.yields.slope;
    }

    /// Lets elements of a body flow in single lanes, eight such places at a time.
    ///
    /// Room for eight more places than `count` lets the last one stand in for those that are missing.
    #[inline(always)]
    pub(super) fn flow_gathered(&mut self, b: usize, count: usize, step: &Step) {
        if count == 0 {
            return;
        }
        let last = self.gathered[count - 1];
        self.gathered[count..count + LANES].fill(last);
        for first in (0..count).step_by(LANES) {
            self.flow_eight(b, first, step);
        }
    }

    #[inline(always)]
    fn flow_eight(&mut self, b: usize, first: usize, step: &Step) {
        let places = &self.gathered[first..first + LANES];
        let law = &self.bodies[b].law;
        let mut flowing = FlowingElements::default();
        for (p, &(element, lane)) in places.iter().enumerate() {
            let (e, l) = (element as usize, lane as usize % LANES);
            flowing.spring.set_lane(p, self.springs[e].lane(l));
            flowing.plastic.set_lane(p, self.plastics[e].lane(l));
            flowing.yields.stress.set_lane(p, self.yields[e].lane(l));
            flowing.yields.slope.set_lane(p, self.slopes[e].lane(l));
            flowing.law.set_lane(p, law.lane(l));
            flowing.per_time.set_lane(p, step.rate.lane(l));
        }
        let nodes = &self.nodes;
        let length = |p: usize| {
            let (element, lane) = places[p];
            let (i, l) = (element as usize + b, lane as usize % LANES);
            nodes[i + 1].position.0[l] - nodes[i].position.0[l]
        };
        flowing.flow(u8::MAX, length);
        for (p, &(element, lane)) in places.iter().enumerate() {
            let (e, l) = (element as usize, lane as usize % LANES);
            self.springs[e].set_lane(l, flowing.spring.lane(p));
            self.plastics[e].set_lane(l, flowing.plastic.lane(p));
            self.yields[e].set_lane(l, flowing.yields.stress.lane(p));
            self.slopes[e].set_lane(l, flowing.yields.slope.lane(p));
        }
    }
}
