//! Return of eight trial stresses to the yield surface, for every strength law that rides in lanes.

use super::{
    element::{Plastic, Spring},
    part::Section,
};
use crate::{
    lanes::{LANES, Lanes, PerLane, lanes},
    material::{LaneStrength, LaneTrial, YieldPoint, plastic_increments},
};

percuss_core::per_lane! {
    /// What flow needs of a body besides its strength.
    #[derive(Debug, Clone, Copy, Default)]
    pub(super) struct FlowConstants<R = f64> {
        pub(super) modulus: R,
        /// Temperature rise per plastic work per volume.
        pub(super) heating: R,
        /// 1 where the strength depends on the strain rate, or 0.
        pub(super) rate_effects: R,
    }
}

impl FlowConstants {
    pub(super) fn of(part: &Section) -> Self {
        Self {
            modulus: part.modulus,
            heating: part.heating,
            rate_effects: f64::from(u8::from(part.rate_effects)),
        }
    }
}

/// Eight elements that flow, of bodies whose laws have the same equations.
#[derive(Clone, Copy, Default)]
pub(super) struct FlowingElements {
    pub(super) spring: Spring<Lanes>,
    pub(super) plastic: Plastic<Lanes>,
    pub(super) points: YieldPoint<Lanes>,
    /// Inverse of the time step [1/s].
    pub(super) per_time: Lanes,
}

impl FlowingElements {
    /// Returns the trial stresses to the yield surface in places with a 1; what is in those with a 0 stays as it is.
    #[inline(always)]
    pub(super) fn flow<L>(&mut self, law: &L, constants: &FlowConstants<Lanes>, places: &Lanes)
    where
        L: PerLane,
        L::One: LaneStrength,
    {
        let (spring, plastic) = (self.spring, self.plastic);
        let (stress, per_time) = (spring.stress, self.per_time);
        let FlowConstants {
            modulus,
            heating,
            rate_effects,
        } = constants;
        let trial = LaneTrial {
            stress: lanes(|p| stress[p].abs()),
            modulus: *modulus,
            pressure_fall: lanes(|p| modulus[p].copysign(stress[p]) / 3.0),
            per_time: lanes(|p| per_time[p] * rate_effects[p]),
            plastic_strain: plastic.strain,
            temperature: plastic.temperature,
            pressure: lanes(|p| stress[p] / 3.0),
        };
        let increment = plastic_increments(law, &mut self.points, &trial, places);
        let (mut flowed, mut strained) = (spring, plastic);
        for p in 0..LANES {
            let (mut next, mut strain) = (spring.lane(p), plastic.lane(p));
            let constants = [modulus[p], heating[p]];
            next.flow_by(increment.0[p], &mut strain, constants, per_time.0[p]);
            let flows = increment.0[p] != 0.0;
            flowed.choose(p, flows, next, spring.lane(p));
            strained.choose(p, flows, strain, plastic.lane(p));
        }
        (self.spring, self.plastic) = (flowed, strained);
    }
}
