//! Return of trial stresses to the yield surface: of one body, or of eight side by side.

use super::{LaneStrength, LaneTrial, YieldPoint};
use crate::{
    lanes::{PerLane, Real, any, larger, smaller},
    power::exponential,
};

/// Excess of stress, as a part of the trial stress, from which one more Newton step may be the last.
const LARGEST_EXCESS: f64 = 1e-4;
/// What the last Newton step may leave of it, as a part of the trial stress.
pub(super) const TOLERANCE: f64 = 1e-8;
/// A bracket halved as often as this is a point.
const MOST_ITERATIONS: u32 = 100;

/// Whether a step of Newton's method may be the last one.
///
/// Powers of strain and strain rate are not more curved than slope over strain and slope over rate: `curvature` is the sum of the
/// two, `per` times.
#[inline(always)]
pub fn is_last(trial: f64, excess: f64, step: f64, curvature: f64, per: f64) -> bool {
    (excess.abs() <= LARGEST_EXCESS * trial)
        & (0.5 * step * step * curvature <= TOLERANCE * trial * per)
}

crate::per_lane! {
    /// What an increment of plastic strain comes to.
    #[derive(Debug, Clone, Copy, Default)]
    struct Tried<R = f64> {
        strain_slope: R,
        rate_slope: R,
        /// Stress beyond the flow stress, and the step of Newton's method from there.
        excess: R,
        step: R,
        /// 1 where that may be the last one, or 0.
        last: R,
        increment: R,
    }
}

impl Tried {
    #[inline(always)]
    fn of(law: &impl LaneStrength, thermal: f64, trial: &LaneTrial, increment: f64) -> Self {
        let state = trial.at(increment);
        let flow = law.flow_stress(thermal, &state);
        let rate_slope = flow.rate_slope * trial.per_time;
        let excess = trial.stress - trial.modulus * increment - flow.stress;
        let step = excess / (trial.modulus + flow.strain_slope + rate_slope);
        let strain = state.plastic_strain;
        let curvature = flow.strain_slope * increment + rate_slope * strain;
        let last = is_last(trial.stress, excess, step, curvature, strain * increment);
        Self {
            strain_slope: flow.strain_slope,
            rate_slope: flow.rate_slope,
            excess,
            step,
            increment,
            last: if last & (increment + step > 0.0) {
                1.0
            } else {
                0.0
            },
        }
    }

    /// Where the last step ends.
    #[inline(always)]
    fn end(&self, trial: &LaneTrial, increment: f64, strain_only: bool) -> YieldPoint {
        let stress = trial.stress - trial.modulus * increment;
        YieldPoint {
            stress,
            strain_slope: self.strain_slope,
            rate_slope: self.rate_slope,
            strain_rate: increment * trial.per_time,
            elastic_to: if strain_only {
                stress
            } else {
                f64::NEG_INFINITY
            },
        }
    }
}

/// Solves `q − M Δ = Y(ε_p + Δ, Δ/Δt, T)` for the plastic strain Δ, where `q` is the trial stress and `M` its fall per plastic strain; 0
/// where the trial stress is elastic, and in lanes with a 0 in `places`, which stay as they are; the others have a 1.
///
/// The root is bracketed by 0 and q/M and found by Newton's method, over the logarithm of Δ where a step over Δ leaves the bracket. As
/// long as flow lasts, the slow flow stress is not needed: it is evaluated only when a body seems to have stopped flowing.
///
/// One body or eight of the same law side by side, with the same bits; for code that has been dispatched to an instruction set. A law of
/// one lane is that of all.
// What holds in a lane is a number, 1 or 0: bits of one number would be put together one by one.
#[inline(always)]
pub fn plastic_increments<R: Real, L>(
    law: &L,
    point: &mut YieldPoint<R>,
    trial: &LaneTrial<R>,
    places: &R,
) -> R
where
    L: PerLane,
    L::One: LaneStrength,
{
    let mut result = R::default();
    let mut search = Search::start(law, point, trial, places);
    search.find_slow_points(law, point, trial);
    search.bracket(point, trial);
    let mut left = MOST_ITERATIONS;
    while any(&search.open) {
        left -= 1;
        let tried = search.attempt(law, trial, left == 0);
        search.end(law, trial, &tried, (&mut *point, &mut result));
        if any(&search.open) {
            let outside = search.narrow(&tried);
            if any(&outside) {
                search.step_inside(law, point, trial, &tried, &outside);
            }
        }
    }
    result
}

crate::per_lane! {
    /// Search for the increments of plastic strain, between a lower and an upper limit.
    #[derive(Debug, Clone, Copy, Default)]
    struct Search<R: Real = f64> {
        thermal: R,
        increment: R,
        low: R,
        high: R,
        /// 1 where it goes on, or 0.
        open: R,
    }
}

impl<R: Real> Search<R> {
    /// From where the tangents of the yield surface in the points meet the trial stresses.
    #[inline(always)]
    fn start<L>(law: &L, point: &YieldPoint<R>, trial: &LaneTrial<R>, places: &R) -> Self
    where
        L: PerLane,
        L::One: LaneStrength,
    {
        let mut search = Self {
            open: *places,
            ..Self::default()
        };
        for l in 0..R::LANES {
            let trial = trial.lane(l);
            search
                .thermal
                .set_lane(l, law.lane(l).thermal(trial.temperature));
            let first = point.lane(l).tangent_increment(&trial);
            search.increment.set_lane(l, first);
        }
        search
    }

    /// Finds the slow flow stress of those that seem to have stopped flowing.
    #[inline(always)]
    fn find_slow_points<L>(&mut self, law: &L, point: &mut YieldPoint<R>, trial: &LaneTrial<R>)
    where
        L: PerLane,
        L::One: LaneStrength,
    {
        let mut unknown = R::default();
        for l in 0..R::LANES {
            let seems_elastic = self.increment.lane(l) <= 0.0;
            let is_unknown = seems_elastic & !point.lane(l).is_slow();
            let open = self.open.lane(l);
            unknown.set_lane(l, if is_unknown { open } else { 0.0 });
        }
        if !any(&unknown) {
            return;
        }
        let mut slow = YieldPoint::<R>::default();
        for l in 0..R::LANES {
            slow.set_lane(l, trial.lane(l).slow(&law.lane(l), self.thermal.lane(l)));
        }
        for l in 0..R::LANES {
            let before = point.lane(l);
            point.choose(l, unknown.lane(l) > 0.0, slow.lane(l), before);
            let first = point.lane(l).tangent_increment(&trial.lane(l));
            self.increment.set_lane(l, first);
        }
    }

    /// Sets the limits, and ends where the stress is elastic.
    #[inline(always)]
    fn bracket(&mut self, point: &YieldPoint<R>, trial: &LaneTrial<R>) {
        for l in 0..R::LANES {
            let trial = trial.lane(l);
            let is_elastic = point.lane(l).holds(trial.stress);
            let open = self.open.lane(l);
            self.open.set_lane(l, if is_elastic { 0.0 } else { open });
            let most = trial.stress / trial.modulus;
            self.high.set_lane(l, most);
            let first = smaller(self.increment.lane(l), most);
            self.increment.set_lane(l, first);
        }
    }

    /// Evaluates the increments; the next step may be the last one where that of Newton's method may, or everywhere.
    #[inline(always)]
    fn attempt<L>(&self, law: &L, trial: &LaneTrial<R>, must_end: bool) -> Tried<R>
    where
        L: PerLane,
        L::One: LaneStrength,
    {
        let mut tried = Tried::<R>::default();
        for l in 0..R::LANES {
            let (law, search) = (law.lane(l), self.lane(l));
            let one = Tried::of(&law, search.thermal, &trial.lane(l), search.increment);
            tried.set_lane(l, one);
        }
        if must_end {
            tried.last = R::all(1.0);
        }
        tried
    }

    /// Takes the last step where it is one, and ends there.
    #[inline(always)]
    fn end<L>(
        &mut self,
        law: &L,
        trial: &LaneTrial<R>,
        tried: &Tried<R>,
        (point, result): (&mut YieldPoint<R>, &mut R),
    ) where
        L: PerLane,
        L::One: LaneStrength,
    {
        let mut end = YieldPoint::<R>::default();
        let (mut found, mut ends) = (R::default(), R::default());
        for l in 0..R::LANES {
            let (tried, search) = (tried.lane(l), self.lane(l));
            let newton = search.increment + tried.step;
            let inside = smaller(larger(newton, search.low), search.high);
            found.set_lane(l, inside);
            let strain_only = law.lane(l).depends_on_strain_only();
            end.set_lane(l, tried.end(&trial.lane(l), inside, strain_only));
            ends.set_lane(l, if tried.last > 0.0 { search.open } else { 0.0 });
        }
        for l in 0..R::LANES {
            let ends_here = ends.lane(l) > 0.0;
            let (found_before, before) = (result.lane(l), point.lane(l));
            result.choose(l, ends_here, found.lane(l), found_before);
            point.choose(l, ends_here, end.lane(l), before);
            let open = self.open.lane(l);
            self.open.set_lane(l, if ends_here { 0.0 } else { open });
        }
    }

    /// Narrows the limits and takes a step of Newton's method; gives 1 where it leaves them and the search goes on, or 0.
    #[inline(always)]
    fn narrow(&mut self, tried: &Tried<R>) -> R {
        let mut outside = R::default();
        for l in 0..R::LANES {
            let (tried, search) = (tried.lane(l), self.lane(l));
            let is_below = tried.excess > 0.0;
            let low = if is_below {
                search.increment
            } else {
                search.low
            };
            let high = if is_below {
                search.high
            } else {
                search.increment
            };
            let newton = search.increment + tried.step;
            let is_inside = (low < newton) & (newton < high);
            outside.set_lane(l, if is_inside { 0.0 } else { search.open });
            self.low.set_lane(l, low);
            self.high.set_lane(l, high);
            self.increment.set_lane(l, newton);
        }
        outside
    }

    /// Other steps instead of those that leave the limits; ends where the body turns out to be elastic.
    #[inline(always)]
    fn step_inside<L>(
        &mut self,
        law: &L,
        point: &mut YieldPoint<R>,
        trial: &LaneTrial<R>,
        tried: &Tried<R>,
        outside: &R,
    ) where
        L: PerLane,
        L::One: LaneStrength,
    {
        for l in (0..R::LANES).filter(|l| outside.lane(*l) > 0.0) {
            let law = law.lane(l);
            if !self.step_lane_inside(l, &law, point, &trial.lane(l), &tried.lane(l)) {
                self.open.set_lane(l, 0.0);
            }
        }
    }

    /// Another step instead of one that leaves the limits; false where the body turns out to be elastic.
    #[inline(always)]
    fn step_lane_inside(
        &mut self,
        l: usize,
        law: &impl LaneStrength,
        point: &mut YieldPoint<R>,
        trial: &LaneTrial,
        tried: &Tried,
    ) -> bool {
        let Search {
            thermal,
            increment: newton,
            low,
            high,
            ..
        } = self.lane(l);
        if newton <= 0.0 && low == 0.0 && !point.lane(l).is_slow() {
            let slow = trial.slow(law, thermal);
            point.set_lane(l, slow);
            if slow.holds(trial.stress) {
                return false;
            }
        }
        let is_inside = |next: f64| low < next && next < high;
        // Over the logarithm of the increment a rate effect is nearly straight.
        let next = tried.increment * exponential(tried.step / tried.increment);
        let next = if is_inside(next) {
            next
        } else {
            0.5 * (low + high)
        };
        self.increment.set_lane(l, next);
        true
    }
}
