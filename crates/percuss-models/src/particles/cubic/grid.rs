//! Places of a body-centred cubic lattice in layers.

use super::lattice::VECTORS;

/// Shape of the layers of a body. Every one has a place without a particle on all its sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) struct Grid {
    pub(in super::super) layers: usize,
    /// Particles along a row of an even layer; an odd one has one less.
    pub(in super::super) columns: usize,
    /// Rows of an even layer; an odd one has one less.
    pub(in super::super) rows: usize,
}

impl Grid {
    /// Places from one row of a layer to the next.
    pub(super) fn stride(&self) -> usize {
        self.columns + 2
    }

    /// Places of a layer.
    pub(super) fn places(&self) -> usize {
        (self.rows + 2) * self.stride()
    }

    /// Place of the second particle of a bond less that of the first, and layers between them.
    #[inline(always)]
    pub(super) fn offset(&self, kind: usize, layer: usize) -> (isize, usize) {
        let (stride, odd) = (self.stride() as isize, (layer % 2) as isize);
        let on_next = odd * (stride + 1);
        match kind {
            0 => (1, 0),
            1 => (stride, 0),
            2 => (0, 2),
            3 => (on_next - stride - 1, 1),
            4 => (on_next - stride, 1),
            5 => (on_next - 1, 1),
            _ => (on_next, 1),
        }
    }

    /// Layer and place at half sides from the first particle, if the grid has one there.
    pub(super) fn at(&self, [x, y, z]: [i64; 3]) -> Option<(usize, usize)> {
        let layer = usize::try_from(z).ok().filter(|z| *z < self.layers)?;
        let odd = (layer % 2) as i64;
        let less = layer % 2;
        let along = |half: i64, most: usize| {
            let number = usize::try_from((half - odd).div_euclid(2)).ok()?;
            (number < most - less).then_some(number)
        };
        let (column, row) = (along(x, self.columns)?, along(y, self.rows)?);
        Some((layer, (row + 1) * self.stride() + column + 1))
    }

    /// Column and row of a place.
    pub(super) fn column_and_row(&self, place: usize) -> [f64; 2] {
        let stride = self.stride();
        [place % stride, place / stride].map(|number| number as f64 - 1.0)
    }
}

/// The bond between two neighbours, half sides from the first particle: which of them it starts at, and its kind.
pub(super) fn bond_between(a: [i64; 3], b: [i64; 3]) -> ([i64; 3], usize) {
    let way = [0, 1, 2].map(|axis| b[axis] - a[axis]);
    let found = |way: [i64; 3]| {
        let is = |vector: &[f64; 3]| vector.map(|part| (2.0 * part) as i64) == way;
        VECTORS.iter().position(is)
    };
    match found(way) {
        Some(kind) => (a, kind),
        None => (b, found(way.map(|part| -part)).unwrap_or(0)),
    }
}

/// Places of a layer that can have particles, each with its half sides from the first particle.
pub(super) fn halves(grid: Grid, layer: usize) -> impl Iterator<Item = ([i64; 3], usize)> {
    let odd = layer % 2;
    (0..grid.rows - odd).flat_map(move |row| {
        (0..grid.columns - odd).map(move |column| {
            let half = [2 * column + odd, 2 * row + odd, layer].map(|number| number as i64);
            (half, (row + 1) * grid.stride() + column + 1)
        })
    })
}
