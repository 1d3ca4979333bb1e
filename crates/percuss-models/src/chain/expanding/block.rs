//! Eight slices of a projectile side by side: [`Slice::deform`] where strength is a power of the plastic strain, and what limits the
//! next step, with the same bits.

// Loops over the places run along many arrays at once.
#![allow(clippy::needless_range_loop)]

#[cfg(test)]
#[path = "block_tests.rs"]
mod tests;

use pulp::NullaryFnOnce;

use super::{
    node::Node,
    rod::Fastest,
    slice::{Metal, Slice},
};
use crate::{
    lanes::{LANES, Lanes, lanes, larger},
    material::{Hardening, YieldPoint, first_return},
};

/// Slices that have their lengths and radii, and go on to the stresses that belong to them; slice `i` is between the nodes `i` and
/// `i + 1`.
pub(super) struct Respond<'a> {
    pub(super) nodes: &'a [Node],
    pub(super) slices: &'a mut [Slice],
    pub(super) metal: &'a Metal,
    pub(super) law: Hardening,
    pub(super) time_step: f64,
}

impl NullaryFnOnce for Respond<'_> {
    type Output = (f64, Fastest);

    /// Gives the plastic work between the half steps around the current time [J], and what limits the next step.
    #[inline(always)]
    fn call(self) -> (f64, Fastest) {
        let Self { metal, nodes, .. } = self;
        let mut work = 0.0;
        let mut limits = [Lanes::all(0.0); 2];
        let (blocks, rest) = self.slices.as_chunks_mut();
        let of_rest = blocks.len() * LANES;
        for (b, slices) in blocks.iter_mut().enumerate() {
            let nodes = &nodes[b * LANES..=(b + 1) * LANES];
            let (done, next) = respond(slices, nodes, metal, self.law, self.time_step);
            for p in 0..LANES {
                work += done[p];
            }
            for (limit, next) in limits.iter_mut().zip(next) {
                for p in 0..LANES {
                    limit[p] = larger(next[p], limit[p]);
                }
            }
        }
        let [stiffness, rate] = limits.map(|limit| limit.iter().copied().fold(0.0, f64::max));
        let mut fastest = Fastest { stiffness, rate };
        for (slice, nodes) in rest.iter_mut().zip(nodes[of_rest..].windows(2)) {
            work += slice.deform(metal, self.time_step);
            fastest.follow(slice, nodes, metal);
        }
        (work, fastest)
    }
}

#[inline(always)]
fn gather(slices: &[Slice; LANES], number: impl Fn(&Slice) -> f64) -> Lanes {
    lanes(|p| number(&slices[p]))
}

/// Plastic work of eight slices; their stiffness and their rates of strain.
#[inline(always)]
fn respond(
    slices: &mut [Slice; LANES],
    nodes: &[Node],
    metal: &Metal,
    law: Hardening,
    time_step: f64,
) -> (Lanes, [Lanes; 2]) {
    let axial = gather(slices, Slice::strain);
    let radial = gather(slices, Slice::radial_strain);
    let length = gather(slices, |slice| slice.length);
    let radius = gather(slices, |slice| slice.radius);
    let volume = gather(slices, Slice::rest_volume);
    let radial_velocity = gather(slices, |slice| slice.radial_velocity);
    let mut plastic_axial = gather(slices, |slice| slice.plastic_axial);
    let mut plastic_strain = gather(slices, |slice| slice.plastic_strain);
    let step_before = gather(slices, |slice| slice.plastic_step);
    let difference_before = gather(slices, |slice| slice.difference[1]);
    let mut yield_stress = gather(slices, Slice::yield_stress);
    let mut slope = gather(slices, |slice| slice.yield_point.strain_slope());
    let mut largest_rate = gather(slices, |slice| slice.largest_rate);
    let mut temperature = gather(slices, |slice| slice.temperature);
    let velocity: [f64; LANES + 1] = std::array::from_fn(|p| nodes[p].velocity);

    let modulus = 3.0 * metal.shear_modulus;
    let mut pressure = Lanes::all(0.0);
    let mut difference = Lanes::all(0.0);
    let mut flows = 0_u8;
    for p in 0..LANES {
        pressure[p] = metal.bulk_modulus * (axial[p] + 2.0 * radial[p]);
        let elastic = axial[p] - radial[p] - 1.5 * plastic_axial[p];
        difference[p] = 2.0 * metal.shear_modulus * elastic;
        flows |= u8::from(difference[p].abs() > yield_stress[p]) << p;
    }
    let trial = difference;
    let mut plastic_step = Lanes::all(0.0);
    let mut left_over = 0;
    if flows != 0 {
        for p in 0..LANES {
            let size = trial[p].abs();
            let before = [yield_stress[p], slope[p]];
            let returned = first_return(law, before, plastic_strain[p], size, modulus);
            let increment = returned.increment;
            let step = increment.copysign(trial[p]);
            let stress = trial[p] - modulus * step;
            let mean = 0.5 * (difference_before[p] + stress).abs();
            let is_flowing = size > yield_stress[p];
            left_over |= u8::from(is_flowing & !returned.is_last) << p;
            // What does not flow stays what it was.
            let or = |next: f64, before: f64| if is_flowing { next } else { before };
            plastic_step[p] = or(step, 0.0);
            difference[p] = or(stress, trial[p]);
            plastic_axial[p] = or(plastic_axial[p] + step, plastic_axial[p]);
            plastic_strain[p] = or(plastic_strain[p] + increment, plastic_strain[p]);
            let rate = larger(increment / time_step, largest_rate[p]);
            largest_rate[p] = or(rate, largest_rate[p]);
            let warm = temperature[p] + metal.heating * mean * increment;
            temperature[p] = or(warm, temperature[p]);
            slope[p] = or(returned.strain_slope, slope[p]);
            yield_stress[p] = or(size - modulus * increment, yield_stress[p]);
        }
    }
    for p in (0..LANES).filter(|p| left_over >> p & 1 == 1) {
        let slice = &mut slices[p];
        // Such a strength does not depend on the pressure.
        slice.plastic_step = 0.0;
        difference[p] = slice.flow(metal, trial[p], time_step);
        plastic_step[p] = slice.plastic_step;
        plastic_axial[p] = slice.plastic_axial;
        plastic_strain[p] = slice.plastic_strain;
        largest_rate[p] = slice.largest_rate;
        temperature[p] = slice.temperature;
        yield_stress[p] = slice.yield_stress();
        slope[p] = slice.yield_point.strain_slope();
    }

    let mut axial_force = Lanes::all(0.0);
    let mut radial_force = Lanes::all(0.0);
    let mut work = Lanes::all(0.0);
    let mut stiffness = Lanes::all(0.0);
    let mut rate = Lanes::all(0.0);
    for p in 0..LANES {
        let axial_stress = pressure[p] + difference[p] / 1.5;
        axial_force[p] = axial_stress * volume[p] / length[p];
        radial_force[p] = 2.0 * (pressure[p] - difference[p] / 3.0) * volume[p] / radius[p];
        work[p] = 0.5 * volume[p] * difference_before[p] * (step_before[p] + plastic_step[p]);
        stiffness[p] = metal.stiffness(axial_stress, length[p], radius[p]);
        let approach = (velocity[p] - velocity[p + 1]).abs() / length[p];
        rate[p] = larger(radial_velocity[p].abs() / radius[p], approach);
    }
    for (p, slice) in slices.iter_mut().enumerate() {
        slice.pressure = [slice.pressure[1], pressure[p]];
        slice.difference = [difference_before[p], difference[p]];
        slice.plastic_step = plastic_step[p];
        slice.plastic_axial = plastic_axial[p];
        slice.plastic_strain = plastic_strain[p];
        slice.largest_rate = largest_rate[p];
        slice.temperature = temperature[p];
        slice.yield_point = YieldPoint::known(yield_stress[p], slope[p]);
        slice.axial_force = axial_force[p];
        slice.radial_force = radial_force[p];
    }
    (work, [stiffness, rate])
}
