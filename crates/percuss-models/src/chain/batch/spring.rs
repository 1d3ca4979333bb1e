//! Response of an element in every lane: `Element::deform` for a power of the plastic strain.

use super::bundle::{Elastic, Flow, Node, Spring};
use crate::{
    lanes::{LANES, Lanes, larger, smaller},
    power::small_log_ratio,
};

/// What became of an element.
pub(super) struct Response {
    /// Largest stable time step where it does not flow.
    pub(super) limit: Lanes,
    /// Speed at which its ends approach or part, as a part of the length.
    pub(super) approach: Lanes,
    /// Whether any lane flows, or has to be looked at.
    pub(super) flows: bool,
    /// Whether the stress of any lane has changed.
    pub(super) changes: bool,
    /// Whether it is about to erode in any lane.
    pub(super) erodes: bool,
}

impl Spring {
    /// Brings the element to the length that its ends give it, as if nothing flowed; it may have eroded in some lanes.
    #[inline(always)]
    pub(super) fn respond<const ERODED: bool>(
        &mut self,
        ends: [&Node; 2],
        body: &Elastic,
        now: usize,
        gone: u8,
    ) -> Response {
        let [back, front] = ends.map(|node| node.position.0);
        let [back_velocity, front_velocity] = ends.map(|node| node.velocity.0);
        let unloaded = self.unloaded_length.0;
        let yield_stress = self.yield_stress.0;
        let stress_before = self.stress[now & 1].0;
        let modulus = body.modulus.0;
        let (volume, compliance, slowness) = (body.volume.0, body.compliance.0, body.slowness.0);
        let (shortest, longest) = (body.shortest.0, body.longest.0);
        let mut stress = [0.0; LANES];
        let mut force = [0.0; LANES];
        let mut limit = [0.0; LANES];
        let mut approach = [0.0; LANES];
        let (mut flows, mut changes, mut erodes) = (false, false, false);
        for l in 0..LANES {
            let is_here = !ERODED || gone >> l & 1 == 0;
            let length = front[l] - back[l];
            let (elastic, is_exact) = small_log_ratio(unloaded[l], length);
            stress[l] = modulus[l] * elastic;
            flows |= is_here & ((stress[l].abs() > yield_stress[l]) | !is_exact);
            changes |= is_here & (stress[l] != stress_before[l]);
            erodes |= is_here & ((length <= shortest[l]) | (length >= longest[l]));
            let inverse = 1.0 / length;
            force[l] = stress[l] * volume[l] * inverse;
            limit[l] = stable(length, stress[l], compliance[l], slowness[l]);
            approach[l] = (back_velocity[l] - front_velocity[l]).abs() * inverse;
            if !is_here {
                stress[l] = 0.0;
                force[l] = 0.0;
                limit[l] = f64::INFINITY;
                approach[l] = 0.0;
            }
        }
        self.stress[1 - (now & 1)] = Lanes(stress);
        self.force = Lanes(force);
        Response {
            limit: Lanes(limit),
            approach: Lanes(approach),
            flows,
            changes,
            erodes,
        }
    }

    /// A bit for every lane that flows, or has to be looked at, after a response.
    #[inline(always)]
    pub(super) fn flowing(&self, ends: [&Node; 2], now: usize) -> u8 {
        let [back, front] = ends.map(|node| node.position.0);
        let (stress, yield_stress) = (self.stress[1 - (now & 1)].0, self.yield_stress.0);
        let unloaded = self.unloaded_length.0;
        let mut flows = 0;
        for l in 0..LANES {
            let (_, is_exact) = small_log_ratio(unloaded[l], front[l] - back[l]);
            flows |= u8::from((stress[l].abs() > yield_stress[l]) | !is_exact) << l;
        }
        flows
    }

    /// Takes the force of an element away in lanes where it has eroded.
    #[inline(always)]
    pub(super) fn part(&mut self, limit: &mut Lanes, gone: u8) {
        for l in 0..LANES {
            if gone >> l & 1 == 1 {
                self.force.0[l] = 0.0;
                limit.0[l] = f64::INFINITY;
            }
        }
    }

    /// What follows from the stress once what flows has flowed; returns the largest stable time step.
    #[inline(always)]
    pub(super) fn settle(
        &mut self,
        flow: &Flow,
        ends: [&Node; 2],
        body: &Elastic,
        now: usize,
        work: &mut Lanes,
    ) -> Lanes {
        let [back, front] = ends.map(|node| node.position.0);
        let (stress_before, stress) = (self.stress[now & 1].0, self.stress[1 - (now & 1)].0);
        let (step_before, step) = (flow.step_before.0, flow.plastic_step.0);
        let (volume, compliance, slowness) = (body.volume.0, body.compliance.0, body.slowness.0);
        let mut force = [0.0; LANES];
        let mut limit = [0.0; LANES];
        for l in 0..LANES {
            let length = front[l] - back[l];
            force[l] = stress[l] * volume[l] * (1.0 / length);
            work.0[l] += volume[l] * (0.5 * stress_before[l] * (step_before[l] + step[l]));
            limit[l] = stable(length, stress[l], compliance[l], slowness[l]);
        }
        self.force = Lanes(force);
        Lanes(limit)
    }
}

/// Largest stable time step of an element.
#[inline(always)]
fn stable(length: f64, stress: f64, compliance: f64, slowness: f64) -> f64 {
    let stiffening = 0.5 * larger(smaller(stress * compliance, 1.0), 0.0);
    length * slowness * (1.0 - stiffening)
}
