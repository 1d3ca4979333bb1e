//! The target away from the crater: an elastic cone that is as stiff as a half-space under the projectile.

use serde::{Deserialize, Serialize};

use super::node::{Dashpot, Node};
use crate::{
    Error,
    chain::{
        cone::{Cone, Grading},
        solver::StepControl,
    },
    solver::archive::Archive,
};

/// From the crater floor to the rear face; positions are displacements in waves that leave the crater. What is behind takes those waves
/// up as the cone beyond would: [`RearFace`](super::rear_face::RearFace) sends them back.
#[derive(Debug)]
pub(super) struct FarField {
    pub(super) nodes: Vec<Node>,
    springs: Vec<Spring>,
    /// Of the cone beyond the last node: impedance [kg/s] and static stiffness [N/m].
    beyond: [f64; 2],
    /// Inverse of its wave speed [s/m].
    pub(super) slowness: f64,
    /// It stays elastic, so it stays as cold as it is [K].
    pub(super) temperature: f64,
    /// What has left through the last node: force [N], impulse [N s] and work [J].
    pub(super) passing_force: f64,
    pub(super) passed_impulse: f64,
    pub(super) passed_work: f64,
}

#[derive(Debug, Serialize, Deserialize)]
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
    pub(super) velocity: f64,
    pub(super) length: f64,
    pub(super) strain: f64,
    pub(super) stress: f64,
    pub(super) area: f64,
    modulus: f64,
}

impl Strained {
    /// Adds the displacement [m], the strain and the velocity [m/s] of other waves.
    pub(super) fn superpose(&mut self, [displacement, strain, velocity]: [f64; 3]) {
        self.displacement += displacement;
        self.velocity += velocity;
        self.strain += strain;
        self.stress += self.modulus * strain;
    }
}

impl FarField {
    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.nodes)?;
        archive.item(&mut self.springs)?;
        archive.item(&mut self.passing_force)?;
        archive.item(&mut self.passed_impulse)?;
        archive.item(&mut self.passed_work)
    }

    pub(super) fn new(
        cone: Cone,
        grading: Grading,
        thickness: f64,
        count: usize,
        [density, modulus, temperature]: [f64; 3],
        beyond: [f64; 2],
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
            beyond,
            slowness: (density / modulus).sqrt(),
            temperature,
            passing_force: 0.0,
            passed_impulse: 0.0,
            passed_work: 0.0,
        }
    }

    pub(super) fn collect(&mut self) {
        for node in &mut self.nodes {
            node.force = 0.0;
            node.damping = 0.0;
        }
        for (i, spring) in self.springs.iter().enumerate() {
            self.nodes[i].force -= spring.force[1];
            self.nodes[i + 1].force += spring.force[1];
        }
    }

    /// Adds damping; `pushed` is the force from outside on the first node [N].
    pub(super) fn damp(&mut self, control: &StepControl, pushed: f64) {
        for (spring, i) in self.springs.iter().zip(0..) {
            let dashpot = Dashpot {
                slowness: self.slowness,
                impedance: spring.stiffness * spring.length * self.slowness,
            };
            let (behind, ahead) = self.nodes.split_at_mut(i + 1);
            if let (Some(behind), Some(ahead)) = (behind.last_mut(), ahead.first_mut()) {
                dashpot.damp(control, behind, ahead);
            }
        }
        for (i, node) in self.nodes.iter_mut().enumerate() {
            let outside = if i == 0 { pushed } else { 0.0 };
            let accelerating = node.whole_force() + outside;
            node.damp_locally(control.local_damping, accelerating);
        }
    }

    /// New velocities of all but the first node.
    pub(super) fn kick(&mut self, kick: f64) {
        let last = self.nodes.len() - 1;
        for node in &mut self.nodes[1..last] {
            node.kick(node.whole_force() * kick);
        }
        let node = &mut self.nodes[last];
        let [impedance, stiffness] = self.beyond;
        let inertia = node.mass / kick;
        let before = node.velocity;
        let spring = stiffness * node.position;
        node.velocity = ((inertia - 0.5 * impedance) * before + node.whole_force() - spring)
            / (inertia + 0.5 * impedance);
        let mean = 0.5 * (before + node.velocity);
        self.passing_force = impedance * mean + spring;
        self.passed_impulse += self.passing_force * kick;
        self.passed_work += self.passing_force * mean * kick;
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
                velocity: 0.5 * (pair[0].velocity + pair[1].velocity),
                length: spring.length,
                strain: (pair[0].position - pair[1].position) / spring.length,
                stress: spring.force[1] / spring.area,
                area: spring.area,
                modulus: spring.stiffness * spring.length / spring.area,
            })
    }
}
