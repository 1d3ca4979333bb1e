//! Designs: which values run i has.

use super::{
    random::{bits, permuted, stream},
    sobol::Directions,
};
use crate::inputs::{Axis, Copula, Design, Values, values};

/// Most runs of a sweep.
pub(super) const MAX_RUNS: u64 = 1 << 30;
/// Bits of the place of a Latin hypercube's run in its interval: with 30 bits for the interval a 64-bit float holds both.
const PLACE_BITS: u32 = 20;

/// Purposes that random numbers are drawn for.
const ORDER: u64 = 1;
const PLACE: u64 = 2;
const SCRAMBLE: u64 = 3;

/// What it takes to make any run of a design.
#[derive(Debug, Clone)]
pub(crate) struct Points {
    pub(super) design: Design,
    pub(super) runs: u64,
    seed: u64,
    dimensions: usize,
    directions: Vec<Directions>,
}

impl Points {
    pub(crate) fn new(design: Design, runs: u64, seed: u64, dimensions: usize) -> Self {
        let directions = match design {
            Design::Sobol => (0..dimensions).map(Directions::of).collect(),
            Design::Grid | Design::LatinHypercube => Vec::new(),
        };
        Self {
            design,
            runs,
            seed,
            dimensions,
            directions,
        }
    }

    /// The values of a run, in the order of the axes.
    pub(super) fn values(&self, axes: &[Axis], copula: Option<&Copula>, run: u64) -> Vec<f64> {
        match self.design {
            Design::Grid => grid(axes, run),
            Design::LatinHypercube | Design::Sobol => values(axes, copula, &self.unit(run)),
        }
    }

    /// Coordinates of a run between 0 and 1; a grid has none.
    pub(crate) fn unit(&self, run: u64) -> Vec<f64> {
        let dimensions = 0..self.dimensions;
        match self.design {
            Design::Grid => Vec::new(),
            Design::LatinHypercube => dimensions.map(|d| self.stratified(d, run)).collect(),
            Design::Sobol => dimensions
                .map(|d| {
                    // There are fewer runs than 2^32.
                    self.directions[d].scrambled(run as u32, stream(self.seed, SCRAMBLE, d))
                })
                .collect(),
        }
    }

    /// Coordinate of a Latin hypercube's run.
    fn stratified(&self, dimension: usize, run: u64) -> f64 {
        let order = stream(self.seed, ORDER, dimension);
        let interval = permuted(order, run, self.runs);
        let place = bits(stream(self.seed, PLACE, dimension), run) >> (64 - PLACE_BITS);
        let place = (place as f64 + 0.5) / f64::from(1_u32 << PLACE_BITS);
        (interval as f64 + place) / self.runs as f64
    }
}

/// The first axis varies slowest.
fn grid(axes: &[Axis], run: u64) -> Vec<f64> {
    let mut rest = run;
    let mut values: Vec<f64> = axes
        .iter()
        .rev()
        .map(|axis| match &axis.values {
            Values::List(list) => {
                let count = list.len() as u64;
                let value = list[(rest % count) as usize];
                rest /= count;
                value
            }
            Values::Options(options) => {
                let count = options.len() as u64;
                let place = rest % count;
                rest /= count;
                place as f64
            }
            // Grids have lists only; the median would be the one value to take.
            Values::Distribution(distribution) => distribution.quantile(0.5),
        })
        .collect();
    values.reverse();
    values
}
