//! Return of trial stresses to the yield surface: of one body, or of eight side by side.

use super::{FlowState, LaneStrength, LaneTrial, YieldPoint};
use crate::{
    lanes::{PerLane, Real, any, larger, settled, smaller},
    power::exponential,
};

/// Excess of stress, as a part of the trial stress, from which one more step may be the last.
const LARGEST_EXCESS: f64 = 1e-4;
/// The same of a law whose curvature is known: what the step leaves is bounded anyhow.
const LARGEST_KNOWN_EXCESS: f64 = 1e-2;
/// What the last step may leave of it, as a part of the trial stress.
pub(super) const TOLERANCE: f64 = 1e-8;
/// A step beyond this part of an increment is not the last one.
const LARGEST_STEP: f64 = 0.25;
/// A bracket halved as often as this is a point.
const MOST_ITERATIONS: u32 = 100;

/// Stress along the ratio y of an increment to a known one: `B y + C ln y`.
///
/// B is what stress and strength change over the known increment, C the part of the flow stress that grows with the logarithm of the rate.
#[derive(Clone, Copy)]
pub(super) struct Logarithmic {
    pub(super) hardening: f64,
    pub(super) rate: f64,
}

impl Logarithmic {
    /// Ratio at which a step of Halley's method ends that has an excess of stress to take up.
    #[inline(always)]
    pub(super) fn step(&self, excess: f64) -> f64 {
        let slope = self.hardening + self.rate;
        let square = slope * slope;
        // Not beyond twice the step of Newton's method.
        let curved = larger(square - 0.5 * self.rate * excess, 0.5 * square);
        1.0 + excess * slope / curved
    }

    /// Ratio at which the stress is a given one, however far: not negative, and exact at one and where it is very small.
    #[inline(always)]
    pub(super) fn root(&self, stress: f64) -> f64 {
        let Self { hardening, rate } = *self;
        let twice = 2.0 * hardening + rate;
        let is_slower = stress < 0.0;
        // Without hardening, and one step from there with (y − 1/y)/2 for the logarithm; or that from one.
        let alone = exponential(smaller(stress, 0.0) / rate);
        let slower = rate / (rate + 2.0 * hardening * alone);
        let faster = stress * stress + twice * rate;
        let root = (if is_slower { slower } else { faster }).sqrt();
        if is_slower {
            alone * root
        } else {
            (stress + root) / twice
        }
    }
}

crate::per_lane! {
    /// What an increment of plastic strain comes to.
    #[derive(Debug, Clone, Copy, Default)]
    struct Tried<R = f64> {
        strain_slope: R,
        rate_slope: R,
        /// Stress beyond the flow stress.
        excess: R,
        increment: R,
        /// Where the next step ends.
        next: R,
        /// 1 where a step of Newton's method ends at no flow, or 0.
        stops: R,
        /// 1 where the step may be the last one, or 0.
        last: R,
    }
}

impl Tried {
    #[inline(always)]
    fn of<L: LaneStrength>(law: &L, thermal: f64, trial: &LaneTrial, increment: f64) -> Self {
        let state = trial.at(increment);
        let flow = law.flow_stress(thermal, &state);
        let rate_slope = flow.rate_slope * trial.per_time;
        let excess = trial.stress - trial.modulus * increment - flow.stress;
        let slope = trial.modulus + flow.strain_slope;
        let (next, stops) = if L::LOGARITHMIC {
            let near = Logarithmic {
                hardening: slope * increment,
                rate: rate_slope * increment,
            };
            let stops = near.hardening + near.rate + excess <= 0.0;
            (increment * near.step(excess), stops)
        } else {
            let newton = increment + excess / (slope + rate_slope);
            (newton, newton <= 0.0)
        };
        let mut tried = Self {
            strain_slope: flow.strain_slope,
            rate_slope: flow.rate_slope,
            excess,
            increment,
            next,
            stops: if stops { 1.0 } else { 0.0 },
            last: 0.0,
        };
        let is_last = tried.may_be_last(law, rate_slope, trial.stress, &state);
        tried.last = if is_last & (next > 0.0) { 1.0 } else { 0.0 };
        tried
    }

    /// Whether the stress that the next step leaves is small enough.
    ///
    /// A power of the strain is not more curved than slope over strain. From a power e of the rate, or its logarithm with e = 0, a step of
    /// Halley's method errs by at most e/2 of its square as a part of the increment and (2 + 3 e)/6 of its cube, times slope and increment;
    /// one of Newton's method by half the square.
    #[inline(always)]
    fn may_be_last<L: LaneStrength>(
        &self,
        law: &L,
        rate_slope: f64,
        trial: f64,
        state: &FlowState,
    ) -> bool {
        let strain = state.plastic_strain;
        let (step, increment) = (self.next - self.increment, self.increment);
        let square = step * step;
        if L::LOGARITHMIC {
            let exponent = law.rate_exponent(state.strain_rate);
            let cube = square * step.abs();
            let of_rate = 0.5 * exponent * square * increment + (0.5 * exponent + 1.0 / 3.0) * cube;
            let of_strain = 0.5 * square * self.strain_slope * increment * increment;
            let left = of_strain + rate_slope * strain * of_rate;
            (self.excess.abs() <= LARGEST_KNOWN_EXCESS * trial)
                & (step.abs() <= LARGEST_STEP * increment)
                & (left <= TOLERANCE * trial * strain * increment * increment)
        } else {
            let curvature = self.strain_slope * increment + rate_slope * strain;
            (self.excess.abs() <= LARGEST_EXCESS * trial)
                & (0.5 * square * curvature <= TOLERANCE * trial * strain * increment)
        }
    }

    /// Where a step ends instead of one that leaves the limits, or stops.
    #[inline(always)]
    fn fallback<L: LaneStrength>(&self, trial: &LaneTrial, [low, high]: [f64; 2]) -> f64 {
        let increment = self.increment;
        let factor = if L::LOGARITHMIC {
            let far = Logarithmic {
                hardening: (trial.modulus + self.strain_slope) * increment,
                rate: self.rate_slope * trial.per_time * increment,
            };
            far.root(far.hardening + self.excess)
        } else {
            // Over the logarithm of the increment a rate effect is nearly straight.
            exponential((self.next - increment) / increment)
        };
        let next = increment * factor;
        let is_inside = (low < next) & (next < high);
        if is_inside { next } else { 0.5 * (low + high) }
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
/// The root is bracketed by 0 and q/M and found by Newton's method, or Halley's for laws with the logarithm of the rate, whose curvature is
/// known; over the logarithm of Δ where a step leaves the bracket. As long as flow lasts, the slow flow stress is not needed: it is
/// evaluated only when a body seems to have stopped flowing.
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
    if L::One::LOGARITHMIC {
        search.start_from_last_flow(point, trial);
    }
    let mut left = MOST_ITERATIONS;
    while any(&search.open) {
        left -= 1;
        let tried = search.attempt(law, trial, left == 0);
        search.end(law, trial, &tried, (&mut *point, &mut result));
        if any(&search.open) {
            let outside = search.narrow::<L::One>(&tried);
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
            let thermal = law.lane(l).thermal(trial.temperature);
            let first = point.lane(l).first_increment::<L::One>(&trial);
            search.thermal.set_lane(l, thermal);
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
        let unknown = settled(unknown);
        if !any(&unknown) {
            return;
        }
        self.set_slow_points(law, point, trial, &unknown);
        for l in 0..R::LANES {
            let slow = point.lane(l).tangent_increment(&trial.lane(l));
            let first = self.increment.lane(l);
            let is_unknown = unknown.lane(l) > 0.0;
            self.increment
                .set_lane(l, if is_unknown { slow } else { first });
        }
    }

    /// Finds the slow flow stress in lanes with a 1.
    #[inline(always)]
    fn set_slow_points<L>(
        &self,
        law: &L,
        point: &mut YieldPoint<R>,
        trial: &LaneTrial<R>,
        unknown: &R,
    ) where
        L: PerLane,
        L::One: LaneStrength,
    {
        let mut slow = YieldPoint::<R>::default();
        for l in 0..R::LANES {
            slow.set_lane(l, trial.lane(l).slow(&law.lane(l), self.thermal.lane(l)));
        }
        for l in 0..R::LANES {
            let before = point.lane(l);
            let slow = if L::One::LOGARITHMIC {
                before.with_slow(slow.lane(l))
            } else {
                slow.lane(l)
            };
            point.choose(l, unknown.lane(l) > 0.0, slow, before);
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

    /// Starts bodies that flow again after an elastic pause at the rate of their last flow.
    #[inline(always)]
    fn start_from_last_flow(&mut self, point: &YieldPoint<R>, trial: &LaneTrial<R>) {
        let mut again = R::default();
        for l in 0..R::LANES {
            let (point, open) = (point.lane(l), self.open.lane(l));
            let has_flowed = point.is_slow() & point.has_rate(&trial.lane(l));
            again.set_lane(l, if has_flowed { open } else { 0.0 });
        }
        let again = settled(again);
        if !any(&again) {
            return;
        }
        for l in 0..R::LANES {
            let first = self.increment.lane(l);
            let last = smaller(
                point.lane(l).increment_from_last_flow(&trial.lane(l)),
                first,
            );
            let is_again = again.lane(l) > 0.0;
            self.increment
                .set_lane(l, if is_again { last } else { first });
        }
    }

    /// Evaluates the increments; the next step may be the last one where it leaves little, or everywhere.
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
            let inside = smaller(larger(tried.next, search.low), search.high);
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

    /// Narrows the limits and takes a step; gives 1 where it leaves them or stops, and the search goes on, or 0.
    #[inline(always)]
    fn narrow<One: LaneStrength>(&mut self, tried: &Tried<R>) -> R {
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
            let stops = One::LOGARITHMIC & (tried.stops > 0.0);
            let is_inside = (low < tried.next) & (tried.next < high) & !stops;
            outside.set_lane(l, if is_inside { 0.0 } else { search.open });
            self.low.set_lane(l, low);
            self.high.set_lane(l, high);
            self.increment.set_lane(l, tried.next);
        }
        settled(outside)
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
        let mut unknown = R::default();
        for l in 0..R::LANES {
            let has_stopped = (tried.stops.lane(l) > 0.0) & (self.low.lane(l) == 0.0);
            let is_unknown = has_stopped & !point.lane(l).is_slow();
            let outside = outside.lane(l);
            unknown.set_lane(l, if is_unknown { outside } else { 0.0 });
        }
        let unknown = settled(unknown);
        if any(&unknown) {
            self.set_slow_points(law, point, trial, &unknown);
            for l in 0..R::LANES {
                let is_elastic = point.lane(l).holds(trial.lane(l).stress);
                let ends = is_elastic & (unknown.lane(l) > 0.0);
                let open = self.open.lane(l);
                self.open.set_lane(l, if ends { 0.0 } else { open });
            }
        }
        for l in 0..R::LANES {
            let limits = [self.low.lane(l), self.high.lane(l)];
            let fallback = tried.lane(l).fallback::<L::One>(&trial.lane(l), limits);
            let next = self.increment.lane(l);
            let is_outside = outside.lane(l) > 0.0;
            self.increment
                .set_lane(l, if is_outside { fallback } else { next });
        }
    }
}
