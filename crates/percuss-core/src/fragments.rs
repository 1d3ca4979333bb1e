//! Pieces that fly free at the end of a run.

use serde::Serialize;

/// A piece of a body that nothing holds, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Fragment {
    /// Bodies that it comes from, in words.
    pub origin: String,
    /// Initial position of its rear end, struck face at 0, depth positive [m].
    pub initial_from: f64,
    /// Initial position of its front end [m].
    pub initial_to: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Mean velocity, forward positive [m/s].
    pub velocity: f64,
    /// Unloaded length [m].
    pub length: f64,
    /// Largest unloaded diameter [m].
    pub diameter: f64,
    /// Position of its centre of mass [m].
    pub position: f64,
}

impl Fragment {
    /// Kinetic energy of its flight, without that of waves in it [J].
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass * self.velocity * self.velocity
    }
}

/// A fragment in the field's units, as `--json` prints it and tables show it. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FragmentRecord {
    /// Bodies that it comes from: `projectile`, `target`, `layer 2`, `layers 1 to 2`.
    pub origin: String,
    /// Initial position of its rear end, struck face at 0, depth positive [mm].
    pub initial_from_mm: f64,
    /// Initial position of its front end [mm].
    pub initial_to_mm: f64,
    /// Mass [g].
    pub mass_g: f64,
    /// Mean velocity at the end, forward positive [m/s].
    pub velocity_m_s: f64,
    /// Unloaded length [mm].
    pub length_mm: f64,
    /// Largest unloaded diameter [mm].
    pub diameter_mm: f64,
    /// Position of its centre of mass at the end [mm].
    pub position_mm: f64,
    /// Kinetic energy of its flight [J].
    pub kinetic_energy_j: f64,
}

impl From<&Fragment> for FragmentRecord {
    fn from(fragment: &Fragment) -> Self {
        Self {
            origin: fragment.origin.clone(),
            initial_from_mm: fragment.initial_from * 1e3,
            initial_to_mm: fragment.initial_to * 1e3,
            mass_g: fragment.mass * 1e3,
            velocity_m_s: fragment.velocity,
            length_mm: fragment.length * 1e3,
            diameter_mm: fragment.diameter * 1e3,
            position_mm: fragment.position * 1e3,
            kinetic_energy_j: fragment.kinetic_energy(),
        }
    }
}
