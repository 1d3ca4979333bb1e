//! Flow of elements, gathered from all lanes: the return of a trial stress to the yield surface.

use super::{
    bundle::{Body, Flow, Node, Spring},
    lanes::{LANES, Lanes, larger},
};
use crate::{
    material::{self, FlowState, Hardening, Trial, YieldPoint},
    power::{exponential, log_ratio, small_exponential},
};

/// Elastic strain from which a trial is done anew: less than the one up to which it is exact.
const LARGE: f64 = 0.09;

/// The lanes whose bits are set in a number, and after them others.
pub(super) const SET_LANES: [[u32; LANES]; 256] = {
    let mut table = [[0; LANES]; 256];
    let mut bits = 0;
    while bits < 256 {
        let (mut count, mut lane) = (0, 0);
        while lane < LANES {
            if bits >> lane & 1 == 1 {
                table[bits][count] = lane as u32;
                count += 1;
            }
            lane += 1;
        }
        bits += 1;
    }
    table
};

/// Returns trial stresses to the yield surface, those of eight places at a time: few lanes of an element flow in the same step.
///
/// `places` holds elements and lanes; room for eight more than `count` lets the last one stand in for those that are missing.
/// Element `e` lies between the nodes `e` and `e + 1` of `nodes`.
#[inline(always)]
pub(super) fn flow(
    places: &mut [(u32, u32)],
    count: usize,
    (springs, flows, nodes): (&mut [Spring], &mut [Flow], &[Node]),
    body: &Body,
    rate: &Lanes,
    now: usize,
) {
    if count == 0 {
        return;
    }
    let last = places[count - 1];
    places[count..count + LANES].fill(last);
    for places in places[..count.next_multiple_of(LANES)].chunks_exact(LANES) {
        flow_eight(places, (springs, flows, nodes), body, rate, now);
    }
}

#[inline(always)]
fn flow_eight(
    places: &[(u32, u32)],
    (springs, flows, nodes): (&mut [Spring], &mut [Flow], &[Node]),
    body: &Body,
    rate: &Lanes,
    now: usize,
) {
    let mut trial = [0.0; LANES];
    let mut stress_before = [0.0; LANES];
    let mut yield_stress = [0.0; LANES];
    let mut unloaded = [0.0; LANES];
    let mut strain = [0.0; LANES];
    let mut slope = [0.0; LANES];
    let mut axial = [0.0; LANES];
    let mut largest_rate = [0.0; LANES];
    let mut temperature = [0.0; LANES];
    let mut modulus = [0.0; LANES];
    let mut heating = [0.0; LANES];
    let mut coefficient = [0.0; LANES];
    let mut exponent = [0.0; LANES];
    let mut first_strain = [0.0; LANES];
    let mut per_time = [0.0; LANES];
    for (p, &(element, lane)) in places.iter().enumerate() {
        let (spring, flow, l) = (
            &springs[element as usize],
            &flows[element as usize],
            lane as usize % LANES,
        );
        trial[p] = spring.stress[1 - now].0[l];
        stress_before[p] = spring.stress[now].0[l];
        yield_stress[p] = spring.yield_stress.0[l];
        unloaded[p] = spring.unloaded_length.0[l];
        strain[p] = flow.plastic_strain.0[l];
        slope[p] = flow.strain_slope.0[l];
        axial[p] = flow.plastic_axial.0[l];
        largest_rate[p] = flow.largest_rate.0[l];
        temperature[p] = flow.temperature.0[l];
        modulus[p] = body.modulus.0[l];
        heating[p] = body.heating.0[l];
        coefficient[p] = body.coefficient.0[l];
        exponent[p] = body.exponent.0[l];
        first_strain[p] = body.first_strain.0[l];
        per_time[p] = rate.0[l];
    }
    let mut increment = [0.0; LANES];
    let mut next_yield = [0.0; LANES];
    let mut next_slope = [0.0; LANES];
    let mut left_over = 0;
    for p in 0..LANES {
        let size = trial[p].abs();
        let law = Hardening {
            coefficient: coefficient[p],
            exponent: exponent[p],
            first_strain: first_strain[p],
        };
        let first = (size - yield_stress[p]) / (modulus[p] + slope[p]);
        let reached = strain[p] + first;
        let (stress, strain_slope) = law.at(reached);
        let excess = size - modulus[p] * first - stress;
        let step = excess / (modulus[p] + strain_slope);
        let newton = first + step;
        let is_last = material::is_last(size, excess, step, strain_slope * first, reached * first)
            & (newton > 0.0)
            & (size <= modulus[p] * LARGE);
        left_over |= u8::from(!is_last) << p;
        increment[p] = newton;
        next_yield[p] = size - modulus[p] * newton;
        next_slope[p] = strain_slope;
    }
    if left_over != 0 {
        for p in (0..LANES).filter(|p| left_over >> p & 1 == 1) {
            let (element, lane) = places[p];
            let law = Hardening {
                coefficient: coefficient[p],
                exponent: exponent[p],
                first_strain: first_strain[p],
            };
            let (e, l) = (element as usize, lane as usize % LANES);
            let length = nodes[e + 1].position.0[l] - nodes[e].position.0[l];
            trial[p] = modulus[p] * log_ratio(unloaded[p], length);
            [increment[p], next_yield[p], next_slope[p]] = iterate(
                law,
                [yield_stress[p], slope[p]],
                strain[p],
                trial[p],
                modulus[p],
            );
        }
    }
    let mut stress = [0.0; LANES];
    let mut plastic_step = [0.0; LANES];
    let mut next_rate = [0.0; LANES];
    let mut next_unloaded = [0.0; LANES];
    let mut is_large = 0;
    for p in 0..LANES {
        plastic_step[p] = increment[p].copysign(trial[p]);
        stress[p] = trial[p] - modulus[p] * plastic_step[p];
        let (shrinking, is_exact) = small_exponential(-plastic_step[p]);
        is_large |= u8::from(!is_exact) << p;
        next_unloaded[p] = unloaded[p] * shrinking;
        axial[p] += plastic_step[p];
        strain[p] += increment[p];
        next_rate[p] = larger(increment[p] * per_time[p], largest_rate[p]);
        let work = 0.5 * (stress_before[p] + stress[p]).abs() * increment[p];
        temperature[p] += heating[p] * work;
    }
    for (p, &(element, lane)) in places.iter().enumerate() {
        let (spring, flow, l) = (
            &mut springs[element as usize],
            &mut flows[element as usize],
            lane as usize % LANES,
        );
        if is_large >> p & 1 == 1 {
            next_unloaded[p] = unloaded[p] * exponential(-plastic_step[p]);
        }
        spring.stress[1 - now].0[l] = stress[p];
        spring.unloaded_length.0[l] = next_unloaded[p];
        spring.yield_stress.0[l] = next_yield[p];
        flow.plastic_step.0[l] = plastic_step[p];
        flow.plastic_strain.0[l] = strain[p];
        flow.plastic_axial.0[l] = axial[p];
        flow.strain_slope.0[l] = next_slope[p];
        flow.temperature.0[l] = temperature[p];
        flow.largest_rate.0[l] = next_rate[p];
    }
}

/// The return of the single run: plastic increment, yield stress and slope.
#[cold]
#[inline(never)]
fn iterate(
    law: Hardening,
    [stress, strain_slope]: [f64; 2],
    plastic_strain: f64,
    trial: f64,
    modulus: f64,
) -> [f64; 3] {
    let mut point = YieldPoint::known(stress, strain_slope);
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
    [increment, point.stress(), point.strain_slope()]
}
