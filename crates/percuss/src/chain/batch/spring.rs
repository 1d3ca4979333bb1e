//! Constitutive update of an element in every lane: `Element::deform` for a power of the plastic strain.

use super::{
    bundle::{Body, Flow, Node, Spring},
    lanes::{LANES, Lanes, larger, smaller},
};
use crate::{
    material::{self, FlowState, Hardening, Trial, YieldPoint},
    power::{exponential, log_ratio, small_exponential, small_log_ratio},
};

/// Elastic strain from which a trial is done anew: less than the one up to which it is exact.
const LARGE: f64 = 0.09;

/// What a pass over the elements adds up and finds.
#[derive(Clone, Copy)]
pub(super) struct Pass {
    pub(super) stable_step: Lanes,
    /// Largest rate of approach, as a part of the length.
    pub(super) fastest: Lanes,
    /// What is left of the shortest element, and of the longest, until it erodes.
    pub(super) left: Lanes,
}

impl Pass {
    pub(super) const START: Self = Self {
        stable_step: Lanes::all(f64::INFINITY),
        fastest: Lanes::all(0.0),
        left: Lanes::all(f64::INFINITY),
    };
}

impl Spring {
    /// Stress if nothing flows, as the one after the step; tells a bit for every lane that flows or has to be looked at.
    #[inline(always)]
    pub(super) fn try_elastic(&mut self, ends: [&Node; 2], body: &Body, now: usize) -> u8 {
        let [back, front] = ends.map(|node| node.position.0);
        let unloaded = self.unloaded_length.0;
        let yield_stress = self.yield_stress.0;
        let modulus = body.modulus.0;
        let mut trial = [0.0; LANES];
        let mut beyond = 0;
        for l in 0..LANES {
            let (elastic, is_exact) = small_log_ratio(unloaded[l], front[l] - back[l]);
            trial[l] = modulus[l] * elastic;
            beyond |= u8::from((trial[l].abs() > yield_stress[l]) | !is_exact) << l;
        }
        self.stress[1 - now] = Lanes(trial);
        self.plastic_step[1 - now] = Lanes::all(0.0);
        beyond
    }

    /// What follows from length and stress; says whether to do all of it again would change nothing.
    #[inline(always)]
    pub(super) fn finish(
        &mut self,
        ends: [&Node; 2],
        body: &Body,
        now: usize,
        work: &mut Lanes,
        pass: &mut Pass,
    ) -> bool {
        let [back, front] = ends.map(|node| node.position.0);
        let [back_velocity, front_velocity] = ends.map(|node| node.velocity.0);
        let (stress_before, stress) = (self.stress[now].0, self.stress[1 - now].0);
        let (step_before, step) = (self.plastic_step[now].0, self.plastic_step[1 - now].0);
        let (volume, compliance, slowness) = (body.volume.0, body.compliance.0, body.slowness.0);
        let (shortest, longest) = (body.shortest.0, body.longest.0);
        let mut force = [0.0; LANES];
        let mut stable_step = [0.0; LANES];
        let mut changes = false;
        for l in 0..LANES {
            let length = front[l] - back[l];
            let inverse = 1.0 / length;
            force[l] = stress[l] * volume[l] * inverse;
            work.0[l] += volume[l] * (0.5 * stress_before[l] * (step_before[l] + step[l]));
            let stiffening = 0.5 * larger(smaller(stress[l] * compliance[l], 1.0), 0.0);
            stable_step[l] = length * slowness[l] * (1.0 - stiffening);
            pass.stable_step.0[l] = smaller(stable_step[l], pass.stable_step.0[l]);
            let approach = (back_velocity[l] - front_velocity[l]).abs() * inverse;
            pass.fastest.0[l] = larger(approach, pass.fastest.0[l]);
            let left = smaller(length - shortest[l], longest[l] - length);
            pass.left.0[l] = smaller(left, pass.left.0[l]);
            changes |= (step_before[l] != 0.0) | (step[l] != 0.0) | (stress[l] != stress_before[l]);
        }
        self.force = Lanes(force);
        self.stable_step = Lanes(stable_step);
        !changes
    }
}

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
        spring.plastic_step[1 - now].0[l] = plastic_step[p];
        spring.unloaded_length.0[l] = next_unloaded[p];
        spring.yield_stress.0[l] = next_yield[p];
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
