//! What is followed during a run.

use super::{Grid, Law};
use crate::error::NumericalError;

/// Largest energy residual of a run that counts.
const ENERGY_TOLERANCE: f64 = 1e-3;
/// Largest momentum residual of a run that counts.
const MOMENTUM_TOLERANCE: f64 = 1e-9;
/// Part of the first time step below which cells are crushed to nothing: a strain of about 4.6.
const COLLAPSED_STEP: f64 = 1e-2;
/// Steps between two looks at the books.
pub(in crate::fdm) const AUDIT_INTERVAL: u64 = 128;

/// Extremes of a run and the state of its books.
#[derive(Debug, Default)]
pub(in crate::fdm) struct Watch {
    pub(in crate::fdm) largest_depth: f64,
    pub(in crate::fdm) peak_force: f64,
    pub(in crate::fdm) first_time_step: f64,
    pub(in crate::fdm) smallest_time_step: f64,
    pub(in crate::fdm) energy_residual: f64,
    pub(in crate::fdm) momentum_residual: f64,
    /// Total time during which the projectile touches the target [s].
    pub(in crate::fdm) contact_time: f64,
    /// Time up to which the run was followed [s].
    followed: f64,
    /// Time and depth at which the projectile's momentum was first used up.
    pub(in crate::fdm) at_rest: Option<(f64, f64)>,
}

impl Watch {
    /// Keeps up extremes after a step.
    pub(in crate::fdm) fn follow<L: Law>(&mut self, grid: &Grid<L>, impact_speed: f64) {
        let depth = grid.depth();
        self.largest_depth = self.largest_depth.max(depth);
        self.peak_force = self.peak_force.max(grid.contact_force);
        if grid.touches() {
            self.contact_time += grid.time - self.followed;
        }
        self.followed = grid.time;
        if grid.step == 1 {
            self.first_time_step = grid.time_step;
            self.smallest_time_step = grid.time_step;
        }
        self.smallest_time_step = self.smallest_time_step.min(grid.time_step);
        // The tail is the last to hear of the impact: no need to sum up before it slows down.
        let slowed = grid.nodes[0].velocity < 0.5 * impact_speed;
        if self.at_rest.is_none() && slowed && grid.motion(0).1 <= 0.0 {
            self.at_rest = Some((grid.time, depth));
        }
    }

    /// Looks at the books.
    ///
    /// # Errors
    /// When they do not balance.
    pub(in crate::fdm) fn audit<L: Law>(
        &mut self,
        grid: &Grid<L>,
        courant: f64,
    ) -> Result<(), NumericalError> {
        let (energy, momentum) = (grid.energy().residual(), grid.momentum().residual());
        self.energy_residual = self.energy_residual.max(energy.abs());
        self.momentum_residual = self.momentum_residual.max(momentum.abs());
        for (book, residual, tolerance) in [
            ("energy", energy, ENERGY_TOLERANCE),
            ("momentum", momentum, MOMENTUM_TOLERANCE),
        ] {
            if residual.is_nan() || residual.abs() > tolerance {
                return Err(failure(
                    grid,
                    format!(
                        "the {book} book is off by {residual:.2e} of the initial {book}, more than {tolerance:e},"
                    ),
                    format!("lower `fdm.courant` (now {courant})"),
                ));
            }
        }
        Ok(())
    }

    /// Whether the time step has collapsed.
    ///
    /// # Errors
    /// When it has.
    pub(in crate::fdm) fn check_time_step<L: Law>(
        &self,
        grid: &Grid<L>,
    ) -> Result<(), NumericalError> {
        if grid.time_step >= COLLAPSED_STEP * self.first_time_step {
            return Ok(());
        }
        Err(failure(
            grid,
            format!(
                "the time step has fallen to {:.1e} of the first one, because a cell is crushed to nothing,",
                grid.time_step / self.first_time_step
            ),
            "`fdm` has no erosion: use the model `chain`".to_owned(),
        ))
    }
}

fn failure<L: Law>(grid: &Grid<L>, what: String, remedy: String) -> NumericalError {
    NumericalError {
        what,
        step: grid.step,
        time_us: grid.time * 1e6,
        element: None,
        remedy,
    }
}
