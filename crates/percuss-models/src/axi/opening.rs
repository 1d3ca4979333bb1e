//! Openings: whether material at the axis still hangs on the rest of a target.

use std::{
    collections::{HashMap, HashSet},
    f64::consts::PI,
};

use super::{body::Body, localization::Cell, mesh::Mesh};

/// Part of a cell that sound material fills where it holds on to its neighbours.
const FILLED: f64 = 0.5;
/// Radius beyond which material is the rest of a target, in radii of the projectile: a plug and petals are within it.
const REST: f64 = 2.0;

/// Whether a target is open: no sound material at the axis, or none that adjacent cells of sound material join to the rest.
pub(super) fn is_open(target: &Body, mesh: &Mesh, projectile_radius: f64) -> bool {
    let filled = filled_cells(target, mesh);
    let rest = mesh.radial.index(REST * projectile_radius) as i64;
    let mut ahead: Vec<Cell> = filled
        .iter()
        .copied()
        .filter(|(_, column)| *column == 0)
        .collect();
    let mut seen: HashSet<Cell> = ahead.iter().copied().collect();
    while let Some((row, column)) = ahead.pop() {
        if column >= rest {
            return false;
        }
        for next in [
            (row, column - 1),
            (row, column + 1),
            (row - 1, column),
            (row + 1, column),
        ] {
            if filled.contains(&next) && seen.insert(next) {
                ahead.push(next);
            }
        }
    }
    true
}

/// Cells that sound material fills.
fn filled_cells(target: &Body, mesh: &Mesh) -> HashSet<Cell> {
    let mut parts: HashMap<Cell, f64> = HashMap::new();
    for particle in target
        .particles()
        .filter(|p| p.mass > 0.0 && !p.has_failed())
    {
        let [column, row] = mesh.indices(particle.position);
        let cell = mesh.cell * mesh.cell * mesh.radial.stretch(column) * mesh.axial.stretch(row);
        let section = particle.volume / (2.0 * PI * particle.position[0]);
        *parts
            .entry((row.floor() as i64, column.floor() as i64))
            .or_default() += section / cell;
    }
    parts.retain(|_, part| *part > FILLED);
    parts.into_keys().collect()
}
