//! Remnant of a projectile: the piece that goes on when debris stays behind in a hole.

use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::PI,
};

use super::{body::Body, kernel::nearest, mesh::Mesh};
use crate::solver::Particle;

/// A piece of a projectile.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Remnant {
    /// [kg].
    pub(super) mass: f64,
    /// Axial momentum [kg m/s].
    pub(super) momentum: f64,
    /// Largest radius [m].
    pub(super) radius: f64,
}

impl Remnant {
    /// The piece with the largest momentum; `None` without material. Particles in the same cell or in cells beside each other are of one piece.
    pub(super) fn of(projectile: &Body, mesh: &Mesh) -> Option<Self> {
        let place = |particle: &Particle| {
            let [column, row] = mesh.indices(particle.position);
            (nearest(row).1, nearest(column).1)
        };
        let present = || {
            projectile
                .particles()
                .filter(|particle| particle.mass > 0.0)
        };
        let pieces = pieces(present().map(|particle| place(&particle)).collect());
        let mut remnants: Vec<Self> = Vec::new();
        for particle in present() {
            let piece = pieces[&place(&particle)];
            if piece >= remnants.len() {
                remnants.resize(piece + 1, Self::default());
            }
            let remnant = &mut remnants[piece];
            remnant.mass += particle.mass;
            remnant.momentum += particle.mass * particle.velocity[1];
            remnant.radius = remnant.radius.max(outer_radius(&particle));
        }
        let by_momentum = |a: &Self, b: &Self| a.momentum.total_cmp(&b.momentum);
        remnants.into_iter().max_by(by_momentum)
    }
}

/// Number of the piece of every occupied node, by row and column.
fn pieces(mut occupied: BTreeSet<(isize, isize)>) -> BTreeMap<(isize, isize), usize> {
    let mut pieces = BTreeMap::new();
    let mut piece = 0;
    while let Some(first) = occupied.pop_first() {
        let mut ahead = vec![first];
        while let Some((row, column)) = ahead.pop() {
            pieces.insert((row, column), piece);
            for place in neighbours(row, column) {
                if occupied.remove(&place) {
                    ahead.push(place);
                }
            }
        }
        piece += 1;
    }
    pieces
}

fn neighbours(row: isize, column: isize) -> impl Iterator<Item = (isize, isize)> {
    (row - 1..=row + 1)
        .flat_map(move |row| (column - 1..=column + 1).map(move |column| (row, column)))
}

/// Radius of a particle and half of what it is wide [m].
pub(super) fn outer_radius(particle: &Particle) -> f64 {
    let radius = particle.position[0];
    let section = particle.volume / (2.0 * PI * radius);
    radius + 0.5 * section.sqrt()
}

#[cfg(test)]
mod tests {
    use super::pieces;

    #[test]
    fn pieces_are_apart_by_an_empty_node() {
        let block = |rows: std::ops::Range<isize>| {
            rows.flat_map(|row| (0..3).map(move |column| (row, column)))
        };
        let pieces = pieces(block(0..4).chain(block(5..9)).chain([(4, 7)]).collect());
        assert_eq!(pieces.len(), 25);
        assert!(block(0..4).all(|place| pieces[&place] == 0));
        let lone = pieces[&(4, 7)];
        let second = pieces[&(6, 1)];
        assert!(block(5..9).all(|place| pieces[&place] == second));
        assert_eq!([lone + second, lone * second], [3, 2]);
    }
}
