//! Return of eight trial stresses to the yield surface where strength is a power of the plastic strain.

use super::element::{Plastic, Spring};
use crate::{
    lanes::{LANES, Lanes, PerLane},
    material::{FlowState, Hardening, Trial, YieldPoint, first_return},
    power::log_ratio,
};

/// Elastic strain from which a trial is worked out once more: less than the one up to which it is exact.
const LARGE: f64 = 0.09;

percuss_core::per_lane! {
    /// What flow needs of a material.
    #[derive(Debug, Clone, Copy, Default)]
    pub(super) struct FlowLaw<R = f64> {
        pub(super) modulus: R,
        /// Temperature rise per plastic work per volume.
        pub(super) heating: R,
        pub(super) coefficient: R,
        pub(super) exponent: R,
        pub(super) first_strain: R,
    }
}

impl FlowLaw {
    pub(super) fn new(law: Hardening, modulus: f64, heating: f64) -> Self {
        Self {
            modulus,
            heating,
            coefficient: law.coefficient,
            exponent: law.exponent,
            first_strain: law.first_strain,
        }
    }

    #[inline(always)]
    fn hardening(&self) -> Hardening {
        Hardening {
            coefficient: self.coefficient,
            exponent: self.exponent,
            first_strain: self.first_strain,
        }
    }
}

percuss_core::per_lane! {
    /// Yield stress and its slope with the plastic strain [Pa].
    #[derive(Debug, Clone, Copy, Default)]
    pub(super) struct YieldStress<R = f64> {
        pub(super) stress: R,
        pub(super) slope: R,
    }
}

/// Eight elements that flow.
#[derive(Clone, Copy, Default)]
pub(super) struct FlowingElements {
    pub(super) spring: Spring<Lanes>,
    pub(super) plastic: Plastic<Lanes>,
    pub(super) yields: YieldStress<Lanes>,
    pub(super) law: FlowLaw<Lanes>,
    /// Inverse of the time step [1/s].
    pub(super) per_time: Lanes,
}

impl YieldStress {
    pub(super) fn of(point: &YieldPoint) -> Self {
        Self {
            stress: point.stress(),
            slope: point.strain_slope(),
        }
    }

    pub(super) fn point(self) -> YieldPoint {
        YieldPoint::known(self.stress, self.slope)
    }
}

impl FlowingElements {
    /// Returns the trial stresses to the yield surface; what is in places whose bits are not set stays as it is.
    #[inline(always)]
    pub(super) fn flow(&mut self, places: u8, length: impl Fn(usize) -> f64) {
        let Self {
            spring,
            plastic,
            yields: before,
            law,
            per_time,
        } = *self;
        let mut trial = spring.stress;
        let mut increment = Lanes::all(0.0);
        let mut yields = before;
        let mut left_over = 0;
        for p in 0..LANES {
            let (law, point) = (law.lane(p), before.lane(p));
            let size = trial.0[p].abs();
            let point = [point.stress, point.slope];
            let strain = plastic.strain.0[p];
            let returned = first_return(law.hardening(), point, strain, size, law.modulus);
            let is_last = returned.is_last & (size <= law.modulus * LARGE);
            left_over |= u8::from(!is_last) << p;
            increment.0[p] = returned.increment;
            yields.stress.0[p] = size - law.modulus * returned.increment;
            yields.slope.0[p] = returned.strain_slope;
        }
        left_over &= places;
        if left_over != 0 {
            for p in (0..LANES).filter(|p| left_over >> p & 1 == 1) {
                let (law, strain) = (law.lane(p), plastic.strain.0[p]);
                trial.0[p] = law.modulus * log_ratio(spring.unloaded_length.0[p], length(p));
                let (next, point) = iterate(law, before.lane(p), strain, trial.0[p]);
                increment.0[p] = next;
                yields.set_lane(p, point);
            }
        }
        let mut flowed = *self;
        let mut is_large = 0;
        for p in 0..LANES {
            let (mut next, mut strained) = (spring.lane(p), plastic.lane(p));
            next.stress = trial.0[p];
            let constants = [law.modulus.0[p], law.heating.0[p]];
            let time = per_time.0[p];
            let is_exact = next.flow_by(increment.0[p], &mut strained, constants, time);
            is_large |= u8::from(!is_exact) << p;
            let flows = places >> p & 1 == 1;
            flowed.spring.choose(p, flows, next, spring.lane(p));
            flowed.plastic.choose(p, flows, strained, plastic.lane(p));
            flowed
                .yields
                .choose(p, flows, yields.lane(p), before.lane(p));
        }
        *self = flowed;
        is_large &= places;
        if is_large != 0 {
            for p in (0..LANES).filter(|p| is_large >> p & 1 == 1) {
                let mut flowed = self.spring.lane(p);
                flowed.shrink(spring.unloaded_length.0[p], self.plastic.step.0[p]);
                self.spring.set_lane(p, flowed);
            }
        }
    }
}

/// The return of a single element: plastic increment, and where it ends.
#[cold]
#[inline(never)]
fn iterate(
    law: FlowLaw,
    before: YieldStress,
    plastic_strain: f64,
    trial: f64,
) -> (f64, YieldStress) {
    let mut point = before.point();
    let start = FlowState {
        plastic_strain,
        strain_rate: 0.0,
        temperature: 0.0,
        pressure: 0.0,
    };
    let trial = Trial {
        stress: trial.abs(),
        modulus: law.modulus,
        pressure_fall: 0.0,
        elapsed: None,
    };
    let increment = point.plastic_increment(&law.hardening(), &start, &trial);
    (increment, YieldStress::of(&point))
}
