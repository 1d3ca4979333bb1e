//! Estimated cost of a run of `axi`, before it starts.

use super::plan::on_cells;
use crate::{Scenario, axi};

/// Processor time that an axisymmetric answer may take unasked [s].
pub const BUDGET: f64 = 60.0;

/// Particles times steps per second of processor time: 7 to 14 million on one core of 2024.
const RATE: f64 = 10e6;
/// Steps of a run per cell along the radius: at least, and per diameter of the projectile's length.
const STEPS: (f64, f64) = (21.0, 43.0);

/// Estimated processor time of a run of `axi` on a mesh [s]: particles times steps over a rate. It grows with the third power of the
/// number of cells.
pub fn seconds(scenario: &Scenario, cells_per_radius: u32) -> f64 {
    let slenderness = scenario.projectile.length / scenario.projectile.diameter;
    let steps = f64::from(cells_per_radius) * (STEPS.0 + STEPS.1 * slenderness);
    let scenario = on_cells(scenario, cells_per_radius);
    axi::particles(&scenario) * steps / RATE
}
