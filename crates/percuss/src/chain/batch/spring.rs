//! Constitutive update of an element in every lane: `Element::deform` for a power of the plastic strain.

use super::{
    bundle::{Body, Flow, Node, Spring},
    lanes::{LANES, Lanes, larger, smaller},
};
use crate::{
    material::{self, FlowState, Hardening, Trial, YieldPoint},
    power::{exponential, log_ratio, small_exponential, small_log_ratio},
};

/// What a pass over the elements adds up and finds.
#[derive(Clone, Copy)]
pub(super) struct Pass {
    pub(super) plastic_work: Lanes,
    pub(super) stable_step: Lanes,
    /// Largest rate of approach, as a part of the length.
    pub(super) fastest: Lanes,
    /// What is left of the shortest element, and of the longest, until it erodes.
    pub(super) left: Lanes,
}

impl Pass {
    pub(super) const START: Self = Self {
        plastic_work: Lanes::all(0.0),
        stable_step: Lanes::all(f64::INFINITY),
        fastest: Lanes::all(0.0),
        left: Lanes::all(f64::INFINITY),
    };

    /// Keeps up the stable time step where nothing changes.
    #[inline(always)]
    pub(super) fn pass_by(&mut self, spring: &Spring, now: usize, ends: [&Node; 2], body: &Body) {
        let [back, front] = ends.map(|node| node.position.0);
        let stress = spring.stress[now].0;
        let (compliance, slowness) = (body.compliance.0, body.slowness.0);
        let stable = self.stable_step.0;
        let mut next = [0.0; LANES];
        for l in 0..LANES {
            let limit = stable_step(front[l] - back[l], stress[l], compliance[l], slowness[l]);
            next[l] = smaller(limit, stable[l]);
        }
        self.stable_step = Lanes(next);
    }
}

/// Largest stable time step of an element.
#[inline(always)]
fn stable_step(length: f64, stress: f64, compliance: f64, slowness: f64) -> f64 {
    let stiffening = 0.5 * larger(smaller(stress * compliance, 1.0), 0.0);
    length * slowness * (1.0 - stiffening)
}

/// Elastic trial of every lane, and what flow makes of it.
struct Returned {
    stress: [f64; LANES],
    plastic_step: [f64; LANES],
}

impl Spring {
    /// Brings the element to the length that its ends give it; says whether doing so again would change nothing.
    #[inline(always)]
    pub(super) fn update(
        &mut self,
        flow: &mut Flow,
        ends: [&Node; 2],
        body: &Body,
        rate: Lanes,
        now: usize,
        pass: &mut Pass,
    ) -> bool {
        let [back, front] = ends.map(|node| node.position.0);
        let [back_velocity, front_velocity] = ends.map(|node| node.velocity.0);
        let unloaded = self.unloaded_length.0;
        let yield_stress = self.yield_stress.0;
        let modulus = body.modulus.0;
        let stress_before = self.stress[now].0;
        let step_before = self.plastic_step.0;
        let mut length = [0.0; LANES];
        let mut trial = [0.0; LANES];
        let mut beyond = false;
        for l in 0..LANES {
            length[l] = front[l] - back[l];
            let (elastic, is_exact) = small_log_ratio(unloaded[l], length[l]);
            trial[l] = modulus[l] * elastic;
            beyond |= (trial[l].abs() > yield_stress[l]) | !is_exact;
        }
        let returned = if beyond {
            self.flow(flow, trial, length, body, rate, now)
        } else {
            Returned {
                stress: trial,
                plastic_step: [0.0; LANES],
            }
        };
        let (stress, step) = (returned.stress, returned.plastic_step);
        let (volume, compliance, slowness) = (body.volume.0, body.compliance.0, body.slowness.0);
        let (shortest, longest) = (body.shortest.0, body.longest.0);
        let (work, stable, fastest, left) = (
            pass.plastic_work.0,
            pass.stable_step.0,
            pass.fastest.0,
            pass.left.0,
        );
        let mut force = [0.0; LANES];
        let mut next_work = [0.0; LANES];
        let mut next_stable = [0.0; LANES];
        let mut next_fastest = [0.0; LANES];
        let mut next_left = [0.0; LANES];
        let mut changes = false;
        for l in 0..LANES {
            let inverse = 1.0 / length[l];
            force[l] = stress[l] * volume[l] * inverse;
            next_work[l] =
                work[l] + volume[l] * (0.5 * stress_before[l] * (step_before[l] + step[l]));
            let limit = stable_step(length[l], stress[l], compliance[l], slowness[l]);
            next_stable[l] = smaller(limit, stable[l]);
            let approach = (back_velocity[l] - front_velocity[l]).abs() * inverse;
            next_fastest[l] = larger(approach, fastest[l]);
            let here = smaller(length[l] - shortest[l], longest[l] - length[l]);
            next_left[l] = smaller(here, left[l]);
            changes |= (step[l] != 0.0) | (stress[l] != stress_before[l]);
        }
        self.stress[1 - now] = Lanes(stress);
        self.plastic_step = Lanes(step);
        self.force = Lanes(force);
        pass.plastic_work = Lanes(next_work);
        pass.stable_step = Lanes(next_stable);
        pass.fastest = Lanes(next_fastest);
        pass.left = Lanes(next_left);
        !changes
    }

    /// Returns the trial stresses that lie beyond the yield surface to it.
    #[inline(always)]
    fn flow(
        &mut self,
        flow: &mut Flow,
        mut trial: [f64; LANES],
        length: [f64; LANES],
        body: &Body,
        rate: Lanes,
        now: usize,
    ) -> Returned {
        let unloaded = self.unloaded_length.0;
        let yield_stress = self.yield_stress.0;
        let (modulus, heating) = (body.modulus.0, body.heating.0);
        let (coefficient, exponent, first_strain) =
            (body.coefficient.0, body.exponent.0, body.first_strain.0);
        let (strain, slope) = (flow.plastic_strain.0, flow.strain_slope.0);
        for l in 0..LANES {
            if !small_log_ratio(unloaded[l], length[l]).1 {
                trial[l] = modulus[l] * log_ratio(unloaded[l], length[l]);
            }
        }
        let mut increment = [0.0; LANES];
        let mut next_yield = [0.0; LANES];
        let mut next_slope = [0.0; LANES];
        let mut left_over = false;
        for l in 0..LANES {
            let size = trial[l].abs();
            let flows = size > yield_stress[l];
            let law = Hardening {
                coefficient: coefficient[l],
                exponent: exponent[l],
                first_strain: first_strain[l],
            };
            let first = (size - yield_stress[l]) / (modulus[l] + slope[l]);
            let reached = strain[l] + first;
            let (stress, strain_slope) = law.at(reached);
            let excess = size - modulus[l] * first - stress;
            let step = excess / (modulus[l] + strain_slope);
            let newton = first + step;
            let curvature = strain_slope * first;
            let is_last =
                material::is_last(size, excess, step, curvature, reached * first) & (newton > 0.0);
            left_over |= flows & !is_last;
            increment[l] = if flows { newton } else { 0.0 };
            next_yield[l] = if flows {
                size - modulus[l] * newton
            } else {
                yield_stress[l]
            };
            next_slope[l] = if flows { strain_slope } else { slope[l] };
            // What one step of Newton's method does not return is told by a slope that no law has.
            next_slope[l] = if flows & !is_last {
                -1.0
            } else {
                next_slope[l]
            };
        }
        if left_over {
            for l in 0..LANES {
                if next_slope[l] < 0.0 {
                    let law = Hardening {
                        coefficient: coefficient[l],
                        exponent: exponent[l],
                        first_strain: first_strain[l],
                    };
                    let known = [yield_stress[l], slope[l]];
                    [increment[l], next_yield[l], next_slope[l]] =
                        iterate(law, known, strain[l], trial[l], modulus[l]);
                }
            }
        }
        let stress_before = self.stress[now].0;
        let (axial, largest_rate, temperature) = (
            flow.plastic_axial.0,
            flow.largest_rate.0,
            flow.temperature.0,
        );
        let rate = rate.0;
        let mut stress = [0.0; LANES];
        let mut plastic_step = [0.0; LANES];
        let mut next_unloaded = [0.0; LANES];
        let mut next_strain = [0.0; LANES];
        let mut next_axial = [0.0; LANES];
        let mut next_rate = [0.0; LANES];
        let mut next_temperature = [0.0; LANES];
        let mut is_large = false;
        for l in 0..LANES {
            plastic_step[l] = increment[l].copysign(trial[l]);
            stress[l] = trial[l] - modulus[l] * plastic_step[l];
            let (shrinking, is_exact) = small_exponential(-plastic_step[l]);
            is_large |= !is_exact;
            next_unloaded[l] = unloaded[l] * shrinking;
            next_axial[l] = axial[l] + plastic_step[l];
            next_strain[l] = strain[l] + increment[l];
            next_rate[l] = larger(increment[l] * rate[l], largest_rate[l]);
            let work = 0.5 * (stress_before[l] + stress[l]).abs() * increment[l];
            next_temperature[l] = temperature[l] + heating[l] * work;
        }
        if is_large {
            for l in 0..LANES {
                next_unloaded[l] = unloaded[l] * exponential(-plastic_step[l]);
            }
        }
        self.unloaded_length = Lanes(next_unloaded);
        self.yield_stress = Lanes(next_yield);
        flow.plastic_strain = Lanes(next_strain);
        flow.plastic_axial = Lanes(next_axial);
        flow.strain_slope = Lanes(next_slope);
        flow.temperature = Lanes(next_temperature);
        flow.largest_rate = Lanes(next_rate);
        Returned {
            stress,
            plastic_step,
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
