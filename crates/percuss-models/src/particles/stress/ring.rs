//! The ring of neighbours and triangles around a particle of the hexagonal lattice.
//!
//! Neighbours are counted from the one along the row to larger `x`, towards the next row. Triangle `k` is that of the neighbours `k` and `k + 1`.

use super::super::{body::Body, lattice::ROW};
use crate::lanes::{LANES, Lanes, lanes, load};

/// Neighbours of a particle inside, and its triangles.
pub(super) const RING: usize = 6;
/// All triangles of a particle are there.
pub(super) const WHOLE: u8 = (1 << RING) - 1;
/// Directions to the neighbours on the regular lattice.
pub(super) const DIRECTIONS: [[f64; 2]; RING] = [
    [1.0, 0.0],
    [0.5, ROW],
    [-0.5, ROW],
    [-1.0, 0.0],
    [-0.5, -ROW],
    [0.5, -ROW],
];
/// Number of the row of a neighbour among the row before, the own and the next one.
pub(super) const ROWS: [usize; RING] = [1, 2, 2, 1, 0, 0];

/// Places of the neighbours in their rows, for the particle at a place.
#[inline(always)]
pub(super) fn places(place: usize, odd: usize) -> [usize; RING] {
    let (right, left) = (place + odd, place + odd - 1);
    [place + 1, right, left, place - 1, left, right]
}

/// Triangles that each particle of a row has, as bits: those of which all three particles are there.
pub(super) fn triangles(body: &Body, row: usize) -> Vec<u8> {
    let count = body.rows.len();
    let is_there = |row: Option<usize>, place: usize| {
        row.is_some_and(|row| row < count && body.rows[row].mass[place] > 0.0)
    };
    let around = [row.checked_sub(1), Some(row), Some(row + 1)];
    let of = |place: usize| {
        if place == 0 || place + 1 >= body.stride || !is_there(Some(row), place) {
            return 0;
        }
        let places = places(place, row % 2);
        let there: [bool; RING] = std::array::from_fn(|k| is_there(around[ROWS[k]], places[k]));
        (0..RING)
            .filter(|&k| there[k] && there[(k + 1) % RING])
            .fold(0, |bits, k| bits | 1 << k)
    };
    (0..body.stride).map(of).collect()
}

/// Vectors to the neighbours of eight particles before the impact [m], and which of their triangles are there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    pub(super) x: [Lanes; RING],
    pub(super) z: [Lanes; RING],
    /// 1 where a triangle is there.
    pub(super) triangle: [Lanes; RING],
    /// 1 where a bond is there.
    pub(super) bond: [Lanes; RING],
}

impl Ring {
    /// Those of the particles from a place on.
    #[inline(always)]
    pub(super) fn of<const MOVED: bool>(
        body: &Body,
        masks: &[u8],
        row: usize,
        place: usize,
    ) -> Self {
        let mut ring = Self {
            x: [Lanes::all(0.0); RING],
            z: [Lanes::all(0.0); RING],
            triangle: [Lanes::all(1.0); RING],
            bond: [Lanes::all(1.0); RING],
        };
        let spacing = body.lattice.spacing;
        let last = body.rows.len() - 1;
        let around = [row.saturating_sub(1), row, (row + 1).min(last)];
        let places = places(place, row % 2);
        for k in 0..RING {
            let [x, z] = DIRECTIONS[k].map(|part| spacing * part);
            ring.x[k] = Lanes::all(x);
            ring.z[k] = Lanes::all(z);
            if MOVED {
                let (own, other) = (&body.rows[row].shift, &body.rows[around[ROWS[k]]].shift);
                let (from, to) = (load(&own[0], place), load(&other[0], places[k]));
                ring.x[k] = lanes(|l| x + (to[l] - from[l]));
                let (from, to) = (load(&own[1], place), load(&other[1], places[k]));
                ring.z[k] = lanes(|l| z + (to[l] - from[l]));
            }
        }
        let masks = &masks[place..][..LANES];
        if masks.iter().all(|&mask| mask == WHOLE) {
            return ring;
        }
        for k in 0..RING {
            let bit = |l: usize, k: usize| f64::from(masks[l] >> k & 1);
            ring.triangle[k] = lanes(|l| bit(l, k));
            ring.bond[k] = lanes(|l| bit(l, k).max(bit(l, (k + RING - 1) % RING)));
        }
        ring
    }

    /// What the displacement of a neighbour adds to the gradient of the particle, times its volume: a sixth of the edges that it is between.
    #[inline(always)]
    pub(super) fn own_edge(&self, k: usize, l: usize) -> [f64; 2] {
        let (next, before) = ((k + 1) % RING, (k + RING - 1) % RING);
        let (after, prior) = (self.triangle[k][l], self.triangle[before][l]);
        [
            (after * self.z[next][l] - prior * self.z[before][l]) / 6.0,
            (prior * self.x[before][l] - after * self.x[next][l]) / 6.0,
        ]
    }

    /// What the displacement of the particle adds to the gradient of a neighbour, times the volume of that one.
    #[inline(always)]
    pub(super) fn edge_at_neighbour(&self, k: usize, l: usize) -> [f64; 2] {
        let (next, before) = ((k + 1) % RING, (k + RING - 1) % RING);
        // Seen from the neighbour, the ring goes the other way round: what comes next here was before there.
        let (after, prior) = (self.triangle[before][l], self.triangle[k][l]);
        [
            (after * (self.z[before][l] - self.z[k][l]) - prior * (self.z[next][l] - self.z[k][l]))
                / 6.0,
            (prior * (self.x[next][l] - self.x[k][l]) - after * (self.x[before][l] - self.x[k][l]))
                / 6.0,
        ]
    }
}
