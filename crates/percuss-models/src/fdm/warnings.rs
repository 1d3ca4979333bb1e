//! Warnings of states beyond the range of a material record.

use super::grid::{Grid, Law};
use crate::{material::Reached, scenario::Scenario};

/// Warnings on the material of each body.
pub(super) fn of_materials<L: Law>(
    scenario: &Scenario,
    grid: &Grid<L>,
    heated: bool,
) -> Vec<Vec<String>> {
    let bodies = scenario.bodies().into_iter().enumerate();
    let of_body = |(body, (what, material)): (usize, (String, &_))| {
        let (mut strain, mut rate, mut temperature) = (0.0_f64, 0.0_f64, 0.0_f64);
        for view in grid.views(body) {
            strain = strain.max(view.plastic_strain);
            rate = rate.max(view.strain_rate);
            temperature = temperature.max(view.temperature);
        }
        let reached = Reached {
            plastic_strain: strain,
            strain_rate: Some(rate),
            temperature,
        };
        reached.warnings(&what, material, heated)
    };
    bodies.map(of_body).collect()
}
