//! Localization of plastic strain: how much of it is in a row of cells of its own.
//!
//! Where strain localizes, beside a sharp edge or ahead of a crack, its band is as wide as the mesh makes it, and the energy that failure
//! takes is in proportion to the cell. A crack band \[bazant1983\] has a width of its own: what is localized in one row of cells h wide has
//! h/w times its strain in a band w wide, and strain that is even has its own. The mean over the adjacent cells says which part is which.

use super::block::Block;
use crate::lanes::LANES;

/// Row and column of a cell.
pub(super) type Cell = (i64, i64);

/// Part of a strain that is in one row of cells only, which the mean over three rows has.
const ROW: f64 = 1.0 / 3.0;

/// Sets the localized part of the plastic strain of particles, given the cells and places of the particles in the order of the cells.
pub(super) fn localize(blocks: &mut [Block], order: &[(u64, usize)]) {
    let groups = || order.chunk_by(|a, b| a.0 == b.0);
    let strains: Vec<(Cell, f64)> = groups()
        .filter_map(|group| Some((cell(group[0].0), mean(blocks, group)?)))
        .collect();
    for group in groups() {
        let part = localized_part(&strains, cell(group[0].0));
        for (_, place) in group {
            blocks[place / LANES].localization[place % LANES] = part;
        }
    }
}

/// Row and column that a key stands for, from the same origin for all.
fn cell(key: u64) -> Cell {
    ((key >> 32) as i64, (key & u64::from(u32::MAX)) as i64)
}

/// Mean plastic strain of the sound particles of a cell, if it has any.
fn mean(blocks: &[Block], group: &[(u64, usize)]) -> Option<f64> {
    let (mut volume, mut sum) = (0.0, 0.0);
    for (_, place) in group {
        let (block, lane) = (&blocks[place / LANES], place % LANES);
        if block.damage[lane] < 1.0 {
            volume += block.volume[lane];
            sum += block.volume[lane] * block.plastic_strain[lane];
        }
    }
    (volume > 0.0).then(|| sum / volume)
}

/// Part of the strain of a cell that its neighbours do not have: 0 where strain is even, 1 where it is in one row.
fn localized_part(strains: &[(Cell, f64)], (row, column): Cell) -> f64 {
    let strain = |cell: Cell| {
        let place = strains.binary_search_by_key(&cell, |(cell, _)| *cell);
        place.ok().map(|place| strains[place].1)
    };
    let Some(own) = strain((row, column)).filter(|own| *own > 0.0) else {
        return 0.0;
    };
    let (mut count, mut sum) = (0.0, 0.0);
    for row in row - 1..=row + 1 {
        for column in column - 1..=column + 1 {
            if let Some(strain) = strain((row, column)) {
                count += 1.0;
                sum += strain;
            }
        }
    }
    ((1.0 - sum / (count * own)) / (1.0 - ROW)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::Particle;

    const SIDE: i64 = 9;

    /// Localized parts of particles of unit volume in cells that are given with their strain and damage, in the order of the cells.
    fn localized(cells: &[(Cell, [f64; 2])]) -> Vec<f64> {
        let mut blocks = vec![Block::default(); cells.len().div_ceil(LANES)];
        let mut order = Vec::new();
        for (place, &((row, column), [plastic_strain, damage])) in cells.iter().enumerate() {
            let particle = Particle {
                volume: 1.0,
                mass: 1.0,
                plastic_strain,
                damage,
                ..Particle::default()
            };
            blocks[place / LANES].set_particle(place % LANES, &particle);
            order.push((((row as u64) << 32) | column as u64, place));
        }
        localize(&mut blocks, &order);
        (0..cells.len())
            .map(|place| blocks[place / LANES].localization[place % LANES])
            .collect()
    }

    /// Localized parts in a square of cells with two particles each, by row and column.
    fn parts(strain: impl Fn(Cell) -> f64) -> impl Fn(Cell) -> f64 {
        let mut cells = Vec::new();
        for row in 0..SIDE {
            for column in 0..SIDE {
                for part in [0.9, 1.1] {
                    cells.push(((row, column), [part * strain((row, column)), 0.0]));
                }
            }
        }
        let found = localized(&cells);
        move |(row, column)| found[(2 * (SIDE * row + column)) as usize]
    }

    #[test]
    fn even_and_linear_strain_is_not_localized() {
        for (row, column) in [(0, 0), (4, 4), (0, 5), (8, 3)] {
            assert!(parts(|_| 0.3)((row, column)) < 1e-12);
            assert!(parts(|_| 0.0)((row, column)) < 1e-12);
        }
        let linear = parts(|(row, column)| 0.1 + 0.02 * row as f64 - 0.01 * column as f64);
        assert!(linear((4, 4)) < 1e-12 && linear((6, 2)) < 1e-12);
    }

    #[test]
    fn strain_in_one_row_or_column_is_localized_and_its_neighbours_are_not() {
        for along in [true, false] {
            let band = parts(|(row, column)| {
                if (if along { row } else { column }) == 4 {
                    0.5
                } else {
                    0.0
                }
            });
            let at = |place: i64| {
                if along {
                    band((place, 4))
                } else {
                    band((4, place))
                }
            };
            assert!((at(4) - 1.0).abs() < 1e-12);
            assert!(at(3) < 1e-12 && at(6) < 1e-12);
        }
        // In two rows a third is missing, in three nothing.
        let two = parts(|(row, _)| if (4..6).contains(&row) { 0.5 } else { 0.0 });
        assert!((two((4, 4)) - 0.5).abs() < 1e-12);
        let three = parts(|(row, _)| if (3..6).contains(&row) { 0.5 } else { 0.0 });
        assert!(three((4, 4)) < 1e-12);
        // On an even strain it is the part beyond that.
        let raised = parts(|(row, _)| if row == 4 { 0.5 } else { 0.2 });
        assert!((raised((4, 4)) - 0.6).abs() < 1e-12);
    }

    #[test]
    fn failed_particles_are_no_neighbours() {
        let found = localized(&[
            ((0, 0), [0.2, 0.0]),
            ((1, 0), [0.4, 0.0]),
            ((2, 0), [9.0, 1.0]),
        ]);
        assert!((found[1] - 0.375).abs() < 1e-12);
        assert_eq!(found[2], 0.0);
    }
}
