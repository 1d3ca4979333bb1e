//! Steps of eight cells of a rod at a time, by the equations of one.

use std::ops::Range;

use super::{
    cell::{FlowConstants, RodCell},
    law::RodLaw,
};
use crate::{
    fdm::grid::{Motions, limited},
    lanes::{LANES, Lanes, PerLane, any, blocks_of, flags, lanes, load, smaller, store},
    material::{LaneStrength, LaneTrial, LawVisitor, plastic_increments},
};

#[cfg(test)]
#[path = "blocks_tests.rs"]
mod tests;

/// Loads cells eight at a time, by the equations of one.
pub(super) struct LoadBlocks<'a> {
    pub(super) rod: &'a RodLaw,
    pub(super) blocks: &'a mut [RodCell<Lanes>],
    pub(super) range: Range<usize>,
    pub(super) motions: &'a Motions<'a>,
    pub(super) forces: &'a mut [f64],
}

impl LawVisitor<f64> for LoadBlocks<'_> {
    type Output = ();

    #[inline(always)]
    fn visit<L>(self, law: &L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let rod = self.rod;
        let constants = rod.constants(self.motions.since_load);
        for (b, own) in blocks_of(self.range) {
            let (block, first) = (&mut self.blocks[b], b * LANES);
            let length = load(self.motions.lengths, first);
            let (elastic, steps_before) = (block.elastic, block.plastic.step);
            for l in 0..LANES {
                let (before, mut one) = (elastic.lane(l), elastic.lane(l));
                one.stretch(length[l], rod.modulus);
                block.elastic.choose(l, own.0[l], one, before);
            }
            for l in 0..LANES {
                block.plastic.step.choose(l, own.0[l], 0.0, steps_before[l]);
            }
            let (stress, most) = (block.elastic.stress, block.yield_point.elastic_to());
            let flows = flags(|l| own.0[l] & (stress[l].abs() > most[l]));
            if any(&flows) {
                rod.flow_together(law, block, &flows, &constants);
            }
            let (mut work, steps) = (block.plastic_work, block.plastic.step);
            for l in 0..LANES {
                let (before, one) = (work[l], block.elastic.lane(l));
                let done = before + one.plastic_work(block.volume[l], steps_before[l] + steps[l]);
                work.choose(l, own.0[l], done, before);
            }
            block.plastic_work = work;
            if !rod.viscosity.is_none() {
                let approach = load(self.motions.approaches, first);
                for l in 0..LANES {
                    let before = block.viscous_pressure[l];
                    let pressure = rod.viscous_pressure(approach[l]);
                    block.viscous_pressure.choose(l, own.0[l], pressure, before);
                }
            }
            let forces = lanes(|l| {
                let stress = block.elastic.stress[l] + block.viscous_pressure[l];
                stress * block.volume[l] / block.elastic.length[l]
            });
            store(self.forces, first, &forces);
        }
    }
}

impl RodLaw {
    /// Lets the cells of a block flow that have a 1 in `flows`.
    #[inline(always)]
    fn flow_together<L>(
        &self,
        law: &L,
        block: &mut RodCell<Lanes>,
        flows: &Lanes,
        constants: &FlowConstants,
    ) where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let elapsed = self.elapsed(constants);
        let (elastic, plastic) = (block.elastic, block.plastic);
        let mut trial = LaneTrial::<Lanes>::default();
        for l in 0..LANES {
            let elastic = elastic.lane(l);
            let start = plastic.lane(l).state(elastic.stress);
            let one = LaneTrial::new(&start, &elastic.trial(self.modulus, elapsed));
            trial.set_lane(l, one);
        }
        let increments = plastic_increments(law, &mut block.yield_point, &trial, flows);
        for l in 0..LANES {
            let (mut stress, mut flow) = (elastic.lane(l), plastic.lane(l));
            flow.take(&mut stress, increments[l], constants);
            let is_flowing = increments[l] > 0.0;
            block.elastic.choose(l, is_flowing, stress, elastic.lane(l));
            block.plastic.choose(l, is_flowing, flow, plastic.lane(l));
        }
    }
}

/// Finds the smallest stable step of the cells of a range, without viscosity.
pub(super) struct StableStep<'a> {
    pub(super) rod: &'a RodLaw,
    pub(super) blocks: &'a [RodCell<Lanes>],
    pub(super) range: Range<usize>,
    pub(super) lengths: &'a [f64],
    pub(super) approaches: &'a [f64],
}

impl pulp::NullaryFnOnce for StableStep<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let mut shortest = Lanes::all(f64::INFINITY);
        for (b, own) in blocks_of(self.range) {
            let (stress, first) = (self.blocks[b].elastic.stress, b * LANES);
            let length = load(self.lengths, first);
            let approach = load(self.approaches, first);
            for l in 0..LANES {
                let stable = self.rod.wave_time(stress[l], length[l]);
                let step = limited(stable, length[l], approach[l]);
                let step = if own.0[l] { step } else { f64::INFINITY };
                shortest.0[l] = smaller(step, shortest.0[l]);
            }
        }
        shortest.0.into_iter().fold(f64::INFINITY, f64::min)
    }
}
