//! The projectile: nodes on the axis, slices between them, and the shear between neighbouring slices.

use std::{f64::consts::PI, sync::Arc};

use pulp::Arch;
use serde::{Deserialize, Serialize};

use super::{
    block::{Collect, Drift, Energies, ForcedChange, Kick, Look},
    blocks::Blocks,
    node::{Dashpot, Momentum, Node, Nodes},
    projectile::failure_state,
    respond::Stage,
    slice::{Metal, Particulars, Shear, Slice, Undeformed},
};
use crate::{
    Error,
    chain::solver::StepControl,
    lanes::Lanes,
    material::{FlowState, PreparedFailure, YieldPoint},
    solver::archive::Archive,
};

/// From its tail to its tip; what erodes leaves from the tip.
#[derive(Debug)]
pub(super) struct Rod {
    pub(super) metal: Arc<Metal>,
    pub(super) size: Undeformed,
    /// Slice `i` is between the nodes `i` and `i + 1`.
    pub(super) nodes: Nodes,
    pub(super) slices: Blocks<Slice<Lanes>>,
    pub(super) particulars: Vec<Particulars>,
    /// Shear `i` is between the slices `i` and `i + 1`.
    pub(super) shears: Blocks<Shear<Lanes>>,
    /// Between the stages of a step only.
    pub(super) stages: Vec<Stage>,
    pub(super) arch: Arch,
    /// What limits the next step, where it is known from the last one.
    pub(super) fastest: Option<Fastest>,
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
            size: self.size,
            nodes: self.nodes.like([]),
            slices: self.slices.like([]),
            particulars: Vec::new(),
            shears: self.shears.like([]),
            stages: Vec::new(),
            arch: self.arch,
            fastest: None,
            lost: [0.0; 3],
        }
    }

    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        self.nodes.archive(archive)?;
        self.slices.archive(archive)?;
        archive.item(&mut self.particulars)?;
        self.shears.archive(archive)?;
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
        let spacing = length / count as f64;
        let size = Undeformed::new(&metal, spacing, (area / PI).sqrt());
        let at_rest = FlowState {
            plastic_strain: 0.0,
            strain_rate: 0.0,
            temperature,
            pressure: 0.0,
        };
        let yield_point = YieldPoint::slow(&*metal.strength, &at_rest);
        let slice = Slice::new(&size, yield_point, temperature);
        let particulars = (0..count).map(|i| Particulars {
            initial_position: spacing * (i as f64 + 0.5) - length,
            damage: 0.0,
            parted: false,
        });
        let nodes = (0..=count).map(|i| {
            let is_end = i == 0 || i == count;
            let mass = if is_end { 0.5 * size.mass } else { size.mass };
            Node::new(mass, -spacing * (count - i) as f64, speed)
        });
        let shears = std::iter::repeat_n(Shear::default(), count.saturating_sub(1));
        Self {
            stages: Vec::new(),
            arch: Arch::new(),
            fastest: None,
            shears: Blocks::new(shears, Shear::default()),
            metal: Arc::new(metal),
            size,
            nodes: Blocks::new(nodes, Node::INERT),
            slices: Blocks::new(std::iter::repeat_n(slice, count), slice),
            particulars: particulars.collect(),
            lost: [0.0; 3],
        }
    }

    pub(super) fn tip(&self) -> Option<Node> {
        self.nodes.last()
    }

    /// Forces of the slices on the nodes.
    pub(super) fn collect(&mut self) {
        self.arch.dispatch(Collect(self));
    }

    /// Adds damping of the axial motion; `pushed` is the force from outside on the tip [N].
    pub(super) fn damp(&mut self, control: &StepControl, pushed: f64) {
        let slowness = self.metal.slowness;
        for (i, slice) in self.slices.iter().enumerate() {
            let dashpot = Dashpot {
                slowness,
                impedance: self.metal.density / slowness * slice.area(),
            };
            self.nodes.damp(i, &dashpot, control);
        }
        let tip = self.nodes.len().saturating_sub(1);
        self.nodes.change(|i, node| {
            let outside = if i == tip { pushed } else { 0.0 };
            let accelerating = node.whole_force() + outside;
            node.damp_locally(control.local_damping, accelerating);
        });
    }

    /// New velocities of all but the tip.
    pub(super) fn kick(&mut self, kick: f64) {
        self.arch.dispatch(Kick { rod: self, kick });
    }

    /// Forces times the changes of velocities in the last kick [N m/s].
    pub(super) fn forced_change(&self, kick: f64) -> f64 {
        self.arch.dispatch(ForcedChange { rod: self, kick })
    }

    /// Moves on and gives the plastic work [J]; an error names a slice that was crushed.
    pub(super) fn drift(&mut self, time_step: f64) -> Result<f64, usize> {
        self.arch.dispatch(Drift {
            rod: self,
            time_step,
        })
    }

    /// Largest stable step [s], in which no slice changes its size by more than a part either.
    pub(super) fn stable_step(&self, largest_strain: f64) -> f64 {
        let look = || self.arch.dispatch(Look(self));
        let fastest = self.fastest.unwrap_or_else(look);
        let frequency = (fastest.stiffness / self.metal.density).sqrt();
        (2.0 / frequency).min(largest_strain / fastest.rate)
    }

    /// Takes the foremost slice out, with what leaves with it.
    pub(super) fn erode_tip(&mut self) -> Loss {
        let (Some(slice), Some(tip)) = (self.slices.pop(), self.nodes.pop()) else {
            return Loss::default();
        };
        self.particulars.pop();
        let shear = self.shears.pop();
        self.fastest = None;
        let (metal, size) = (&self.metal, &self.size);
        let half = 0.5 * size.mass;
        let mut loss = Loss {
            energy: slice.elastic_energy(metal, size)
                + slice.radial_energy(size)
                + shear.map_or(0.0, |shear| shear.elastic_energy(metal, size)),
            momentum: 0.0,
            length: slice.length,
        };
        let behind = self.nodes.last().map_or(0.0, |node| node.velocity);
        for velocity in [tip.velocity, behind] {
            loss.energy += 0.5 * half * velocity * velocity;
            loss.momentum += half * velocity;
        }
        if let Some(mut node) = self.nodes.last() {
            node.set_mass(node.mass() - half);
            self.nodes.set_last(node);
        }
        if self.slices.is_empty() {
            self.nodes.truncate(0);
        }
        self.remember(reached(&slice));
        loss
    }

    /// Brings the damage of its slices up to the end of a step [s].
    pub(super) fn damage(&mut self, law: &dyn PreparedFailure, time_step: f64) {
        for (slice, own) in self.slices.iter().zip(&mut self.particulars) {
            own.damage = law.damage(
                own.damage,
                &failure_state(&slice, &self.metal, time_step),
                time_step,
            );
        }
    }

    /// The node at which it parts, if it does: one of the two slices has failed and something pulls.
    pub(super) fn weakest_node(&self) -> Option<usize> {
        let own = &self.particulars;
        let damage = |i: usize| own[i - 1].damage + own[i].damage;
        let fails = |i: &usize| {
            let has_failed = |slice: &Particulars| slice.damage >= 1.0 && !slice.parted;
            self.pull_at(*i).0 > 0.0 && own[i - 1..=*i].iter().any(has_failed)
        };
        (1..self.slices.len())
            .filter(fails)
            .max_by(|&a, &b| damage(a).total_cmp(&damage(b)))
    }

    /// Tension at a node between two slices [N] and their area at rest [m2].
    pub(super) fn pull_at(&self, node: usize) -> (f64, f64) {
        let forces = [node - 1, node].map(|i| self.slices.get(i).axial_force);
        (-0.5 * (forces[0] + forces[1]), self.size.area())
    }

    /// Parts at a node between two slices, keeps what is ahead and gives what is behind, with the elastic energy of the shear between the
    /// two [J].
    pub(super) fn split(&mut self, node: usize) -> (Self, f64) {
        for slice in &mut self.particulars[node - 1..=node] {
            slice.parted |= slice.damage >= 1.0;
        }
        let lost = self.shears.get(node - 1);
        let particulars = self.particulars.split_off(node);
        let mut ahead = Self {
            slices: self.slices.like(self.slices.iter().skip(node)),
            nodes: self.nodes.like(self.nodes.iter().skip(node)),
            shears: self.shears.like(self.shears.iter().skip(node)),
            particulars,
            lost: self.lost,
            ..self.of_same_metal()
        };
        self.slices.truncate(node);
        self.nodes.truncate(node + 1);
        self.shears.truncate(node - 1);
        let own = 0.5 * self.size.mass;
        let mut end = ahead.nodes.get(0);
        end.set_mass(end.mass() - own);
        self.nodes.set_last(end);
        end.set_mass(own);
        ahead.nodes.set(0, end);
        self.fastest = None;
        let behind = std::mem::replace(self, ahead);
        (behind, lost.elastic_energy(&self.metal, &self.size))
    }

    /// Keeps the extremes of slices that are gone.
    pub(super) fn remember(&mut self, reached: [f64; 3]) {
        for (most, value) in self.lost.iter_mut().zip(reached) {
            *most = most.max(value);
        }
    }

    /// Momentum [N s].
    pub(super) fn momentum(&self) -> f64 {
        self.arch.dispatch(Momentum(&self.nodes))
    }

    /// Mass [kg] and momentum [N s].
    pub(super) fn motion(&self) -> (f64, f64) {
        (self.nodes.mass(), self.momentum())
    }

    /// Kinetic and elastic energy [J].
    pub(super) fn energies(&self) -> [f64; 2] {
        self.arch.dispatch(Energies(self))
    }

    /// Largest plastic strain, plastic strain rate [1/s] and temperature [K] so far.
    pub(super) fn reached(&self) -> [f64; 3] {
        let slices = self.slices.iter().map(|slice| reached(&slice));
        slices.fold(self.lost, |most, value| {
            std::array::from_fn(|k| most[k].max(value[k]))
        })
    }
}

fn reached(slice: &Slice) -> [f64; 3] {
    let plastic = &slice.plastic;
    [plastic.strain, plastic.largest_rate, plastic.temperature]
}
