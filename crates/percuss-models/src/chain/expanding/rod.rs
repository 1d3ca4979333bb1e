//! The projectile: nodes on the axis, slices between them, and the shear between neighbouring slices.

use std::{f64::consts::PI, sync::Arc};

use pulp::Arch;
use serde::{Deserialize, Serialize};

use super::{
    block::Respond,
    node::{Dashpot, Node},
    projectile::failure_state,
    slice::{Metal, Shear, Slice},
};
use crate::{
    Error, chain::solver::StepControl, material::PreparedFailure, solver::archive::Archive,
};

/// From its tail to its tip; what erodes leaves from the tip.
#[derive(Debug)]
pub(super) struct Rod {
    pub(super) metal: Arc<Metal>,
    pub(super) nodes: Vec<Node>,
    pub(super) slices: Vec<Slice>,
    /// `shears[i]` is between the slices `i` and `i + 1`.
    shears: Vec<Shear>,
    arch: Arch,
    /// What limits the next step, where it is known from the last one.
    fastest: Option<Fastest>,
    /// What eroded: largest plastic strain, plastic strain rate and temperature of its slices.
    lost: [f64; 3],
}

/// What limits a time step: the largest of all slices.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Fastest {
    /// Square of a frequency times the density [Pa/m2].
    pub(super) stiffness: f64,
    /// Rate of strain [1/s].
    pub(super) rate: f64,
}

impl Fastest {
    /// Looks at a slice and its two nodes.
    pub(super) fn follow(&mut self, slice: &Slice, nodes: &[Node], metal: &Metal) {
        let approach = (nodes[0].velocity - nodes[1].velocity).abs() / slice.length;
        let widening = slice.radial_velocity.abs() / slice.radius;
        self.rate = self.rate.max(approach).max(widening);
        self.stiffness = self.stiffness.max(slice.stiffness(metal));
    }
}

/// What left with a slice.
#[derive(Debug, Default)]
pub(super) struct Loss {
    pub(super) energy: f64,
    pub(super) momentum: f64,
    /// Its length [m].
    pub(super) length: f64,
}

impl Rod {
    /// A rod without slices.
    pub(super) fn of_same_metal(&self) -> Self {
        Self {
            metal: Arc::clone(&self.metal),
            nodes: Vec::new(),
            slices: Vec::new(),
            shears: Vec::new(),
            arch: self.arch,
            fastest: None,
            lost: [0.0; 3],
        }
    }

    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.nodes)?;
        archive.item(&mut self.slices)?;
        archive.item(&mut self.shears)?;
        archive.item(&mut self.fastest)?;
        archive.item(&mut self.lost)
    }

    pub(super) fn new(
        metal: Metal,
        count: usize,
        length: f64,
        area: f64,
        temperature: f64,
        speed: f64,
    ) -> Self {
        let size = length / count as f64;
        let radius = (area / PI).sqrt();
        let slices: Vec<Slice> = (0..count)
            .map(|i| {
                let middle = size * (i as f64 + 0.5) - length;
                Slice::new(&metal, size, radius, temperature, middle)
            })
            .collect();
        let mut nodes: Vec<Node> = (0..=count)
            .map(|i| Node::at(-size * (count - i) as f64, speed))
            .collect();
        for (i, slice) in slices.iter().enumerate() {
            nodes[i].mass += 0.5 * slice.mass;
            nodes[i + 1].mass += 0.5 * slice.mass;
        }
        Self {
            arch: Arch::new(),
            fastest: None,
            shears: vec![Shear::default(); count.saturating_sub(1)],
            metal: Arc::new(metal),
            nodes,
            slices,
            lost: [0.0; 3],
        }
    }

    pub(super) fn tip(&self) -> Option<&Node> {
        self.nodes.last()
    }

    /// Forces of the slices on the nodes.
    pub(super) fn collect(&mut self) {
        for node in &mut self.nodes {
            node.force = 0.0;
            node.damping = 0.0;
        }
        for (i, slice) in self.slices.iter().enumerate() {
            self.nodes[i].force -= slice.axial_force;
            self.nodes[i + 1].force += slice.axial_force;
        }
    }

    /// Adds damping of the axial motion; `pushed` is the force from outside on the tip [N].
    pub(super) fn damp(&mut self, control: &StepControl, pushed: f64) {
        let slowness = self.metal.slowness;
        for (i, slice) in self.slices.iter().enumerate() {
            let dashpot = Dashpot {
                slowness,
                impedance: self.metal.density / slowness * slice.area(),
            };
            let (behind, ahead) = self.nodes.split_at_mut(i + 1);
            if let (Some(behind), Some(ahead)) = (behind.last_mut(), ahead.first_mut()) {
                dashpot.damp(control, behind, ahead);
            }
        }
        let tip = self.nodes.len().saturating_sub(1);
        for (i, node) in self.nodes.iter_mut().enumerate() {
            let outside = if i == tip { pushed } else { 0.0 };
            let accelerating = node.whole_force() + outside;
            node.damp_locally(control.local_damping, accelerating);
        }
    }

    /// New velocities of all but the tip.
    pub(super) fn kick(&mut self, kick: f64) {
        let count = self.nodes.len().saturating_sub(1);
        for node in &mut self.nodes[..count] {
            node.kick(node.whole_force() * kick);
        }
        for (i, shear) in self.shears.iter().enumerate() {
            self.slices[i].radial_force += shear.force;
            self.slices[i + 1].radial_force -= shear.force;
        }
        for slice in &mut self.slices {
            slice.radial_velocity += slice.radial_force * kick / slice.radial_mass();
        }
    }

    /// Moves on and gives the plastic work [J]; an error names a slice that was crushed.
    pub(super) fn drift(&mut self, time_step: f64) -> Result<f64, usize> {
        for node in &mut self.nodes {
            node.position += node.velocity * time_step;
        }
        for (i, (pair, slice)) in self.nodes.windows(2).zip(&mut self.slices).enumerate() {
            slice.length = pair[1].position - pair[0].position;
            slice.radius += slice.radial_velocity * time_step;
            if slice.length <= 0.0 || slice.radius <= 0.0 {
                return Err(i);
            }
        }
        let metal = &*self.metal;
        let mut plastic = match metal.strength.hardening() {
            Some(law) => {
                let (work, fastest) = self.arch.dispatch(Respond {
                    nodes: &self.nodes,
                    slices: &mut self.slices,
                    metal,
                    law,
                    time_step,
                });
                self.fastest = Some(fastest);
                work
            }
            None => {
                let slices = self.slices.iter_mut();
                slices.fold(0.0, |work, slice| work + slice.deform(metal, time_step))
            }
        };
        for (pair, shear) in self.slices.windows(2).zip(&mut self.shears) {
            plastic += shear.deform(&self.metal, &pair[0], &pair[1], time_step);
        }
        Ok(plastic)
    }

    /// Largest stable step [s], in which no slice changes its size by more than a part either.
    pub(super) fn stable_step(&self, largest_strain: f64) -> f64 {
        let fastest = self.fastest.unwrap_or_else(|| {
            let mut fastest = Fastest::default();
            for (pair, slice) in self.nodes.windows(2).zip(&self.slices) {
                fastest.follow(slice, pair, &self.metal);
            }
            fastest
        });
        let frequency = (fastest.stiffness / self.metal.density).sqrt();
        (2.0 / frequency).min(largest_strain / fastest.rate)
    }

    /// Takes the foremost slice out, with what leaves with it.
    pub(super) fn erode_tip(&mut self) -> Loss {
        let (Some(slice), Some(tip)) = (self.slices.pop(), self.nodes.pop()) else {
            return Loss::default();
        };
        let shear = self.shears.pop();
        self.fastest = None;
        let half = 0.5 * slice.mass;
        let mut loss = Loss {
            energy: slice.elastic_energy(&self.metal)
                + slice.radial_energy()
                + shear.map_or(0.0, |shear| shear.elastic_energy(&self.metal)),
            momentum: 0.0,
            length: slice.length,
        };
        let behind = self.nodes.last().map_or(0.0, |node| node.velocity);
        for velocity in [tip.velocity, behind] {
            loss.energy += 0.5 * half * velocity * velocity;
            loss.momentum += half * velocity;
        }
        if let Some(node) = self.nodes.last_mut() {
            node.mass -= half;
        }
        if self.slices.is_empty() {
            self.nodes.clear();
        }
        self.remember(reached(&slice));
        loss
    }

    /// Brings the damage of its slices up to the end of a step [s].
    pub(super) fn damage(&mut self, law: &dyn PreparedFailure, time_step: f64) {
        for slice in &mut self.slices {
            slice.damage = law.damage(slice.damage, &failure_state(slice), time_step);
        }
    }

    /// The node at which it parts, if it does: one of the two slices has failed and something pulls.
    pub(super) fn weakest_node(&self) -> Option<usize> {
        let damage = |i: usize| self.slices[i - 1].damage + self.slices[i].damage;
        let fails = |i: &usize| {
            let pair = &self.slices[i - 1..=*i];
            self.pull_at(*i).0 > 0.0
                && pair
                    .iter()
                    .any(|slice| slice.damage >= 1.0 && !slice.parted)
        };
        (1..self.slices.len())
            .filter(fails)
            .max_by(|&a, &b| damage(a).total_cmp(&damage(b)))
    }

    /// Tension at a node between two slices [N] and the smaller area at rest [m2].
    pub(super) fn pull_at(&self, node: usize) -> (f64, f64) {
        let (behind, ahead) = (&self.slices[node - 1], &self.slices[node]);
        let area = |slice: &Slice| slice.rest_volume() / slice.rest_length;
        (
            -0.5 * (behind.axial_force + ahead.axial_force),
            area(behind).min(area(ahead)),
        )
    }

    /// Parts at a node between two slices, keeps what is ahead and gives what is behind, with the elastic energy of the shear between the
    /// two [J].
    pub(super) fn split(&mut self, node: usize) -> (Self, f64) {
        for slice in &mut self.slices[node - 1..=node] {
            slice.parted |= slice.damage >= 1.0;
        }
        let ahead = self.slices.split_off(node);
        let mut nodes = self.nodes.split_off(node);
        let own = 0.5 * ahead[0].mass;
        let mut end = nodes[0];
        end.mass -= own;
        nodes[0].mass = own;
        let shears = self.shears.split_off(node);
        let lost = self.shears.pop();
        let behind = Self {
            metal: Arc::clone(&self.metal),
            nodes: self.nodes.drain(..).chain([end]).collect(),
            slices: std::mem::replace(&mut self.slices, ahead),
            shears: std::mem::replace(&mut self.shears, shears),
            arch: self.arch,
            fastest: None,
            lost: self.lost,
        };
        self.nodes = nodes;
        self.fastest = None;
        let energy = lost.map_or(0.0, |shear| shear.elastic_energy(&self.metal));
        (behind, energy)
    }

    /// Keeps the extremes of slices that are gone.
    pub(super) fn remember(&mut self, reached: [f64; 3]) {
        for (most, value) in self.lost.iter_mut().zip(reached) {
            *most = most.max(value);
        }
    }

    /// Mass [kg] and momentum [N s].
    pub(super) fn motion(&self) -> (f64, f64) {
        self.nodes.iter().fold((0.0, 0.0), |(mass, momentum), n| {
            (mass + n.mass, momentum + n.mass * n.velocity)
        })
    }

    /// Kinetic and elastic energy [J].
    pub(super) fn energies(&self) -> [f64; 2] {
        let axial: f64 = self.nodes.iter().map(Node::kinetic_energy).sum();
        let radial: f64 = self.slices.iter().map(Slice::radial_energy).sum();
        let metal = &self.metal;
        let slices: f64 = self.slices.iter().map(|s| s.elastic_energy(metal)).sum();
        let shears: f64 = self.shears.iter().map(|s| s.elastic_energy(metal)).sum();
        [axial + radial, slices + shears]
    }

    /// Largest plastic strain, plastic strain rate [1/s] and temperature [K] so far.
    pub(super) fn reached(&self) -> [f64; 3] {
        let slices = self.slices.iter().map(reached);
        slices.fold(self.lost, |most, value| {
            std::array::from_fn(|k| most[k].max(value[k]))
        })
    }
}

fn reached(slice: &Slice) -> [f64; 3] {
    [slice.plastic_strain, slice.largest_rate, slice.temperature]
}
