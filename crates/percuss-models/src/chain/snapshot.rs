//! Snapshot of a state for histories.

use std::f64::consts::PI;

use super::{part::Role, state::State};
use crate::history::{ElementState, Profile, Sample};

impl State {
    pub(super) fn sample(&self) -> Sample {
        let projectile = || {
            self.segments
                .iter()
                .filter(|segment| self.parts[segment.part].role == Role::Projectile)
        };
        let tail = projectile()
            .next()
            .map(|segment| self.nodes.at(segment.first_node));
        let tip = projectile()
            .next_back()
            .map(|segment| self.nodes.at(segment.last_node));
        let face = self
            .face_segment()
            .map(|face| self.nodes.at(self.segments[face].first_node));
        let back = self
            .segments
            .last()
            .filter(|segment| self.parts[segment.part].role == Role::Target)
            .map(|segment| self.nodes.at(segment.last_node));
        let (mass, momentum) = self.projectile_motion();
        let length: f64 = projectile()
            .map(|segment| {
                self.nodes.position[segment.last_node] - self.nodes.position[segment.first_node]
            })
            .sum();
        // What is gone has no place and no speed.
        {
            let mut sample = Sample::default();
            sample.time = self.time;
            sample.step = self.step;
            sample.tip_velocity = tip.map_or(f64::NAN, |node| node.velocity);
            sample.tail_velocity = tail.map_or(f64::NAN, |node| node.velocity);
            sample.interface_velocity = face.map_or(f64::NAN, |node| node.velocity);
            sample.back_velocity = back.map_or(f64::NAN, |node| node.velocity);
            sample.mean_velocity = momentum / mass;
            sample.tip_position = tip.map_or(f64::NAN, |node| node.position);
            sample.depth = self.depth();
            sample.projectile_length = length + 0.0;
            sample.contact_force = self.contact_force;
            sample.back_force = self.back_force;
            sample.energy = self.energy();
            sample.momentum = self.momentum();
            sample
        }
    }

    /// Elements along the axis, thinned out to about `most`.
    pub(super) fn profile(&self, most: usize) -> Profile {
        let total: usize = self.segments.iter().map(|s| s.elements().len()).sum();
        let stride = total.div_ceil(most).max(1);
        let mut elements = Vec::with_capacity(total / stride + 1);
        for segment in &self.segments {
            let part = &self.parts[segment.part];
            for e in segment.elements().step_by(stride) {
                let (element, node) = (self.elements.get(e), e + segment.shift);
                let position = 0.5 * (self.nodes.position[node] + self.nodes.position[node + 1]);
                elements.push(ElementState {
                    part: segment.part,
                    initial_position: element.initial_position,
                    position,
                    displacement: position - element.initial_position,
                    length: element.length,
                    stress: element.spring.stress,
                    strain: element.strain,
                    plastic_strain: element.plastic.strain,
                    diameter: 2.0 * (element.area(part) / PI).sqrt(),
                    temperature: element.plastic.temperature,
                    velocity: 0.5 * (self.nodes.velocity[node] + self.nodes.velocity[node + 1]),
                });
            }
        }
        Profile {
            time: self.time,
            elements,
        }
    }
}
