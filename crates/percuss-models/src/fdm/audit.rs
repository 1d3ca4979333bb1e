//! Audits and limits that both geometries have in common.

use super::grid::{Grid, Law, View};
use crate::{
    error::NumericalError,
    solver::{
        interface::{Audit, BalanceTolerance, Extremes, Retry},
        monitor::{Probe, RunMonitor},
    },
};

/// Part of the first time step below which cells are crushed to nothing: a strain of about 4.6.
const COLLAPSED_STEP: f64 = 1e-2;

/// How often and how strictly the balances are checked.
pub(super) const AUDIT: Audit = Audit {
    interval: 128,
    report_interval: 128,
    tolerance: BalanceTolerance {
        energy: 1e-3,
        momentum: 1e-9,
    },
    retry: Retry::OfBalance { smallest: 0.04 },
};

/// Depth and contact after a step that began at a time [s].
pub(super) fn probe<L: Law>(grid: &Grid<L>, before: f64) -> Probe {
    Probe {
        depth: grid.depth(),
        contact_force: grid.contact_force,
        contact_time: if grid.touches() {
            grid.time - before
        } else {
            0.0
        },
    }
}

/// Whether the projectile's momentum is used up.
pub(super) fn is_at_rest<L: Law>(grid: &Grid<L>, impact_velocity: f64) -> bool {
    // The tail is the last to hear of the impact: no need to sum up before it slows down.
    grid.nodes.velocity[0] < 0.5 * impact_velocity && grid.motion(0).1 <= 0.0
}

/// Whether the time step has collapsed.
///
/// # Errors
/// When it has.
pub(super) fn check_time_step<L: Law>(
    grid: &Grid<L>,
    monitor: &RunMonitor,
) -> Result<(), NumericalError> {
    if grid.time_step >= COLLAPSED_STEP * monitor.first_time_step {
        return Ok(());
    }
    Err(grid.clock().failure(
        format!(
            "the time step has fallen to {:.1e} of the first one, because a cell is crushed to nothing,",
            grid.time_step / monitor.first_time_step
        ),
        "`fdm` has no erosion: use the model `chain`".to_owned(),
    ))
}

/// Mesh and extremes of the material.
pub(super) fn extremes<L: Law>(grid: &Grid<L>) -> Extremes {
    let cells = |body| grid.views(body).count();
    let target = || 1..grid.bodies.len();
    let most = |value: fn(&View) -> f64| {
        let of = |body| {
            grid.views(body)
                .map(|view| value(&view))
                .fold(0.0, f64::max)
        };
        (of(0), target().map(of).fold(0.0, f64::max))
    };
    Extremes {
        elements: (cells(0), target().map(cells).sum()),
        eroded_elements: (0, 0),
        largest_plastic_strain: most(|view| view.plastic_strain),
        largest_temperature: most(|view| view.temperature),
    }
}
