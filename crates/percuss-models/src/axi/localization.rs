//! Localization of plastic strain: how much of it is in a row of cells of its own.
//!
//! Where strain localizes, beside a sharp edge or ahead of a crack, its band is as wide as the mesh makes it, and the energy that failure
//! takes is in proportion to the cell. A crack band \[bazant1983\] has a width of its own: what is localized in one row of cells h wide has
//! h/w times its strain in a band w wide, and strain that is even has its own. The mean over the adjacent cells says which part is which.

use crate::solver::Particle;

/// Row and column of a cell.
pub(super) type Cell = (i64, i64);

/// Part of a strain that is in one row of cells only, which the mean over three rows has.
const ROW: f64 = 1.0 / 3.0;

/// Sets the localized part of the plastic strain of particles that are in the order of their cells.
pub(super) fn localize(particles: &mut [Particle], cell: impl Fn(&Particle) -> Cell) {
    let same = |a: &Particle, b: &Particle| cell(a) == cell(b);
    let strains: Vec<(Cell, f64)> = particles
        .chunk_by(same)
        .filter_map(|group| Some((cell(&group[0]), mean(group)?)))
        .collect();
    for group in particles.chunk_by_mut(same) {
        let localization = localized_part(&strains, cell(&group[0]));
        for particle in group {
            particle.localization = localization;
        }
    }
}

/// Mean plastic strain of the sound particles of a cell, if it has any.
fn mean(group: &[Particle]) -> Option<f64> {
    let (mut volume, mut sum) = (0.0, 0.0);
    for particle in group.iter().filter(|particle| !particle.has_failed()) {
        volume += particle.volume;
        sum += particle.volume * particle.plastic_strain;
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

    const SIDE: i64 = 9;

    /// Localized parts in a square of cells with two particles each, by row and column.
    fn parts(strain: impl Fn(Cell) -> f64) -> impl Fn(Cell) -> f64 {
        let mut particles = Vec::new();
        for row in 0..SIDE {
            for column in 0..SIDE {
                for part in [0.9, 1.1] {
                    particles.push(Particle {
                        position: [column as f64, row as f64],
                        volume: 1.0,
                        plastic_strain: part * strain((row, column)),
                        ..Particle::default()
                    });
                }
            }
        }
        localize(&mut particles, |p| {
            (p.position[1] as i64, p.position[0] as i64)
        });
        move |(row, column)| particles[(2 * (SIDE * row + column)) as usize].localization
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
        let mut particles: Vec<Particle> = (0..3)
            .map(|row| Particle {
                position: [0.0, f64::from(row)],
                volume: 1.0,
                plastic_strain: [0.2, 0.4, 9.0][row as usize],
                damage: if row == 2 { 1.0 } else { 0.0 },
                ..Particle::default()
            })
            .collect();
        localize(&mut particles, |p| (p.position[1] as i64, 0));
        assert!((particles[1].localization - 0.375).abs() < 1e-12);
        assert_eq!(particles[2].localization, 0.0);
    }
}
