//! How a shot gets into a lane and out of it again.

use super::bundle::{Body, Bundle, Flow, Spring};
use crate::{
    chain::{column::ColumnRun, part::Section, state::Element},
    material::{Hardening, YieldPoint},
    power::log_ratio,
};

/// A strain is compared with the erosion strain only where the length says that it is this close.
const CLOSE: f64 = 1.0 + 1e-9;

impl Bundle {
    /// Puts a shot at the moment of impact into a lane.
    pub(super) fn load_lane(&mut self, lane: usize, run: &ColumnRun<'_>) {
        let state = &run.solver.state;
        for (i, from) in state.nodes.iter().enumerate() {
            self.nodes[i].position.0[lane] = from.position;
            self.nodes[i].velocity.0[lane] = from.velocity;
            self.masses[i].0[lane] = from.mass;
            self.frictions[i].0[lane] = from.friction;
        }
        let elements = self.springs.iter_mut().zip(&mut self.flows);
        for ((spring, flow), from) in elements.zip(&state.elements) {
            spring.load_lane(lane, from);
            flow.load_lane(lane, from);
        }
        let [projectile, _] = self.mesh.elements;
        for (body, part) in self.bodies.iter_mut().zip(&state.parts) {
            body.load_lane(lane, part);
        }
        for (b, (first, count)) in [(0, projectile), (projectile, self.mesh.elements[1])]
            .into_iter()
            .enumerate()
        {
            let body = &mut self.bodies[b];
            let element = &state.elements[first];
            let nodes = &state.nodes[first + b..=first + b + count];
            let half = element.end_masses[0];
            body.volume.0[lane] = element.volume;
            body.end_mass.0[lane] = half;
            body.mass.0[lane] = half + half;
            body.friction.0[lane] = nodes[1.min(count - 1)].friction;
            body.first_friction.0[lane] = nodes[0].friction;
            body.last_friction.0[lane] = nodes[count].friction;
            let length = element.rest_length;
            let stretch = run.solver.control.erosion_strain.exp();
            body.shortest.0[lane] = length / stretch * CLOSE;
            body.longest.0[lane] = length * stretch / CLOSE;
        }
        self.scalars.load_lane(lane, run);
        self.unsettle();
    }

    /// Has every element updated in the next step.
    pub(super) fn unsettle(&mut self) {
        for mark in &mut self.marks {
            mark.settled = false;
        }
    }

    /// Keeps up what the single run has done with a lane that was let out.
    pub(super) fn follow(&mut self, lane: usize, run: &ColumnRun<'_>) {
        self.scalars.follow(lane, run);
    }

    /// Puts a lane into the state of its shot; false when an element has no length any more.
    pub(super) fn store_lane(&self, lane: usize, run: &mut ColumnRun<'_>) -> bool {
        let state = &mut run.solver.state;
        let mut is_sound = true;
        for segment in &state.segments {
            for i in segment.first_node..=segment.last_node {
                state.nodes[i].position = self.nodes[i].position.0[lane];
                state.nodes[i].velocity = self.nodes[i].velocity.0[lane];
            }
            for e in segment.elements() {
                let node = e + segment.shift;
                let to = &mut state.elements[e];
                to.length = state.nodes[node + 1].position - state.nodes[node].position;
                is_sound &= to.length > 0.0;
                self.springs[e].store_lane(lane, to, self.now);
                self.flows[e].store_lane(lane, to, self.springs[e].yield_stress.0[lane]);
            }
        }
        if let Some(tip) = state.tip_segment() {
            state.interfaces[tip].closed = self.scalars.closed.0[lane] > 0.0;
        }
        for interface in self
            .interfaces
            .iter()
            .filter(|interface| interface.lane == lane)
        {
            state.interfaces[interface.place].closed = interface.closed;
        }
        self.scalars.store_lane(lane, run);
        is_sound
    }

    /// Leaves a lane to a chain on which nothing ever happens.
    pub(super) fn clear_lane(&mut self, lane: usize) {
        let [projectile, _] = self.mesh.elements;
        for (i, node) in self.nodes.iter_mut().enumerate() {
            // Tip and face stand in one place.
            node.position.0[lane] = (i - usize::from(i > projectile)) as f64;
            node.velocity.0[lane] = 0.0;
            self.masses[i].0[lane] = 1.0;
            self.frictions[i].0[lane] = 0.0;
        }
        for (spring, flow) in self.springs.iter_mut().zip(&mut self.flows) {
            let steps = [&mut flow.plastic_step, &mut flow.step_before];
            for of in spring
                .stress
                .iter_mut()
                .chain(steps)
                .chain([&mut spring.force])
            {
                of.0[lane] = 0.0;
            }
            spring.unloaded_length.0[lane] = 1.0;
            spring.yield_stress.0[lane] = f64::INFINITY;
            flow.plastic_strain.0[lane] = 0.0;
            flow.strain_slope.0[lane] = 0.0;
        }
        for body in &mut self.bodies {
            for of in [
                &mut body.modulus,
                &mut body.compliance,
                &mut body.slowness,
                &mut body.volume,
                &mut body.mass,
                &mut body.end_mass,
                &mut body.first_strain,
            ] {
                of.0[lane] = 1.0;
            }
            for of in [
                &mut body.friction,
                &mut body.first_friction,
                &mut body.last_friction,
                &mut body.heating,
                &mut body.coefficient,
                &mut body.exponent,
                &mut body.shortest,
            ] {
                of.0[lane] = 0.0;
            }
            body.longest.0[lane] = f64::INFINITY;
        }
        self.scalars.clear_lane(lane);
        self.mend(lane);
        self.unsettle();
    }
}

impl Spring {
    fn load_lane(&mut self, lane: usize, from: &Element) {
        self.unloaded_length.0[lane] = from.unloaded_length;
        self.yield_stress.0[lane] = from.yield_point.stress();
        self.force.0[lane] = from.axial_force;
        // At the moment of impact nothing has changed yet.
        for stress in &mut self.stress {
            stress.0[lane] = from.stress;
        }
    }

    fn store_lane(&self, lane: usize, to: &mut Element, now: usize) {
        to.unloaded_length = self.unloaded_length.0[lane];
        to.axial_force = self.force.0[lane];
        to.stress = self.stress[now].0[lane];
        to.stress_before = self.stress[1 - now].0[lane];
    }
}

impl Flow {
    fn load_lane(&mut self, lane: usize, from: &Element) {
        self.plastic_step.0[lane] = from.plastic_step;
        self.step_before.0[lane] = from.plastic_step;
        self.plastic_strain.0[lane] = from.plastic_strain;
        self.plastic_axial.0[lane] = from.plastic_axial;
        self.strain_slope.0[lane] = from.yield_point.strain_slope();
        self.temperature.0[lane] = from.temperature;
        self.largest_rate.0[lane] = from.largest_rate;
    }

    fn store_lane(&self, lane: usize, to: &mut Element, yield_stress: f64) {
        to.plastic_step = self.plastic_step.0[lane];
        to.plastic_strain = self.plastic_strain.0[lane];
        to.plastic_axial = self.plastic_axial.0[lane];
        to.temperature = self.temperature.0[lane];
        to.largest_rate = self.largest_rate.0[lane];
        to.strain = to.plastic_axial + log_ratio(to.unloaded_length, to.length);
        to.yield_point = YieldPoint::known(yield_stress, self.strain_slope.0[lane]);
    }
}

impl Body {
    fn load_lane(&mut self, lane: usize, part: &Section) {
        let law = part.strength.hardening().unwrap_or(Hardening::none(0.0));
        self.modulus.0[lane] = part.modulus;
        self.compliance.0[lane] = part.compliance;
        self.slowness.0[lane] = part.slowness;
        self.heating.0[lane] = part.heating;
        self.coefficient.0[lane] = law.coefficient;
        self.exponent.0[lane] = law.exponent;
        self.first_strain.0[lane] = law.first_strain;
    }
}
