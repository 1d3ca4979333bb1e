//! Flow of elements, gathered from all lanes: the return of a trial stress to the yield surface.

use super::bundle::{Body, Flow, Node, Spring};
use crate::{
    lanes::{LANES, Lanes, larger},
    material::{FlowState, Hardening, Trial, YieldPoint, first_return},
    power::{exponential, log_ratio, small_exponential},
};

/// Elastic strain from which a trial is done anew: less than the one up to which it is exact.
const LARGE: f64 = 0.09;

/// What a return to the yield surface starts from, in eight places.
#[derive(Default)]
pub(in crate::chain) struct Start {
    pub(in crate::chain) trial: [f64; LANES],
    pub(in crate::chain) stress_before: [f64; LANES],
    pub(in crate::chain) yield_stress: [f64; LANES],
    pub(in crate::chain) slope: [f64; LANES],
    pub(in crate::chain) unloaded: [f64; LANES],
    pub(in crate::chain) strain: [f64; LANES],
    pub(in crate::chain) axial: [f64; LANES],
    pub(in crate::chain) largest_rate: [f64; LANES],
    pub(in crate::chain) temperature: [f64; LANES],
    pub(in crate::chain) modulus: [f64; LANES],
    pub(in crate::chain) heating: [f64; LANES],
    pub(in crate::chain) coefficient: [f64; LANES],
    pub(in crate::chain) exponent: [f64; LANES],
    pub(in crate::chain) first_strain: [f64; LANES],
    pub(in crate::chain) per_time: [f64; LANES],
}

/// What it ends with.
pub(in crate::chain) struct End {
    pub(in crate::chain) stress: [f64; LANES],
    pub(in crate::chain) yield_stress: [f64; LANES],
    pub(in crate::chain) slope: [f64; LANES],
    pub(in crate::chain) unloaded: [f64; LANES],
    pub(in crate::chain) plastic_step: [f64; LANES],
    pub(in crate::chain) strain: [f64; LANES],
    pub(in crate::chain) axial: [f64; LANES],
    pub(in crate::chain) largest_rate: [f64; LANES],
    pub(in crate::chain) temperature: [f64; LANES],
}

/// Lets an element flow in those lanes whose bits are set.
#[inline(always)]
pub(super) fn flow_in_place(
    lanes: u8,
    (spring, flow): (&mut Spring, &mut Flow),
    ends: [&Node; 2],
    body: &Body,
    rate: &Lanes,
    now: usize,
) {
    let start = Start {
        trial: spring.stress[1 - (now & 1)].0,
        stress_before: spring.stress[now & 1].0,
        yield_stress: spring.yield_stress.0,
        slope: flow.strain_slope.0,
        unloaded: spring.unloaded_length.0,
        strain: flow.plastic_strain.0,
        axial: flow.plastic_axial.0,
        largest_rate: flow.largest_rate.0,
        temperature: flow.temperature.0,
        modulus: body.modulus.0,
        heating: body.heating.0,
        coefficient: body.coefficient.0,
        exponent: body.exponent.0,
        first_strain: body.first_strain.0,
        per_time: rate.0,
    };
    let length = |l: usize| ends[1].position.0[l] - ends[0].position.0[l];
    let end = start.flow(lanes, length);
    for (of, end) in [
        (&mut spring.stress[1 - (now & 1)], end.stress),
        (&mut spring.yield_stress, end.yield_stress),
        (&mut spring.unloaded_length, end.unloaded),
        (&mut flow.strain_slope, end.slope),
        (&mut flow.plastic_step, end.plastic_step),
        (&mut flow.plastic_strain, end.strain),
        (&mut flow.plastic_axial, end.axial),
        (&mut flow.largest_rate, end.largest_rate),
        (&mut flow.temperature, end.temperature),
    ] {
        let before = of.0;
        for l in 0..LANES {
            let flows = lanes >> l & 1 == 1;
            of.0[l] = if flows { end[l] } else { before[l] };
        }
    }
}

/// Lets elements flow in single lanes, eight such places at a time.
///
/// `places` holds elements and lanes; room for eight more than `count` lets the last one stand in for those that are missing.
/// Element `e` lies between the nodes `e` and `e + 1` of `nodes`.
#[inline(always)]
pub(super) fn flow_gathered(
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
    let mut start = Start::default();
    for (p, &(element, lane)) in places.iter().enumerate() {
        let (e, l) = (element as usize, lane as usize % LANES);
        let (spring, flow) = (&springs[e], &flows[e]);
        start.trial[p] = spring.stress[1 - (now & 1)].0[l];
        start.stress_before[p] = spring.stress[now & 1].0[l];
        start.yield_stress[p] = spring.yield_stress.0[l];
        start.slope[p] = flow.strain_slope.0[l];
        start.unloaded[p] = spring.unloaded_length.0[l];
        start.strain[p] = flow.plastic_strain.0[l];
        start.axial[p] = flow.plastic_axial.0[l];
        start.largest_rate[p] = flow.largest_rate.0[l];
        start.temperature[p] = flow.temperature.0[l];
        start.modulus[p] = body.modulus.0[l];
        start.heating[p] = body.heating.0[l];
        start.coefficient[p] = body.coefficient.0[l];
        start.exponent[p] = body.exponent.0[l];
        start.first_strain[p] = body.first_strain.0[l];
        start.per_time[p] = rate.0[l];
    }
    let length = |p: usize| {
        let (element, lane) = places[p];
        let (e, l) = (element as usize, lane as usize % LANES);
        nodes[e + 1].position.0[l] - nodes[e].position.0[l]
    };
    let end = start.flow(u8::MAX, length);
    for (p, &(element, lane)) in places.iter().enumerate() {
        let (e, l) = (element as usize, lane as usize % LANES);
        let (spring, flow) = (&mut springs[e], &mut flows[e]);
        spring.stress[1 - (now & 1)].0[l] = end.stress[p];
        spring.yield_stress.0[l] = end.yield_stress[p];
        spring.unloaded_length.0[l] = end.unloaded[p];
        flow.strain_slope.0[l] = end.slope[p];
        flow.plastic_step.0[l] = end.plastic_step[p];
        flow.plastic_strain.0[l] = end.strain[p];
        flow.plastic_axial.0[l] = end.axial[p];
        flow.largest_rate.0[l] = end.largest_rate[p];
        flow.temperature.0[l] = end.temperature[p];
    }
}

impl Start {
    /// Returns the trial stresses to the yield surface; those places count whose bits are set in `places`.
    #[inline(always)]
    pub(in crate::chain) fn flow(&self, places: u8, length: impl Fn(usize) -> f64) -> End {
        let mut trial = self.trial;
        let mut increment = [0.0; LANES];
        let mut yield_stress = [0.0; LANES];
        let mut slope = [0.0; LANES];
        let mut left_over = 0;
        for p in 0..LANES {
            let modulus = self.modulus[p];
            let size = trial[p].abs();
            let before = [self.yield_stress[p], self.slope[p]];
            let returned = first_return(self.law(p), before, self.strain[p], size, modulus);
            let is_last = returned.is_last & (size <= modulus * LARGE);
            left_over |= u8::from(!is_last) << p;
            increment[p] = returned.increment;
            yield_stress[p] = size - modulus * returned.increment;
            slope[p] = returned.strain_slope;
        }
        left_over &= places;
        if left_over != 0 {
            for p in (0..LANES).filter(|p| left_over >> p & 1 == 1) {
                trial[p] = self.modulus[p] * log_ratio(self.unloaded[p], length(p));
                [increment[p], yield_stress[p], slope[p]] = iterate(
                    self.law(p),
                    [self.yield_stress[p], self.slope[p]],
                    self.strain[p],
                    trial[p],
                    self.modulus[p],
                );
            }
        }
        let mut end = End {
            stress: [0.0; LANES],
            yield_stress,
            slope,
            unloaded: [0.0; LANES],
            plastic_step: [0.0; LANES],
            strain: [0.0; LANES],
            axial: [0.0; LANES],
            largest_rate: [0.0; LANES],
            temperature: [0.0; LANES],
        };
        let mut is_large = 0;
        for p in 0..LANES {
            let plastic_step = increment[p].copysign(trial[p]);
            let stress = trial[p] - self.modulus[p] * plastic_step;
            let (shrinking, is_exact) = small_exponential(-plastic_step);
            is_large |= u8::from(!is_exact) << p;
            end.unloaded[p] = self.unloaded[p] * shrinking;
            end.axial[p] = self.axial[p] + plastic_step;
            end.strain[p] = self.strain[p] + increment[p];
            end.largest_rate[p] = larger(increment[p] * self.per_time[p], self.largest_rate[p]);
            let work = 0.5 * (self.stress_before[p] + stress).abs() * increment[p];
            end.temperature[p] = self.temperature[p] + self.heating[p] * work;
            end.plastic_step[p] = plastic_step;
            end.stress[p] = stress;
        }
        is_large &= places;
        if is_large != 0 {
            for p in (0..LANES).filter(|p| is_large >> p & 1 == 1) {
                end.unloaded[p] = self.unloaded[p] * exponential(-end.plastic_step[p]);
            }
        }
        end
    }

    #[inline(always)]
    fn law(&self, p: usize) -> Hardening {
        Hardening {
            coefficient: self.coefficient[p],
            exponent: self.exponent[p],
            first_strain: self.first_strain[p],
        }
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
