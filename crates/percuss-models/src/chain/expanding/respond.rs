//! Eight slices of a projectile side by side, from new lengths and radii to stresses and forces, and the shear between them.

// Loops over the lanes run along many arrays at once.
#![allow(clippy::needless_range_loop)]

use super::{
    block::{Ends, Inverse, add},
    blocks::{ahead, first_lanes, flags, sum},
    slice::{Metal, Neighbours, Particulars, Shear, Slice, Undeformed, axial_stress},
};
use crate::{
    lanes::{LANES, Lanes, PerLane, each_of, lanes, larger, settled, smaller},
    material::{Hardening, YieldPoint, first_return},
    power::log_ratio,
};

/// What the stages of a step leave to the next one, for a block of slices.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stage {
    pub(super) inverse: Inverse,
    /// Stress difference if nothing flowed [Pa], 1 where it is beyond the yield surface, and whether it is in any lane.
    trial: Lanes,
    beyond: Lanes,
    pub(super) flows: bool,
    /// First return to a flow stress that is a power of the plastic strain: increment of the plastic strain, slope of the flow stress, and
    /// 1 where it is the last one.
    increment: Lanes,
    slope: Lanes,
    is_last: Lanes,
}

/// A step of slices of one metal.
pub(super) struct Step<'a> {
    pub(super) metal: &'a Metal,
    pub(super) size: &'a Undeformed,
    /// Strength, where it is a power of the plastic strain.
    pub(super) hardening: Option<Hardening>,
    pub(super) time_step: f64,
}

impl Step<'_> {
    /// New lengths and radii of the slices in lanes with a 1 in `present`; gives the smaller of the two in each lane [m].
    #[inline(always)]
    pub(super) fn resize(
        &self,
        slices: &mut Slice<Lanes>,
        stage: &mut Stage,
        ends: &Ends<'_>,
        present: &Lanes,
    ) -> Lanes {
        let (rest, time_step) = (self.size.length, self.time_step);
        let (back, front) = (ends.back.position, ends.front_position);
        let (velocity, before) = (slices.radial_velocity, slices.radius);
        let length = lanes(|l| {
            let length = front[l] - back[l];
            if present[l] > 0.0 { length } else { rest }
        });
        let radius = lanes(|l| before[l] + velocity[l] * time_step);
        (slices.length, slices.radius) = (length, radius);
        stage.inverse = Inverse::of(slices);
        lanes(|l| smaller(length[l], radius[l]))
    }

    /// Strains and pressures of new lengths and radii, and the stress differences if nothing flowed.
    #[inline(always)]
    pub(super) fn strain(
        &self,
        slices: &mut Slice<Lanes>,
        stage: &mut Stage,
        particulars: &mut [Particulars],
    ) {
        let Self { metal, size, .. } = *self;
        let (length, radius, plastic) = (slices.length, slices.radius, slices.plastic_axial);
        let axial = lanes(|l| log_ratio(size.length, length[l]));
        let radial = lanes(|l| log_ratio(size.radius, radius[l]));
        let elastic_to = self.elastic_to(slices, particulars);
        let [bulk, shear] = [metal.bulk_modulus, metal.shear_modulus];
        let pressure = lanes(|l| bulk * (axial[l] + 2.0 * radial[l]));
        let trial = lanes(|l| 2.0 * shear * (axial[l] - radial[l] - 1.5 * plastic[l]));
        let beyond = flags(|l| trial[l].abs() > elastic_to[l]);
        (stage.trial, stage.beyond, stage.flows) = (trial, beyond, sum(&beyond) > 0.0);
        slices.strain = axial;
        slices.pressure = [slices.pressure[1], pressure];
    }

    /// Stress differences up to which slices are known to be elastic [Pa].
    #[inline(always)]
    fn elastic_to(&self, slices: &Slice<Lanes>, particulars: &mut [Particulars]) -> Lanes {
        if self.hardening.is_some() {
            return slices.yield_stress;
        }
        let changes = self.metal.strength.depends_on_pressure();
        let mut elastic_to = Lanes::all(f64::INFINITY);
        for (elastic_to, own) in elastic_to.iter_mut().zip(particulars) {
            if changes {
                own.yield_point.forget();
            }
            *elastic_to = own.yield_point.elastic_to();
        }
        elastic_to
    }

    /// Returns the stress differences to a flow stress that is a power of the plastic strain, as far as the first step of Newton's method
    /// goes.
    #[inline(always)]
    pub(super) fn first_return(&self, slices: &Slice<Lanes>, stage: &mut Stage, law: Hardening) {
        let modulus = 3.0 * self.metal.shear_modulus;
        let (strain, yields, slope) = (slices.plastic_strain, slices.yield_stress, slices.slope);
        let trial = stage.trial;
        let [increment, after, is_last] = each_of(|l| {
            let before = [yields[l], slope[l]];
            let returned = first_return(law, before, strain[l], trial[l].abs(), modulus);
            let is_last = if returned.is_last { 1.0 } else { 0.0 };
            [returned.increment, returned.strain_slope, is_last]
        });
        (stage.increment, stage.slope, stage.is_last) = (increment, after, is_last);
    }

    /// Goes on to the stresses and forces; gives the plastic work [J].
    #[inline(always)]
    pub(super) fn respond(
        &self,
        slices: &mut Slice<Lanes>,
        stage: &Stage,
        particulars: &mut [Particulars],
    ) -> Lanes {
        let step_before = slices.plastic_step;
        slices.plastic_step = Lanes::all(0.0);
        let difference = settled(if stage.flows {
            self.flow(slices, stage, particulars)
        } else {
            stage.trial
        });
        let (pressure, inverse) = (slices.pressure[1], &stage.inverse);
        let (before, plastic_step) = (slices.difference[1], slices.plastic_step);
        slices.difference = [before, difference];
        let volume = self.size.volume;
        slices.axial_force =
            lanes(|l| axial_stress(pressure[l], difference[l]) * volume * inverse.length[l]);
        slices.radial_force = lanes(|l| {
            let radial_stress = pressure[l] - 1.0 / 3.0 * difference[l];
            2.0 * radial_stress * volume * inverse.radius[l]
        });
        lanes(|l| 0.5 * volume * before[l] * (step_before[l] + plastic_step[l]))
    }

    /// Stress differences after flow.
    ///
    /// A strength that is a power of the plastic strain is returned to in all lanes at once, and in single lanes where the first step of
    /// Newton's method does not reach it. Other laws are in [`Slice::flow`], lane by lane.
    #[inline(always)]
    fn flow(
        &self,
        slices: &mut Slice<Lanes>,
        stage: &Stage,
        particulars: &mut [Particulars],
    ) -> Lanes {
        let Self {
            metal, time_step, ..
        } = *self;
        let (mut difference, mut left_over) = (stage.trial, stage.beyond);
        if self.hardening.is_some() {
            (difference, left_over) = self.harden(slices, stage);
        }
        if sum(&left_over) == 0.0 {
            return difference;
        }
        for (l, own) in particulars.iter_mut().enumerate() {
            if left_over[l] == 0.0 {
                continue;
            }
            let mut one = slices.lane(l);
            let mut point = match self.hardening {
                Some(_) => YieldPoint::known(one.yield_stress, one.slope),
                None => own.yield_point,
            };
            let start = [stage.trial[l], one.pressure[1]];
            difference[l] = one.flow(metal, &mut point, start, time_step);
            slices.set_lane(l, one);
            own.yield_point = point;
        }
        difference
    }

    /// Takes the first return in lanes in which it is the last one; gives 1 in those that flow and in which it is not.
    #[inline(always)]
    fn harden(&self, slices: &mut Slice<Lanes>, stage: &Stage) -> (Lanes, Lanes) {
        let modulus = 3.0 * self.metal.shear_modulus;
        let (per_time, heating) = (1.0 / self.time_step, self.metal.heating);
        let Stage {
            trial,
            beyond,
            increment,
            slope,
            is_last,
            ..
        } = *stage;
        let flows = settled(lanes(|l| beyond[l] * is_last[l]));
        // What does not flow stays what it was.
        let or = |next: Lanes, before: Lanes| {
            lanes(|l| if flows[l] > 0.0 { next[l] } else { before[l] })
        };
        let step = lanes(|l| increment[l].copysign(trial[l]));
        let stress = lanes(|l| trial[l] - modulus * step[l]);
        let before = slices.difference[1];
        let mean = lanes(|l| 0.5 * (before[l] + stress[l]).abs());
        slices.plastic_step = or(step, Lanes::all(0.0));
        let before = slices.plastic_axial;
        slices.plastic_axial = or(lanes(|l| before[l] + step[l]), before);
        let before = slices.plastic_strain;
        slices.plastic_strain = or(lanes(|l| before[l] + increment[l]), before);
        let before = slices.largest_rate;
        let rate = lanes(|l| larger(increment[l] * per_time, before[l]));
        slices.largest_rate = or(rate, before);
        let before = slices.temperature;
        let warm = lanes(|l| before[l] + heating * mean[l] * increment[l]);
        slices.temperature = or(warm, before);
        slices.slope = or(slope, slices.slope);
        let yields = lanes(|l| trial[l].abs() - modulus * increment[l]);
        slices.yield_stress = or(yields, slices.yield_stress);
        let left_over = settled(lanes(|l| beyond[l] * (1.0 - is_last[l])));
        (or(stress, trial), left_over)
    }

    /// Lets the shears follow so many slices; adds their plastic work [J].
    #[inline(always)]
    pub(super) fn shear<'a>(
        &self,
        slices: &[Slice<Lanes>],
        shears: impl Iterator<Item = &'a mut Shear<Lanes>>,
        count: usize,
        work: &mut Lanes,
    ) {
        for (b, shears) in shears.enumerate() {
            let here = &slices[b];
            let next = slices.get(b + 1).map(|slices| slices.lane(0));
            let next = next.unwrap_or_default();
            let lengths = [here.length, ahead(&here.length, next.length)];
            let speeds = [
                here.radial_velocity,
                ahead(&here.radial_velocity, next.radial_velocity),
            ];
            let yields = [
                here.yield_stress,
                ahead(&here.yield_stress, next.yield_stress),
            ];
            let before = *shears;
            let present = first_lanes(count.saturating_sub(b * LANES + 1));
            let (mut after, mut done) = (before, Lanes::all(0.0));
            for l in 0..LANES {
                let mut one = before.lane(l);
                let slices = Neighbours {
                    length: 0.5 * (lengths[0][l] + lengths[1][l]),
                    widening: speeds[1][l] - speeds[0][l],
                    yield_stress: 0.5 * (yields[0][l] + yields[1][l]),
                };
                let own = one.deform(self.metal, self.size, &slices, self.time_step);
                let is_here = present[l] > 0.0;
                after.choose(l, is_here, one, Shear::default());
                done[l] = if is_here { own } else { 0.0 };
            }
            *shears = after;
            add(work, &done);
        }
    }
}
