//! A material point: a ring of material about the axis.

use serde::{Deserialize, Serialize};

use crate::material::{FlowState, YieldPoint};

/// A material point. Vectors are radial and axial, the axis along the direction of impact; stresses are positive in tension, pressures in
/// compression.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Particle {
    /// Radius and depth [m].
    pub position: [f64; 2],
    /// Velocity [m/s].
    pub velocity: [f64; 2],
    /// Gradient of the affine velocity field about it, `[∂v_r/∂r, ∂v_r/∂z, ∂v_z/∂r, ∂v_z/∂z]` [1/s].
    pub gradient: [f64; 4],
    /// Stress deviator `[rr, zz, rz]` [Pa]; that of the hoop makes the trace vanish.
    pub deviator: [f64; 3],
    /// Pressure, artificial viscosity left out [Pa].
    pub pressure: f64,
    /// Artificial viscosity [Pa].
    pub viscous_pressure: f64,
    /// Mass of the whole ring [kg]; 0 once it has left the body.
    pub mass: f64,
    /// Volume of the whole ring [m3].
    pub volume: f64,
    /// Equivalent plastic strain.
    pub plastic_strain: f64,
    /// Where the particle last stood on its yield surface.
    pub yield_point: YieldPoint,
    /// Temperature [K].
    pub temperature: f64,
    /// Internal energy per mass, 0 at rest [J/kg].
    pub energy: f64,
    /// Damage: 0 sound, 1 failed, without strength in shear and tension.
    pub damage: f64,
    /// Part of its plastic strain that is localized in its row of cells: 0 where strain is even, 1 where it is in this row alone.
    pub localization: f64,
    /// Width and height of its section before the impact [m].
    pub sides: [f64; 2],
}

impl Particle {
    /// Deviatoric hoop stress [Pa].
    #[inline(always)]
    pub fn hoop_deviator(&self) -> f64 {
        -self.deviator[0] - self.deviator[1]
    }

    /// Equivalent stress of von Mises [Pa].
    #[inline(always)]
    pub fn equivalent_stress(&self) -> f64 {
        equivalent(&self.deviator)
    }

    /// Whether it has no strength left in shear and tension.
    #[inline(always)]
    pub fn has_failed(&self) -> bool {
        self.damage >= 1.0
    }

    /// Largest principal stress [Pa].
    pub fn largest_tension(&self) -> f64 {
        let [rr, zz, rz] = self.deviator;
        let in_plane = 0.5 * (rr + zz) + (0.25 * (rr - zz) * (rr - zz) + rz * rz).sqrt();
        in_plane.max(self.hoop_deviator()) - self.pressure
    }

    /// What its strength depends on before it flows.
    #[inline]
    pub fn flow_state(&self) -> FlowState {
        FlowState {
            plastic_strain: self.plastic_strain,
            strain_rate: 0.0,
            temperature: self.temperature,
            pressure: self.pressure,
        }
    }
}

/// Equivalent stress of von Mises of a deviator `[rr, zz, rz]` [Pa].
#[inline(always)]
pub fn equivalent(deviator: &[f64; 3]) -> f64 {
    let [rr, zz, rz] = *deviator;
    // 3/2 s:s with the hoop stress −rr − zz.
    (3.0 * (rr * rr + zz * zz + rr * zz + rz * rz)).sqrt()
}
