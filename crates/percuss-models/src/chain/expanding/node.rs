//! A point mass on the axis.

use serde::{Deserialize, Serialize};

use crate::chain::{damping::against, solver::StepControl};

/// Its velocity stands half a step behind its position.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Node {
    pub(super) position: f64,
    pub(super) velocity: f64,
    pub(super) mass: f64,
    /// Force of the springs on it [N].
    pub(super) force: f64,
    /// Force of damping on it [N], and its velocity before the kick that this belongs to [m/s].
    pub(super) damping: f64,
    velocity_before: f64,
}

impl Node {
    pub(super) fn kick(&mut self, impulse: f64) {
        self.velocity_before = self.velocity;
        self.velocity += impulse / self.mass;
    }

    /// Force of springs and damping on it [N].
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
}

impl Node {
    /// At a position [m], with a velocity [m/s].
    pub(super) fn at(position: f64, velocity: f64) -> Self {
        Self {
            position,
            velocity,
            ..Self::default()
        }
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
    pub(super) fn damp(&self, control: &StepControl, behind: &mut Node, ahead: &mut Node) {
        let approach = behind.velocity - ahead.velocity;
        let ratio = control.viscous_ratio(approach, self.slowness);
        let force = ratio * self.impedance * approach;
        behind.damping -= force;
        ahead.damping += force;
    }
}
