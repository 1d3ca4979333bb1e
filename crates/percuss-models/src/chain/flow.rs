//! Return of eight trial stresses to the yield surface, for every strength law that rides in lanes.

use super::{
    element::{Plastic, Spring},
    part::Section,
};
use crate::{
    lanes::{LANES, Lanes, PerLane},
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

/// Eight elements that flow, of bodies with the same law.
#[derive(Clone, Copy, Default)]
pub(super) struct FlowingElements<L> {
    pub(super) spring: Spring<Lanes>,
    pub(super) plastic: Plastic<Lanes>,
    pub(super) points: YieldPoint<Lanes>,
    pub(super) constants: FlowConstants<Lanes>,
    pub(super) law: L,
    /// Inverse of the time step [1/s].
    pub(super) per_time: Lanes,
}

impl<L> FlowingElements<L>
where
    L: PerLane,
    L::One: LaneStrength,
{
    /// Returns the trial stresses to the yield surface in places with a 1; what is in those with a 0 stays as it is.
    #[inline(always)]
    pub(super) fn flow(&mut self, places: &Lanes) {
        let (spring, plastic, constants) = (self.spring, self.plastic, self.constants);
        let per_time = self.per_time;
        let mut trial = LaneTrial::<Lanes>::default();
        for p in 0..LANES {
            let (stress, constants) = (spring.stress.0[p], constants.lane(p));
            trial.set_lane(
                p,
                LaneTrial {
                    stress: stress.abs(),
                    modulus: constants.modulus,
                    pressure_fall: constants.modulus.copysign(stress) / 3.0,
                    per_time: per_time.0[p] * constants.rate_effects,
                    plastic_strain: plastic.strain.0[p],
                    temperature: plastic.temperature.0[p],
                    pressure: stress / 3.0,
                },
            );
        }
        let increment = plastic_increments(&self.law, &mut self.points, &trial, places);
        let (mut flowed, mut strained) = (spring, plastic);
        for p in 0..LANES {
            let (mut next, mut strain) = (spring.lane(p), plastic.lane(p));
            let constants = [constants.modulus.0[p], constants.heating.0[p]];
            next.flow_by(increment.0[p], &mut strain, constants, per_time.0[p]);
            let flows = increment.0[p] != 0.0;
            flowed.choose(p, flows, next, spring.lane(p));
            strained.choose(p, flows, strain, plastic.lane(p));
        }
        (self.spring, self.plastic) = (flowed, strained);
    }
}
