//! Pieces that cracks make of a body.

use super::bonded::{At, Bonded};
use crate::fragments::Fragment;

/// A piece of a body that no bond holds to the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece<const D: usize> {
    pub(super) particles: usize,
    /// Mass [kg per m].
    pub(super) mass: f64,
    /// Momentum along the normal of the struck face [N s per m].
    pub(super) momentum: f64,
    /// Sum of the masses times the depths [kg m per m].
    moment: f64,
    /// Smallest and largest depth before the impact [m].
    pub(super) before: [f64; 2],
    /// Smallest and largest distances from the axis and depth now [m].
    now: [[f64; 2]; D],
}

impl<const D: usize> Piece<D> {
    const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];
    pub(super) const NONE: Self = Self {
        particles: 0,
        mass: 0.0,
        momentum: 0.0,
        moment: 0.0,
        before: Self::NOTHING,
        now: [Self::NOTHING; D],
    };

    pub(super) fn add<B: Bonded<D>>(&mut self, body: &B, (row, place): At) {
        let mass = body.mass_of(row, place);
        let now = body.position(row, place);
        let widen = |[low, high]: [f64; 2], at: f64| [low.min(at), high.max(at)];
        self.particles += 1;
        self.mass += mass;
        self.momentum += mass * body.velocity(row, place)[D - 1];
        self.moment += mass * now[D - 1];
        self.before = widen(self.before, body.reference(row, place)[D - 1]);
        self.now = std::array::from_fn(|axis| widen(self.now[axis], now[axis]));
    }

    /// The piece as one of the fragments of a result; its size is that of the centres of its particles and a spacing.
    pub(super) fn fragment(&self, origin: &str, spacing: f64) -> Fragment {
        let sizes = self.now.map(|[low, high]| high - low + spacing);
        let width = sizes[..D - 1].iter().copied().fold(0.0, f64::max);
        Fragment {
            origin: origin.to_owned(),
            initial_from: self.before[0],
            initial_to: self.before[1],
            mass: self.mass,
            velocity: self.momentum / self.mass,
            length: sizes[D - 1],
            diameter: width,
            position: self.moment / self.mass,
        }
    }
}

/// First particle of a piece; on the way there every second step is made shorter.
pub(super) fn root(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}
