//! How a run gets into a lane and out of it again.

use super::{
    bundle::{Body, Bundle},
    scalars::RunScalars,
};
use crate::{
    chain::{
        column::ColumnRun,
        element::{Plastic, Spring},
        flow::FlowConstants,
        state::State,
    },
    lanes::PerLane,
    material::YieldPoint,
    power::log_ratio,
};

/// A strain is compared with the erosion strain only where the length says that it is this close.
const CLOSE: f64 = 1.0 + 1e-9;

impl Bundle {
    /// Puts a run at the moment of impact into a lane.
    pub(super) fn load_lane(&mut self, lane: usize, run: &ColumnRun<'_>) {
        let state = &run.solver.state;
        for i in 0..state.nodes.len() {
            let from = state.nodes.at(i);
            self.nodes[i].position.0[lane] = from.position;
            self.nodes[i].velocity.0[lane] = from.velocity;
            self.moves[i] |= from.velocity != 0.0;
            self.masses[i].0[lane] = from.mass;
            self.frictions[i].0[lane] = from.friction;
        }
        for (e, from) in state.elements.iter(0..state.elements.len()).enumerate() {
            self.springs[e].set_lane(lane, from.spring);
            self.forces[e].set_lane(lane, from.axial_force);
            self.plastics[e].set_lane(lane, from.plastic);
            self.points[e].set_lane(lane, from.yield_point);
        }
        for (b, body) in self.bodies.iter_mut().enumerate() {
            if let Some(law) = state.parts[b].strength.in_lanes() {
                self.laws[b].set_lane(lane, law);
            }
            let elements = self.mesh.elements_of(b);
            let stretch = run.solver.control.erosion_strain.exp();
            body.set_lane(
                lane,
                Body::of(state, b, elements.start, elements.len(), stretch),
            );
        }
        self.follow(lane, run);
        self.unsettle();
    }

    /// Has every element updated in the next step.
    pub(super) fn unsettle(&mut self) {
        for mark in &mut self.marks {
            mark.settled = false;
        }
    }

    /// Takes over what the single run has done with a lane that was let out.
    pub(super) fn follow(&mut self, lane: usize, run: &ColumnRun<'_>) {
        self.scalars.set_lane(lane, RunScalars::of(run));
    }

    /// Puts a lane into the state of its run; false when an element has no length any more.
    pub(super) fn store_lane(&self, lane: usize, run: &mut ColumnRun<'_>) -> bool {
        let state = &mut run.solver.state;
        let mut is_sound = true;
        for segment in &state.segments {
            for i in segment.first_node..=segment.last_node {
                state.nodes.position[i] = self.nodes[i].position.0[lane];
                state.nodes.velocity[i] = self.nodes[i].velocity.0[lane];
            }
            for e in segment.elements() {
                let node = e + segment.shift;
                let mut to = state.elements.get(e);
                to.length = state.nodes.position[node + 1] - state.nodes.position[node];
                is_sound &= to.length > 0.0;
                to.spring = self.springs[e].lane(lane);
                to.axial_force = self.forces[e].lane(lane);
                to.plastic = self.plastics[e].lane(lane);
                to.yield_point = self.points[e].lane(lane);
                to.strain = to.plastic.axial + log_ratio(to.spring.unloaded_length, to.length);
                state.elements.set(e, to);
            }
        }
        for interface in self
            .interfaces
            .iter()
            .filter(|interface| interface.lane == lane)
        {
            state.interfaces[interface.place].closed = interface.closed;
        }
        self.scalars.lane(lane).store(run);
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
        for e in 0..self.springs.len() {
            let unloaded_length = 1.0;
            self.springs[e].set_lane(
                lane,
                Spring {
                    unloaded_length,
                    ..Spring::default()
                },
            );
            self.forces[e].set_lane(lane, 0.0);
            self.plastics[e].set_lane(lane, Plastic::default());
            self.points[e].set_lane(lane, YieldPoint::known(f64::INFINITY, 0.0));
        }
        for body in &mut self.bodies {
            body.set_lane(lane, Body::idle());
        }
        self.scalars.set_lane(lane, RunScalars::idle());
        self.mend(lane);
        self.unsettle();
    }
}

impl Body {
    /// Body `b` of a state, `count` elements from one on, that erode when they are longer or shorter by a factor.
    fn of(state: &State, b: usize, first: usize, count: usize, stretch: f64) -> Self {
        let (part, element) = (&state.parts[b], state.elements.get(first));
        let frictions = &state.nodes.friction[first + b..=first + b + count];
        let half = element.end_masses[0];
        Self {
            flow: FlowConstants::of(part),
            compliance: part.compliance,
            slowness: part.slowness,
            volume: element.volume,
            mass: half + half,
            end_mass: half,
            friction: frictions[1.min(count - 1)],
            first_friction: frictions[0],
            last_friction: frictions[count],
            shortest: element.rest_length / stretch * CLOSE,
            longest: element.rest_length * stretch / CLOSE,
        }
    }

    /// That of a lane in which nothing ever happens.
    fn idle() -> Self {
        Self {
            flow: FlowConstants {
                modulus: 1.0,
                ..FlowConstants::default()
            },
            compliance: 1.0,
            slowness: 1.0,
            volume: 1.0,
            mass: 1.0,
            end_mass: 1.0,
            longest: f64::INFINITY,
            ..Self::default()
        }
    }
}
