//! Graded grid: nodes stand evenly as far as the crater may reach, and farther and farther apart beyond.
//!
//! Everything on the grid works in indices: a smooth map from positions to indices takes the place of a division by the cell's side
//!. Where it stretches a cell by `J`, derivatives along that direction are smaller by `J`, and lengths larger.

use std::f64::consts::PI;

use crate::lanes::{LANES, Lanes, each_of, lanes, larger};

/// Positions of nodes along one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    cell: f64,
    /// Position up to which nodes stand evenly, in cells.
    even: f64,
    /// Part by which each cell beyond is larger than the one before.
    growth: f64,
    /// One over the side of an even cell [1/m], and one over the growth.
    per_cell: f64,
    per_growth: f64,
}

impl Axis {
    /// Even everywhere.
    pub(super) const fn even(cell: f64) -> Self {
        Self::graded(cell, f64::INFINITY, 1.0)
    }

    /// Even up to a number of cells; beyond, each cell is larger than the one before by a part of the first.
    pub(super) const fn graded(cell: f64, even: f64, growth: f64) -> Self {
        Self {
            cell,
            even,
            growth,
            per_cell: 1.0 / cell,
            per_growth: 1.0 / growth,
        }
    }

    /// Even up to a number of cells; beyond, cells grow by up to a part of the first, so that a node stands at an end [m].
    pub(super) fn fitted(cell: f64, even: f64, growth: f64, end: f64) -> Self {
        let beyond = end / cell - even;
        let nodes = (((1.0 + 2.0 * growth * beyond.max(0.0)).sqrt() - 1.0) / growth).ceil();
        let growth = 2.0 * (beyond - nodes) / (nodes * nodes);
        // Not far enough away to be worth it.
        if growth.is_nan() || growth <= 0.0 {
            return Self::even(cell);
        }
        Self::graded(cell, even, growth)
    }

    /// Index of a position [m], and how much a cell there is stretched.
    #[inline(always)]
    fn mapped(&self, position: f64) -> [f64; 2] {
        let place = position * self.per_cell;
        let beyond = larger(place - self.even, 0.0);
        let stretch = (1.0 + 2.0 * self.growth * beyond).sqrt();
        [place - beyond + (stretch - 1.0) * self.per_growth, stretch]
    }

    /// Indices and stretches of a block; the same numbers without a root where all of it is in even cells.
    #[inline(always)]
    fn mapped_lanes(&self, position: &Lanes) -> [Lanes; 2] {
        let place = lanes(|l| position[l] * self.per_cell);
        if (0..LANES).all(|l| place[l] <= self.even) {
            return [place, Lanes::all(1.0)];
        }
        each_of(|l| self.mapped(position[l]))
    }

    /// Index of a position [m].
    pub(super) fn index(&self, position: f64) -> f64 {
        self.mapped(position)[0]
    }

    /// Position of an index [m].
    pub(super) fn position(&self, index: f64) -> f64 {
        let beyond = (index - self.even).max(0.0);
        self.cell * (index + 0.5 * self.growth * beyond * beyond)
    }

    /// How much larger a cell is at an index than an even one.
    pub(super) fn stretch(&self, index: f64) -> f64 {
        1.0 + self.growth * (index - self.even).max(0.0)
    }

    /// Index up to which nodes stand evenly.
    pub(super) fn even_to(&self) -> f64 {
        self.even
    }

    /// Integral of a node's kernel over the direction, each position weighted by a function of it in cells [cells].
    fn integral(&self, node: f64, weight: impl Fn(f64) -> f64) -> f64 {
        // Three points are exact for the polynomials on half a cell.
        const POINTS: [(f64, f64); 3] = [
            (-0.774_596_669_241_483_4, 5.0 / 18.0),
            (0.0, 4.0 / 9.0),
            (0.774_596_669_241_483_4, 5.0 / 18.0),
        ];
        let mut sum = 0.0;
        for piece in 0..6 {
            for (point, share) in POINTS {
                let distance = -1.5 + 0.5 * (f64::from(piece) + 0.5 + 0.5 * point);
                let index = node + distance;
                let kernel = match distance.abs() {
                    near if near < 0.5 => 0.75 - near * near,
                    far => 0.5 * (1.5 - far) * (1.5 - far),
                };
                let position = self.position(index) / self.cell;
                sum += 0.5 * share * kernel * weight(position) * self.stretch(index);
            }
        }
        sum
    }
}

/// Positions of the nodes. Columns are counted with the mirrored one: column 1 is the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mesh {
    /// Side of an even cell [m].
    pub(super) cell: f64,
    pub(super) radial: Axis,
    pub(super) axial: Axis,
}

/// Indices of the particles of a block and how much the cells there are stretched, radial and axial.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    pub(super) index: [Lanes; 2],
    pub(super) stretch: [Lanes; 2],
}

impl Mesh {
    /// The same cells everywhere.
    #[cfg(test)]
    pub(super) const fn even(cell: f64) -> Self {
        Self {
            cell,
            radial: Axis::even(cell),
            axial: Axis::even(cell),
        }
    }

    /// Places of particles at positions [m].
    #[inline(always)]
    pub(super) fn places(&self, [radius, depth]: &[Lanes; 2]) -> Places {
        let [radial, radial_stretch] = self.radial.mapped_lanes(radius);
        let [axial, axial_stretch] = self.axial.mapped_lanes(depth);
        Places {
            index: [radial, axial],
            stretch: [radial_stretch, axial_stretch],
        }
    }

    /// Indices of a position [m].
    pub(super) fn indices(&self, [radius, depth]: [f64; 2]) -> [f64; 2] {
        [self.radial.index(radius), self.axial.index(depth)]
    }

    /// Row of nodes nearest to a depth [m].
    pub(super) fn row(&self, depth: f64) -> isize {
        self.axial.index(depth).round() as isize
    }

    /// Column of nodes nearest to a radius [m].
    pub(super) fn column(&self, radius: f64) -> usize {
        self.radial.index(radius).round() as usize + 1
    }

    /// Depth of a row, which may lie between two of nodes [m].
    pub(super) fn depth(&self, row: f64) -> f64 {
        self.axial.position(row)
    }

    /// Radius of a column, which may lie between two of nodes [m].
    pub(super) fn radius(&self, column: f64) -> f64 {
        self.radial.position(column - 1.0)
    }

    /// How much larger cells are at a row than even ones.
    pub(super) fn row_stretch(&self, row: isize) -> f64 {
        self.axial.stretch(row as f64)
    }

    /// How much larger cells are at a column than even ones.
    pub(super) fn column_stretch(&self, column: usize) -> f64 {
        self.radial.stretch(column as f64 - 1.0)
    }

    /// Area of a plane across the axis that a column has [m2].
    pub(super) fn ring(&self, column: usize) -> f64 {
        match column {
            // The axis has a disc of half a cell's radius.
            1 => 0.25 * PI * self.cell * self.cell,
            _ => 2.0 * PI * self.radius(column as f64) * self.cell * self.column_stretch(column),
        }
    }

    /// Area of a cylinder about the axis at a column that a row has [m2].
    pub(super) fn sleeve(&self, column: usize, row: isize) -> f64 {
        2.0 * PI * self.radius(column as f64) * self.cell * self.row_stretch(row)
    }

    /// Volume of the cell around a node that is full of material: the integral of its kernel [m3].
    pub(super) fn full_volume(&self, row: isize, column: usize) -> f64 {
        2.0 * PI * self.cell.powi(3) * self.radial_share(column) * self.axial_share(row)
    }

    fn radial_share(&self, column: usize) -> f64 {
        let node = column as f64 - 1.0;
        match column {
            0 => 0.0,
            1 => 13.0 / 64.0,
            2 => 1.0 + 1.0 / 192.0,
            _ if node + 1.5 <= self.radial.even_to() => node,
            _ => self.radial.integral(node, |radius| radius),
        }
    }

    fn axial_share(&self, row: isize) -> f64 {
        let node = row as f64;
        if node + 1.5 <= self.axial.even_to() {
            1.0
        } else {
            self.axial.integral(node, |_| 1.0)
        }
    }
}

/// A length of the cells at the places of particles [m].
#[inline(always)]
pub(super) fn cell_lengths(cell: f64, places: &Places) -> Lanes {
    let [radial, axial] = places.stretch;
    lanes(|l| 0.5 * cell * (radial[l] + axial[l]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_and_positions_are_inverse_and_cells_grow_by_the_given_part() {
        let axis = Axis::graded(0.5, 8.0, 0.4);
        for position in [-7.0, 0.0, 3.9, 4.0, 4.1, 9.0, 60.0] {
            let [index, stretch] = axis.mapped(position);
            assert!((axis.position(index) - position).abs() < 1e-12);
            assert!((axis.stretch(index) - stretch).abs() < 1e-12);
        }
        assert_eq!(axis.position(5.0), 2.5);
        let fitted = Axis::fitted(0.5, 8.0, 0.4, 17.3);
        let end = fitted.index(17.3);
        assert!((end - end.round()).abs() < 1e-12 && fitted.growth > 0.3);
        assert_eq!(Axis::fitted(0.5, 8.0, 0.4, 4.5), Axis::even(0.5));
        let [a, b, c] = [10.0, 11.0, 12.0].map(|index| axis.position(index));
        assert!((c - 2.0 * b + a - 0.5 * 0.4).abs() < 1e-12);
    }

    #[test]
    fn full_volumes_are_those_of_the_rings_together() {
        // All nodes that reach into a cylinder, over which the kernels add up to one.
        let mesh = Mesh {
            cell: 0.5,
            radial: Axis::graded(0.5, 4.0, 0.3),
            axial: Axis::graded(0.5, 6.0, 0.5),
        };
        let volume = |columns: std::ops::Range<usize>, rows: std::ops::Range<isize>| -> f64 {
            let column = |column| rows.clone().map(move |row| mesh.full_volume(row, column));
            columns.flat_map(column).sum()
        };
        // Two windows that differ by one full cell at each end, counted in halves.
        let annulus = volume(8..12, 10..14);
        let [inner, outer] = [8, 12].map(|column| mesh.radius(column as f64 - 0.5));
        let height = mesh.depth(13.5) - mesh.depth(9.5);
        let exact = PI * (outer * outer - inner * inner) * height;
        assert!((annulus / exact - 1.0).abs() < 0.02, "{annulus} {exact}");
        assert_eq!(mesh.full_volume(0, 3), 2.0 * PI * 0.125 * 2.0);
        let even = Mesh::even(0.5);
        let direct = even.radial.integral(2.0, |radius| radius);
        assert!((direct - 2.0).abs() < 1e-12);
    }
}
