//! What a run took and how well its books balance, for either geometry.

use super::grid::{Grid, Law, View, Watch};
use crate::outcome::Numerics;

pub(super) fn numerics<L: Law>(grid: &Grid<L>, watch: &Watch) -> Numerics {
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
    Numerics {
        steps: grid.step,
        first_time_step: watch.first_time_step,
        smallest_time_step: watch.smallest_time_step,
        elements: (cells(0), target().map(cells).sum()),
        eroded_elements: (0, 0),
        largest_plastic_strain: most(|view| view.plastic_strain),
        largest_temperature: most(|view| view.temperature),
        energy: grid.energy(),
        momentum: grid.momentum(),
        energy_residual: watch.energy_residual,
        momentum_residual: watch.momentum_residual,
    }
}
