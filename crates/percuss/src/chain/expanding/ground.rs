//! The target away from the crater: an elastic cone that is as stiff as a half-space under the projectile.

use super::node::Node;
use crate::chain::{
    cone::{Cone, Grading},
    state::End,
};

/// From the crater floor to the back; positions are displacements.
#[derive(Debug)]
pub(super) struct Ground {
    pub(super) nodes: Vec<Node>,
    springs: Vec<Spring>,
    pub(super) end: End,
    /// It stays elastic, so it stays as cold as it is [K].
    pub(super) temperature: f64,
    /// Force on what holds it [N], and its impulse [N s] and work [J].
    pub(super) back_force: f64,
    pub(super) support_impulse: f64,
    pub(super) boundary_work: f64,
}

#[derive(Debug)]
struct Spring {
    stiffness: f64,
    /// Over one of these the strain is 1 [m].
    length: f64,
    /// Initial position of its middle [m].
    middle: f64,
    /// Area [m2].
    area: f64,
    /// Now and a step before [N].
    force: [f64; 2],
}

/// A spring as histories show it.
#[derive(Debug)]
pub(super) struct Strained {
    pub(super) middle: f64,
    pub(super) displacement: f64,
    pub(super) length: f64,
    pub(super) strain: f64,
    pub(super) stress: f64,
    pub(super) area: f64,
}

impl Ground {
    pub(super) fn new(
        cone: Cone,
        grading: Grading,
        thickness: f64,
        count: usize,
        [density, modulus, temperature]: [f64; 3],
        end: End,
    ) -> Self {
        let depths = grading.nodes(0.0, thickness, count);
        let mut nodes = vec![Node::default(); count + 1];
        let mut springs = Vec::with_capacity(count);
        for (i, pair) in depths.windows(2).enumerate() {
            let volumes = cone.volumes_between(pair[0], pair[1]);
            nodes[i].mass += density * volumes[0];
            nodes[i + 1].mass += density * volumes[1];
            let area = cone.area_between(pair[0], pair[1]);
            springs.push(Spring {
                stiffness: modulus * area / (pair[1] - pair[0]),
                length: pair[1] - pair[0],
                middle: 0.5 * (pair[0] + pair[1]),
                area,
                force: [0.0; 2],
            });
        }
        Self {
            nodes,
            springs,
            end,
            temperature,
            back_force: 0.0,
            support_impulse: 0.0,
            boundary_work: 0.0,
        }
    }

    pub(super) fn collect(&mut self) {
        for node in &mut self.nodes {
            node.force = 0.0;
        }
        for (i, spring) in self.springs.iter().enumerate() {
            self.nodes[i].force -= spring.force[1];
            self.nodes[i + 1].force += spring.force[1];
        }
    }

    /// New velocities of all but the first node.
    pub(super) fn kick(&mut self, kick: f64) {
        let last = self.nodes.len() - 1;
        for node in &mut self.nodes[1..last] {
            node.kick(node.force * kick);
        }
        let node = &mut self.nodes[last];
        match self.end {
            End::Free => node.kick(node.force * kick),
            End::Fixed => {
                self.back_force = node.force;
                self.support_impulse += node.force * kick;
            }
            End::Open {
                impedance,
                stiffness,
            } => {
                let inertia = node.mass / kick;
                let before = node.velocity;
                let spring = stiffness * node.position;
                node.velocity = ((inertia - 0.5 * impedance) * before + node.force - spring)
                    / (inertia + 0.5 * impedance);
                let mean = 0.5 * (before + node.velocity);
                self.back_force = impedance * mean + spring;
                self.support_impulse += self.back_force * kick;
                self.boundary_work += self.back_force * mean * kick;
            }
        }
    }

    pub(super) fn drift(&mut self, time_step: f64) {
        for node in &mut self.nodes {
            node.position += node.velocity * time_step;
        }
        for (pair, spring) in self.nodes.windows(2).zip(&mut self.springs) {
            let force = spring.stiffness * (pair[0].position - pair[1].position);
            spring.force = [spring.force[1], force];
        }
    }

    pub(super) fn momentum(&self) -> f64 {
        self.nodes
            .iter()
            .map(|node| node.mass * node.velocity)
            .sum()
    }

    /// Kinetic and elastic energy [J].
    pub(super) fn energies(&self) -> [f64; 2] {
        let elastic =
            |spring: &Spring| spring.force[0] * spring.force[1] / (2.0 * spring.stiffness);
        [
            self.nodes.iter().map(Node::kinetic_energy).sum(),
            self.springs.iter().map(elastic).sum(),
        ]
    }

    pub(super) fn strained(&self) -> impl Iterator<Item = Strained> + '_ {
        self.springs
            .iter()
            .zip(self.nodes.windows(2))
            .map(|(spring, pair)| Strained {
                middle: spring.middle,
                displacement: 0.5 * (pair[0].position + pair[1].position),
                length: spring.length,
                strain: (pair[0].position - pair[1].position) / spring.length,
                stress: spring.force[1] / spring.area,
                area: spring.area,
            })
    }
}
