//! Principal stress around particles, by which bonds fail.

use super::{
    body::Body,
    lattice::{Lattice, ROW},
    row::States,
};

impl Body {
    /// Adds numbers of the particles of a row and of their neighbours.
    #[inline(always)]
    pub(super) fn add_neighbours<'a>(
        &'a self,
        row: usize,
        numbers: impl Fn(usize) -> &'a [f64],
        sums: &mut [f64],
    ) {
        let (odd, count) = (row % 2, self.stride - 2);
        let sums = &mut sums[1..][..count];
        for (row, from) in [
            (Some(row), 0),
            (Some(row), 1),
            (Some(row), 2),
            (row.checked_sub(1), odd),
            (row.checked_sub(1), odd + 1),
            (Some(row + 1), odd),
            (Some(row + 1), odd + 1),
        ] {
            if let Some(row) = row.filter(|row| *row < self.rows.len()) {
                let own = &numbers(row)[from..][..count];
                for i in 0..count {
                    sums[i] += own[i];
                }
            }
        }
    }

    /// Larger principal stress around the particles of a row, in that at which bonds start to soften.
    #[inline(always)]
    pub(super) fn tension(
        &self,
        states: &States<'_>,
        row: usize,
        virial: &mut [Vec<f64>; 3],
        tension: &mut [f64],
    ) {
        let Some(softening) = self.softening.as_ref().filter(|_| row < self.rows.len()) else {
            tension.fill(0.0);
            return;
        };
        for (k, sums) in virial.iter_mut().enumerate() {
            sums.fill(0.0);
            let of = |row: usize| {
                let state = states.get(row);
                state.map_or(&[][..], |state| state.virial[k].as_slice())
            };
            self.add_neighbours(row, of, sums);
        }
        let Lattice { mass, spacing, .. } = self.lattice;
        // Half of each bond belongs to a particle, whose area is in proportion to its mass.
        let scale = 0.5 * mass / (ROW * spacing * spacing * softening.strength);
        let count = tension.len();
        let inverse_mass = &self.rows[row].inverse_mass_around[..count];
        let [xx, zz, xz] = virial.each_ref().map(|sum| &sum[..count]);
        for i in 0..count {
            let (mean, half) = (0.5 * (xx[i] + zz[i]), 0.5 * (xx[i] - zz[i]));
            let largest = mean + (half * half + xz[i] * xz[i]).sqrt();
            tension[i] = scale * inverse_mass[i] * largest;
        }
    }
}
