//! Quadratic B-splines: how a particle and the nodes around it see each other.

use crate::lanes::{LANES, Lanes, each_of, lanes, one};

/// The nodes that a particle reaches along one direction, with their weights.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stencil {
    /// Index of the first of three nodes.
    pub(super) first: isize,
    /// Weights of the three.
    pub(super) weights: [f64; 3],
    /// From the particle to the first node, in cells.
    pub(super) offset: f64,
    /// Weights times the distances from the particle to the three, in cells.
    pub(super) arms: [f64; 3],
}

impl Stencil {
    /// Stencil of a particle at a place counted in cells.
    #[inline(always)]
    pub(super) fn at(place: f64) -> Self {
        let (middle, index) = nearest(place);
        let from_first = place - (middle - 1.0);
        let (a, b, c) = (1.5 - from_first, from_first - 1.0, from_first - 0.5);
        let weights = [0.5 * a * a, 0.75 - b * b, 0.5 * c * c];
        let offset = -from_first;
        let arm = |node: usize| weights[node] * (offset + node as f64);
        Self {
            first: index - 1,
            weights,
            offset,
            arms: [arm(0), arm(1), arm(2)],
        }
    }
}

/// Stencils of the particles of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stencils {
    first: [isize; LANES],
    weights: [Lanes; 3],
    pub(super) offset: Lanes,
    arms: [Lanes; 3],
}

impl Stencils {
    /// Stencils of particles at places counted in cells.
    #[inline(always)]
    pub(super) fn at(place: &Lanes) -> Self {
        let mut first = [0; LANES];
        for (first, place) in first.iter_mut().zip(&**place) {
            *first = Stencil::at(*place).first;
        }
        Self {
            first,
            weights: each_of(|l| Stencil::at(place[l]).weights),
            offset: lanes(|l| Stencil::at(place[l]).offset),
            arms: each_of(|l| Stencil::at(place[l]).arms),
        }
    }

    /// That of one particle.
    #[inline(always)]
    pub(super) fn of(&self, lane: usize) -> Stencil {
        Stencil {
            first: self.first[lane],
            weights: one(&self.weights, lane),
            offset: self.offset[lane],
            arms: one(&self.arms, lane),
        }
    }
}

/// The whole number nearest to `x`, of magnitude below 2⁵¹, as both kinds of number. Unlike `f64::round` and a conversion it is a sum,
/// on any processor.
#[inline(always)]
pub(super) fn nearest(x: f64) -> (f64, isize) {
    // The last place of numbers of this size is 1.
    const LARGE: f64 = 1.5 * (1_u64 << 52) as f64;
    let shifted = x + LARGE;
    let index = shifted.to_bits().wrapping_sub(LARGE.to_bits()) as isize;
    (shifted - LARGE, index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_whole_number_is_that_of_the_standard_library() {
        for x in [
            -3.0, -2.5, -1.5, -1.2, -1e-300, -0.0, 0.0, 1e-300, 0.5, 1.0, 1.5, 2.999, 1e9,
        ] {
            let exact = f64::round_ties_even(x);
            assert_eq!(nearest(x), (exact, exact as isize), "{x}");
        }
    }

    #[test]
    fn the_weights_reproduce_constant_and_linear_fields_and_the_second_moment_is_a_quarter() {
        for place in [-0.9, 0.0, 0.25, 0.5, 0.99, 7.5, 123.456] {
            let stencil = Stencil::at(place);
            let moment = |power: i32| -> f64 {
                let distances = (0..3).map(|n| stencil.offset + n as f64);
                let weighted = distances.zip(stencil.weights);
                weighted.map(|(x, weight)| weight * x.powi(power)).sum()
            };
            assert!((moment(0) - 1.0).abs() < 1e-14);
            assert!(moment(1).abs() < 1e-13);
            assert!((moment(2) - 0.25).abs() < 1e-13);
        }
    }
}
