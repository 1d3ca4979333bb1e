//! Return of eight trial stresses to the yield surface where strength is a power of the plastic strain.

use super::element::{Plastic, Spring};
use crate::{
    lanes::{LaneMask, Lanes, Mask, PerLane, Real, per_lane},
    material::{FlowState, Hardening, Trial, YieldPoint, first_return},
    power::log_ratio,
};

/// Elastic strain from which a trial is worked out once more: less than the one up to which it is exact.
const LARGE: f64 = 0.09;

/// What flow needs of a material.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FlowLaw<R = f64> {
    pub(super) modulus: R,
    /// Temperature rise per plastic work per volume.
    pub(super) heating: R,
    pub(super) hardening: Hardening<R>,
}
per_lane!(FlowLaw {
    modulus,
    heating,
    hardening
});

/// Yield stress and its slope with the plastic strain [Pa].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct YieldStress<R = f64> {
    pub(super) stress: R,
    pub(super) slope: R,
}
per_lane!(YieldStress { stress, slope });

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
    /// Returns the trial stresses to the yield surface; only some places count.
    #[inline(always)]
    pub(super) fn flow(&mut self, places: LaneMask, length: impl Fn(usize) -> f64) {
        let FlowLaw {
            modulus,
            heating,
            hardening,
        } = self.law;
        let (before, strain) = (self.yields, self.plastic.strain);
        let size = self.spring.stress.size();
        let points = [before.stress, before.slope];
        let returned = first_return(hardening, points, strain, size, modulus);
        let mut increment = returned.increment;
        self.yields = YieldStress {
            stress: size - modulus * increment,
            slope: returned.strain_slope,
        };
        let is_last = returned.is_last & size.at_most(modulus * LARGE);
        let left_over = places & !is_last;
        if left_over.any() {
            for p in left_over.lanes() {
                let elastic = log_ratio(self.spring.unloaded_length.0[p], length(p));
                let trial = modulus.0[p] * elastic;
                let of_lane = (hardening.lane(p), before.lane(p));
                let (next, point) = iterate(of_lane, strain.0[p], trial, modulus.0[p]);
                self.spring.stress.0[p] = trial;
                increment.0[p] = next;
                self.yields.set_lane(p, point);
            }
        }
        let increment = Lanes::select(places, increment, Lanes::all(0.0));
        self.spring.flow_by(
            increment,
            &mut self.plastic,
            [modulus, heating],
            self.per_time,
        );
    }
}

/// The return of a single element: plastic increment, and where it ends.
#[cold]
#[inline(never)]
fn iterate(
    (law, before): (Hardening, YieldStress),
    plastic_strain: f64,
    trial: f64,
    modulus: f64,
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
        modulus,
        pressure_fall: 0.0,
        elapsed: None,
    };
    let increment = point.plastic_increment(&law, &start, &trial);
    (increment, YieldStress::of(&point))
}
