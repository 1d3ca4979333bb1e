//! Estimated cost of a run of `axi`, before it starts.

use super::plan::on_cells;
use crate::{Scenario, axi::Axi, model::Model};

/// Processor time that an axisymmetric answer may take unasked [s].
pub const BUDGET: f64 = 60.0;

/// Estimated processor time of a run of `axi` on a mesh [s]. It grows with the third power of the number of cells.
pub fn seconds(scenario: &Scenario, cells_per_radius: u32) -> f64 {
    Axi.estimate(&on_cells(scenario, cells_per_radius)).seconds
}
