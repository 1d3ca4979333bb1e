//! Body of a picture on a grid of nodes coarser than the pixels.

/// Nodes along the size of a particle.
const NODES: f32 = 2.0;
/// Reach of a particle, in sizes of the particle, within which it closes gaps to its neighbours in stretched material. What that
/// adds at a surface is taken away again, except the half size that belongs to the particle.
const REACH: f32 = 2.4;
/// That of a lattice, whose bonds hardly stretch: slots and open cracks stay open.
const REACH_OF_LATTICE: f32 = 0.95;
const OWN: f32 = 0.5;
/// Distances are followed this many nodes beyond where they are needed, so that they can be interpolated.
const BEYOND: f32 = 1.5;

/// A body on a grid of nodes. Lengths are in pixels; the first node stands in the corner of the picture.
pub(super) struct Layer {
    columns: usize,
    rows: usize,
    spacing: f32,
    reach: f32,
    /// How much of the reach is taken away again at a surface.
    excess: f32,
    /// Square of the distance to the nearest particle; after [`Self::close`] how far the node lies inside the body.
    inside: Vec<f32>,
    /// Sum of the weights of the particles near a node, and of their values times the weights.
    sums: Vec<[f32; 2]>,
}

impl Layer {
    /// An empty one for a picture of columns and rows of pixels, with particles of a size, of a lattice or not.
    pub(super) fn new((columns, rows): (usize, usize), size: f32, is_lattice: bool) -> Self {
        let spacing = (size / NODES).max(1.0);
        let nodes = |pixels: usize| (pixels as f32 / spacing).ceil() as usize + 2;
        let (columns, rows) = (nodes(columns), nodes(rows));
        let reach = if is_lattice { REACH_OF_LATTICE } else { REACH };
        let reach = (reach * size).max(1.5);
        Self {
            columns,
            rows,
            spacing,
            reach,
            excess: reach - OWN * size,
            inside: vec![f32::INFINITY; columns * rows],
            sums: vec![[0.0; 2]; columns * rows],
        }
    }

    /// Adds a particle at a place.
    pub(super) fn add(&mut self, [x, y]: [f32; 2], value: f32) {
        let reach = self.reach + BEYOND * self.spacing;
        let near = |middle: f32, most: usize| {
            let from = ((middle - reach) / self.spacing).ceil().max(0.0) as usize;
            let to = ((middle + reach) / self.spacing).floor().max(-1.0) + 1.0;
            from..(to as usize).min(most)
        };
        let (columns, square) = (near(x, self.columns), self.reach * self.reach);
        for row in near(y, self.rows) {
            let off = row as f32 * self.spacing - y;
            for column in columns.clone() {
                let aside = column as f32 * self.spacing - x;
                let distance = off * off + aside * aside;
                let at = row * self.columns + column;
                self.inside[at] = self.inside[at].min(distance);
                let weight = (1.0 - distance / square).max(0.0).powi(4);
                self.sums[at][0] += weight;
                self.sums[at][1] += weight * value;
            }
        }
    }

    /// Finds how far every node lies inside the body, negative outside: the places within reach of a particle, without those that
    /// are too near to a place without any.
    pub(super) fn close(&mut self) {
        let most = BEYOND * self.spacing;
        // Beyond the reach of all particles: by how much.
        let gap: Vec<f32> = self
            .inside
            .iter()
            .map(|square| (square.sqrt() - self.reach).min(most))
            .collect();
        let window = self.excess + most;
        let nodes = (window / self.spacing) as usize;
        let around = |middle: usize, by: usize, most: usize| {
            middle.saturating_sub(by)..(middle + by + 1).min(most)
        };
        let mut nearest = vec![window; gap.len()];
        for (at, &own) in gap.iter().enumerate().filter(|(_, gap)| **gap >= 0.0) {
            let (row, column) = (at / self.columns, at % self.columns);
            let beside = |by| (around(row, by, self.rows), around(column, by, self.columns));
            let (rows, columns) = beside(1);
            let mut neighbours = rows.flat_map(|row| columns.clone().map(move |c| (row, c)));
            if !neighbours.any(|(row, column)| gap[row * self.columns + column] < 0.0) {
                continue;
            }
            let (rows, columns) = beside(nodes);
            for other in rows {
                let off = row.abs_diff(other) as f32 * self.spacing;
                for place in columns.clone() {
                    let aside = column.abs_diff(place) as f32 * self.spacing;
                    let entry = &mut nearest[other * self.columns + place];
                    // The gap begins before its node, by as much as the node lies in it.
                    *entry = entry.min((off * off + aside * aside).sqrt() - own);
                }
            }
        }
        for ((inside, gap), nearest) in self.inside.iter_mut().zip(gap).zip(nearest) {
            *inside = if gap < 0.0 { nearest } else { -gap } - self.excess;
        }
    }

    /// A line across the picture at a height.
    pub(super) fn line(&self, y: f32) -> Line {
        let (row, part) = split(y / self.spacing, self.rows);
        let nodes = |row: usize| row * self.columns..(row + 1) * self.columns;
        let (above, below) = (nodes(row), nodes(row + 1));
        let mixed = |above: f32, below: f32| above + part * (below - above);
        let insides = self.inside[above.clone()]
            .iter()
            .zip(&self.inside[below.clone()]);
        let sums = self.sums[above].iter().zip(&self.sums[below]);
        Line {
            spacing: self.spacing,
            nodes: insides
                .zip(sums)
                .map(|((a, b), (c, d))| [mixed(*a, *b), mixed(c[0], d[0]), mixed(c[1], d[1])])
                .collect(),
        }
    }
}

/// The node before a place and the part of the way to the next one.
fn split(place: f32, nodes: usize) -> (usize, f32) {
    let node = (place as usize).min(nodes - 2);
    (node, place - node as f32)
}

/// A line across a picture: inside, weight and weighted value at every node.
pub(super) struct Line {
    spacing: f32,
    nodes: Vec<[f32; 3]>,
}

impl Line {
    /// How far a place lies inside the body, and the value there.
    #[inline]
    pub(super) fn at(&self, x: f32) -> [f32; 2] {
        let (node, part) = split(x / self.spacing, self.nodes.len());
        let (before, after) = (self.nodes[node], self.nodes[node + 1]);
        let mixed = |i: usize| before[i] + part * (after[i] - before[i]);
        let (inside, weight) = (mixed(0), mixed(1));
        let value = if weight > 0.0 { mixed(2) / weight } else { 0.0 };
        [inside, value]
    }
}
