//! Work and kinetic energy of the target around the floor of a crater.

use std::f64::consts::PI;

use super::super::power_balance::fields::punch;
use crate::material::plastic_cavity_pressure;

/// A target that flows at one stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Target {
    /// Density [kg/m3].
    pub(super) density: f64,
    /// Flow stress [Pa].
    pub(super) strength: f64,
    /// Young's modulus [Pa].
    pub(super) youngs_modulus: f64,
    /// Whether the free surface around the entry lowers the resistance.
    pub(super) entry: bool,
}

impl Target {
    /// Energy per volume of a deep crater [J/m3]: the pressure of an incompressible spherical cavity.
    pub(super) fn deep(&self) -> f64 {
        plastic_cavity_pressure(self.strength, self.youngs_modulus)
    }

    /// Energy per volume that a floor at a depth [m] takes [J/m3]: the least of two fields.
    ///
    /// At the surface metal rises around a punch. From a deeper floor it has to lift a collar of that depth, which shears along
    /// its outer face: `2πRPτ` at the speed `a²/(R² − a²)`.
    pub(super) fn resistance(&self, depth: f64, radius: f64) -> f64 {
        if !self.entry {
            return self.deep();
        }
        let collar = 2.0 * punch::EXTENT / (punch::EXTENT * punch::EXTENT - 1.0) / 3.0_f64.sqrt();
        (self.strength * (punch::PRESSURE + collar * depth.max(0.0) / radius)).min(self.deep())
    }

    /// Extent of the plastic zone in radii of the floor: `(2E/3Y)^⅓`.
    pub(super) fn extent(&self) -> f64 {
        (2.0 * self.youngs_modulus / (3.0 * self.strength)).cbrt()
    }

    /// Mass that moves with a hemispherical floor of a radius [m] [kg]: twice its kinetic energy over U² in the irrotational
    /// flow between the floor and the end of the plastic zone, `⅓πρb³ (α³ + 2)/(α³ − 1)`.
    pub(super) fn moving_mass(&self, radius: f64) -> f64 {
        let cube = self.extent().powi(3);
        PI / 3.0 * self.density * radius.powi(3) * (cube + 2.0) / (cube - 1.0)
    }
}
