//! Points that Sobol' indices are estimated from: two independent samples, and mixtures of them.

use crate::sweep::{Design, MAX_DIMENSIONS, Points};

/// Most parameters that there are points for: a point of each sample takes half of a scrambled Sobol' point.
pub(super) const MAX_PARAMETERS: usize = MAX_DIMENSIONS / 2;

/// Rows of points: of sample A, of sample B, and of A with one coordinate of B in turn [saltelli2010].
#[derive(Debug, Clone)]
pub(super) struct Rows {
    points: Points,
    dimensions: usize,
}

impl Rows {
    pub(super) fn new(samples: u64, seed: u64, dimensions: usize) -> Self {
        // The first half of the coordinates is the same without the second half.
        let all = (2 * dimensions).min(MAX_DIMENSIONS);
        Self {
            points: Points::new(Design::Sobol, samples, seed, all),
            dimensions,
        }
    }

    /// A point of sample A.
    pub(super) fn first(&self, row: u64) -> Vec<f64> {
        let mut point = self.points.unit(row);
        point.truncate(self.dimensions);
        point
    }

    /// Points of a row besides that of A.
    pub(super) fn others(&self) -> u64 {
        self.dimensions as u64 + 1
    }

    /// One of these points: B, and A with coordinate i of B for each i.
    pub(super) fn other(&self, row: u64, place: u64) -> Vec<f64> {
        let mut a = self.points.unit(row);
        let b = a.split_off(self.dimensions);
        match place {
            0 => b,
            _ => {
                let i = place as usize - 1;
                a[i] = b[i];
                a
            }
        }
    }
}
