//! Point masses on the axis.

use pulp::NullaryFnOnce;
use serde::{Deserialize, Serialize};

use super::blocks::{Blocks, behind};
use crate::{
    chain::{damping::against, solver::StepControl},
    lanes::{LANES, Lanes, PerLane, lanes},
};

percuss_core::per_lane! {
    /// A point mass, or one in every lane. Its velocity stands half a step behind its position.
    #[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
    pub(super) struct Node<R = f64> {
        pub(super) position: R,
        pub(super) velocity: R,
        mass: R,
        /// Inverse of its mass [1/kg].
        mobility: R,
        /// Force of the springs on it [N].
        pub(super) force: R,
        /// Force of damping on it [N], and its velocity before the kick that this belongs to [m/s].
        pub(super) damping: R,
        velocity_before: R,
    }
}

impl Node {
    /// What stands in a lane without a node: it never moves and has no inertia to add.
    pub(super) const INERT: Self = Self {
        position: 0.0,
        velocity: 0.0,
        mass: 0.0,
        mobility: 0.0,
        force: 0.0,
        damping: 0.0,
        velocity_before: 0.0,
    };

    #[inline(always)]
    pub(super) fn kick(&mut self, impulse: f64) {
        self.velocity_before = self.velocity;
        self.velocity += impulse * self.mobility;
    }

    /// Takes a velocity [m/s] by the end of a kick.
    pub(super) fn take_velocity(&mut self, velocity: f64) {
        self.velocity_before = self.velocity;
        self.velocity = velocity;
    }

    /// Takes the velocities that it had, but keeps its force.
    #[inline(always)]
    pub(super) fn return_to(&mut self, before: Self) {
        (self.velocity, self.velocity_before) = (before.velocity, before.velocity_before);
    }

    pub(super) fn mass(&self) -> f64 {
        self.mass
    }

    pub(super) fn set_mass(&mut self, mass: f64) {
        self.mass = mass;
        self.mobility = 1.0 / mass;
    }

    /// Change of its velocity per impulse [1/kg].
    pub(super) fn mobility(&self) -> f64 {
        self.mobility
    }

    /// Force of springs and damping on it [N].
    #[inline(always)]
    pub(super) fn whole_force(&self) -> f64 {
        self.force + self.damping
    }

    /// Mean velocity over a kick [m/s].
    pub(super) fn mean_velocity(&self) -> f64 {
        0.5 * (self.velocity_before + self.velocity)
    }

    /// Adds local damping: a fraction of the force that accelerates it [N].
    pub(super) fn damp_locally(&mut self, fraction: f64, accelerating: f64) {
        self.damping += against(fraction, accelerating, self.velocity);
    }

    /// Impulse [N s] and work [J] that damping took in a kick.
    pub(super) fn taken_by_damping(&self, kick: f64) -> [f64; 2] {
        let impulse = -self.damping * kick;
        [
            impulse,
            impulse * 0.5 * (self.velocity_before + self.velocity),
        ]
    }

    #[inline(always)]
    pub(super) fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass * self.velocity * self.velocity
    }

    /// Changes its velocity at once and returns the energy that this takes out of it.
    ///
    /// Springs do their work at the velocities of the two drifts around a kick: a jump between leaves half a drift's work to account for.
    /// `drift` is the length of the drift on the jump's side of the kick, negative when the jump comes before it.
    pub(super) fn jump(&mut self, change: f64, drift: f64) -> f64 {
        let before = self.kinetic_energy();
        self.velocity += change;
        before - self.kinetic_energy() + 0.5 * drift * self.force * change
    }

    /// Of a mass [kg] at a position [m], with a velocity [m/s].
    pub(super) fn new(mass: f64, position: f64, velocity: f64) -> Self {
        let mut node = Self {
            position,
            velocity,
            ..Self::INERT
        };
        node.set_mass(mass);
        node
    }
}

/// Nodes one behind the other.
pub(super) type Nodes = Blocks<Node<Lanes>>;

impl Nodes {
    /// Takes the forces of what is ahead of each node [N], one block after the other; behind their end there is nothing.
    #[inline(always)]
    pub(super) fn collect(&mut self, forces: impl Iterator<Item = Lanes>) {
        let forces = forces.chain(std::iter::repeat(Lanes::all(0.0)));
        let mut last = 0.0;
        for (nodes, ahead) in self.each_mut().zip(forces) {
            let behind = behind(&ahead, last);
            nodes.force = lanes(|l| behind[l] - ahead[l]);
            nodes.damping = Lanes::all(0.0);
            last = ahead[LANES - 1];
        }
    }

    /// Adds the force of the dashpot between a node and the one ahead of it.
    pub(super) fn damp(&mut self, i: usize, dashpot: &Dashpot, control: &StepControl) {
        let (mut behind, mut ahead) = (self.get(i), self.get(i + 1));
        dashpot.damp(control, &mut behind, &mut ahead);
        self.set(i, behind);
        self.set(i + 1, ahead);
    }

    /// Takes the forces of what is ahead of each node [N] and gives new velocities to all nodes but one at an end, as [`Self::collect`] and
    /// [`Self::kick`] do.
    #[inline(always)]
    pub(super) fn push(&mut self, forces: impl Iterator<Item = Lanes>, kick: f64, stays: usize) {
        if self.is_empty() {
            return;
        }
        let before = self.get(stays);
        let forces = forces.chain(std::iter::repeat(Lanes::all(0.0)));
        let mut last = 0.0;
        for (nodes, ahead) in self.each_mut().zip(forces) {
            let behind = behind(&ahead, last);
            let force = lanes(|l| behind[l] - ahead[l]);
            let (velocity, mobility) = (nodes.velocity, nodes.mobility);
            nodes.force = force;
            nodes.velocity_before = velocity;
            // Damping is 0, as everywhere.
            nodes.velocity = lanes(|l| velocity[l] + (force[l] + 0.0) * kick * mobility[l]);
            last = ahead[LANES - 1];
        }
        let mut node = self.get(stays);
        node.return_to(before);
        self.set(stays, node);
    }

    /// New velocities of all nodes.
    #[inline(always)]
    pub(super) fn kick(&mut self, kick: f64) {
        for nodes in self.each_mut() {
            let after = |lane: usize| {
                let mut one = nodes.lane(lane);
                one.kick(one.whole_force() * kick);
                one.velocity
            };
            let after = lanes(after);
            nodes.velocity_before = nodes.velocity;
            nodes.velocity = after;
        }
    }

    /// Sum of the force of the springs on each node times the change of its velocity in the last kick [N m/s].
    #[inline(always)]
    pub(super) fn forced_change(&self) -> f64 {
        self.sum(|nodes| {
            let (force, after, before) = (nodes.force, nodes.velocity, nodes.velocity_before);
            lanes(|l| force[l] * (after[l] - before[l]))
        })
    }

    /// New positions of all nodes.
    #[inline(always)]
    pub(super) fn drift(&mut self, time_step: f64) {
        for nodes in self.each_mut() {
            let (position, velocity) = (nodes.position, nodes.velocity);
            nodes.position = lanes(|l| position[l] + velocity[l] * time_step);
        }
    }

    /// Mass [kg].
    pub(super) fn mass(&self) -> f64 {
        self.sum(|nodes| nodes.mass)
    }

    /// Momentum [N s].
    #[inline(always)]
    pub(super) fn momentum(&self) -> f64 {
        self.sum(|nodes| {
            let (mass, velocity) = (nodes.mass, nodes.velocity);
            lanes(|l| mass[l] * velocity[l])
        })
    }

    /// Kinetic energy [J].
    #[inline(always)]
    pub(super) fn kinetic_energy(&self) -> f64 {
        self.sum(|nodes| lanes(|l| nodes.lane(l).kinetic_energy()))
    }
}

/// Sums up the momentum of nodes [N s].
pub(super) struct Momentum<'a>(pub(super) &'a Nodes);

impl NullaryFnOnce for Momentum<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        self.0.momentum()
    }
}

/// Two neighbouring nodes and the dashpot between them.
pub(super) struct Dashpot {
    /// [s/m].
    pub(super) slowness: f64,
    /// Impedance of a bar of its area: the force per velocity and damping ratio [kg/s].
    pub(super) impedance: f64,
}

impl Dashpot {
    /// Adds its force to a node and the one ahead of it.
    fn damp(&self, control: &StepControl, behind: &mut Node, ahead: &mut Node) {
        let approach = behind.velocity - ahead.velocity;
        let ratio = control.viscous_ratio(approach, self.slowness);
        let force = ratio * self.impedance * approach;
        behind.damping -= force;
        ahead.damping += force;
    }
}
