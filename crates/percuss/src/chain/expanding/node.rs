//! A point mass on the axis.

/// Its velocity stands half a step behind its position.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Node {
    pub(super) position: f64,
    pub(super) velocity: f64,
    pub(super) mass: f64,
    /// Force of the springs on it [N].
    pub(super) force: f64,
}

impl Node {
    pub(super) fn kick(&mut self, impulse: f64) {
        self.velocity += impulse / self.mass;
    }

    pub(super) fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass * self.velocity * self.velocity
    }

    /// Changes its velocity at once and returns the energy that this takes out of it.
    ///
    /// Springs do their work at the velocities of the two drifts around a kick: a jump between leaves half a drift's work to book.
    /// `drift` is the length of the drift on the jump's side of the kick, negative when the jump comes before it.
    pub(super) fn jump(&mut self, change: f64, drift: f64) -> f64 {
        let before = self.kinetic_energy();
        self.velocity += change;
        before - self.kinetic_energy() + 0.5 * drift * self.force * change
    }
}
