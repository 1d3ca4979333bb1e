//! Openings: whether material at the axis is still connected to the rest of a target.

use std::collections::HashSet;

use super::{body::Body, kernel::nearest, mesh::Mesh};
use crate::solver::Particle;

/// Radius beyond which material is the rest of a target, in radii of the projectile: a plug and petals are within it.
const REST: f64 = 2.0;
/// Nodes to either side that a particle reaches from the one nearest to it.
const REACH: isize = 1;

/// Whether a target is open: no sound material at the axis, or none that is connected to the rest. Particles that reach a common node move
/// together: they are connected.
pub(super) fn is_open(target: &Body, mesh: &Mesh, projectile_radius: f64) -> bool {
    let is_left = |particle: &Particle| particle.mass > 0.0;
    let place = |particle: Particle| {
        let [column, row] = mesh.indices(particle.position);
        (nearest(row).1, nearest(column).1)
    };
    // A target that is no wider has its rim for the rest.
    let columns = target.particles().filter(is_left).map(|p| place(p).1);
    let rest = mesh.radial.index(REST * projectile_radius) as isize;
    let rest = rest.min(columns.max().unwrap_or(0));
    // Nodes that are nearest to a sound particle, by row and column.
    let sound = target.particles().filter(is_left);
    let mut places: HashSet<(isize, isize)> = sound
        .filter(|particle| !particle.has_failed())
        .map(place)
        .filter(|(_, column)| *column <= rest)
        .collect();
    let mut ahead: Vec<(isize, isize)> = places
        .iter()
        .copied()
        .filter(|(_, column)| *column <= REACH)
        .collect();
    for place in &ahead {
        places.remove(place);
    }
    while let Some((row, column)) = ahead.pop() {
        if column >= rest {
            return false;
        }
        for row in row - 2 * REACH..=row + 2 * REACH {
            for column in column - 2 * REACH..=column + 2 * REACH {
                if places.remove(&(row, column)) {
                    ahead.push((row, column));
                }
            }
        }
    }
    true
}
