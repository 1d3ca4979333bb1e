//! Eight slices of a projectile side by side, from new lengths and radii to stresses and forces, and the shear between them.

// Loops over the lanes run along many arrays at once.
#![allow(clippy::needless_range_loop)]

use super::{
    block::{Ends, Inverse, add},
    blocks::{Blocks, ahead, first_lanes},
    slice::{Metal, Neighbours, Shear, Slice, Undeformed, axial_stress},
};
use crate::{
    lanes::{LANES, Lanes, PerLane, any, flags, lanes, settled, smaller},
    material::{LaneStrength, LaneTrial, LawVisitor, plastic_increments},
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
    /// Increment of plastic strain.
    increment: Lanes,
}

/// A step of slices of one metal.
pub(super) struct Step<'a> {
    pub(super) metal: &'a Metal,
    pub(super) size: &'a Undeformed,
    /// Whether the flow stress changes with the pressure alone.
    pub(super) depends_on_pressure: bool,
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
    pub(super) fn strain(&self, slices: &mut Slice<Lanes>, stage: &mut Stage, present: &Lanes) {
        let Self { metal, size, .. } = *self;
        let (length, radius, plastic) = (slices.length, slices.radius, slices.plastic.axial);
        let axial = lanes(|l| log_ratio(size.length, length[l]));
        let radial = lanes(|l| log_ratio(size.radius, radius[l]));
        let [bulk, shear] = [metal.bulk_modulus, metal.shear_modulus];
        let pressure = lanes(|l| bulk * (axial[l] + 2.0 * radial[l]));
        let trial = lanes(|l| 2.0 * shear * (axial[l] - radial[l] - 1.5 * plastic[l]));
        if self.depends_on_pressure {
            slices.yield_point.forget();
        }
        let elastic_to = slices.yield_point.elastic_to();
        let beyond = flags(|l| (present[l] > 0.0) & (trial[l].abs() > elastic_to[l]));
        (stage.trial, stage.beyond, stage.flows) = (trial, beyond, any(&beyond));
        slices.strain = axial;
        slices.pressure = [slices.pressure[1], pressure];
    }

    /// Finds the plastic strain of slices that flow by a law of the library, eight at a time.
    #[inline(always)]
    fn flow_in_lanes<L>(&self, law: &L, slices: &mut Slice<Lanes>, stage: &mut Stage)
    where
        L: PerLane,
        L::One: LaneStrength,
    {
        let per_time = if self.metal.rate_effects {
            1.0 / self.time_step
        } else {
            0.0
        };
        let (trial, beyond) = (stage.trial, stage.beyond);
        let trial = LaneTrial {
            stress: lanes(|l| trial[l].abs()),
            modulus: Lanes::all(3.0 * self.metal.shear_modulus),
            pressure_fall: Lanes::all(0.0),
            per_time: Lanes::all(per_time),
            plastic_strain: slices.plastic.strain,
            temperature: slices.plastic.temperature,
            pressure: slices.pressure[1],
        };
        stage.increment = plastic_increments(law, &mut slices.yield_point, &trial, &beyond);
    }

    /// The same by a law of the caller's own, one by one.
    fn flow_one_by_one(&self, slices: &mut Slice<Lanes>, stage: &mut Stage) {
        stage.increment = Lanes::all(0.0);
        for l in (0..LANES).filter(|l| stage.beyond[*l] > 0.0) {
            let mut one = slices.lane(l);
            stage.increment[l] = one.plastic_increment(self.metal, stage.trial[l], self.time_step);
            slices.set_lane(l, one);
        }
    }

    /// Goes on to the stresses and forces; gives the plastic work [J].
    #[inline(always)]
    pub(super) fn respond(&self, slices: &mut Slice<Lanes>, stage: &Stage) -> Lanes {
        let step_before = slices.plastic.step;
        slices.plastic.step = Lanes::all(0.0);
        let difference = settled(if stage.flows {
            self.flow(slices, stage)
        } else {
            stage.trial
        });
        let (pressure, inverse) = (slices.pressure[1], &stage.inverse);
        let (before, plastic_step) = (slices.difference[1], slices.plastic.step);
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

    /// Takes the plastic strains; gives the stress differences that are left [Pa].
    #[inline(always)]
    fn flow(&self, slices: &mut Slice<Lanes>, stage: &Stage) -> Lanes {
        let Metal {
            shear_modulus,
            heating,
            ..
        } = *self.metal;
        let per_time = 1.0 / self.time_step;
        let (trial, increment) = (stage.trial, stage.increment);
        let (before, plastic) = (slices.difference[1], slices.plastic);
        let (mut after, mut difference) = (plastic, trial);
        for l in 0..LANES {
            let mut one = plastic.lane(l);
            one.add(increment[l], trial[l], per_time);
            difference[l] = trial[l] - 3.0 * shear_modulus * one.step;
            one.heat(heating, [before[l], difference[l]], increment[l]);
            after.set_lane(l, one);
        }
        slices.plastic = after;
        difference
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
                here.yield_point.stress(),
                ahead(&here.yield_point.stress(), next.yield_point.stress()),
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

/// Finds the plastic strain of all slices that flow.
pub(super) struct Flow<'a> {
    pub(super) step: &'a Step<'a>,
    pub(super) slices: &'a mut Blocks<Slice<Lanes>>,
    pub(super) stages: &'a mut [Stage],
}

impl Flow<'_> {
    /// By the strength law of the metal.
    #[inline(always)]
    pub(super) fn by_law(mut self) {
        match self.step.metal.strength.in_lanes() {
            Some(law) => law.visit(self),
            None => {
                let step = self.step;
                for (slices, stage) in self.flowing() {
                    step.flow_one_by_one(slices, stage);
                }
            }
        }
    }

    /// Blocks with a slice that flows.
    #[inline(always)]
    fn flowing(&mut self) -> impl Iterator<Item = (&mut Slice<Lanes>, &mut Stage)> {
        let stages = self.slices.each_mut().zip(&mut *self.stages);
        stages.filter(|(_, stage)| stage.flows)
    }
}

impl LawVisitor<f64> for Flow<'_> {
    type Output = ();

    #[inline(always)]
    fn visit<L>(mut self, law: &L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let step = self.step;
        for (slices, stage) in self.flowing() {
            step.flow_in_lanes(law, slices, stage);
        }
    }
}
