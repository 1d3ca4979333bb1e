//! Propagation of uncertain inputs: statistics, sensitivities, probability of perforation.
//!
//! A [`Study`] is a case with its table `uncertainty`; [`analyse`] computes it by a [`Kernel`](crate::sweep::Kernel). The spread
//! that it finds is that of the inputs alone: the error of the model itself is not in it.

mod analyse;
mod axisymmetric;
mod bands;
mod design;
mod indices;
mod perforation;
mod quantity;
mod result;
mod runner;
mod statistics;
mod study;
#[cfg(test)]
mod tests;
mod tornado;

pub use analyse::{analyse, runs};
pub use axisymmetric::{
    AxisymmetricPoint, AxisymmetricSpread, FEWEST_POINTS, MOST_POINTS, correct,
};
pub use indices::{Index, SobolIndices};
pub use perforation::Perforation;
pub use quantity::{quantities, quantity};
pub use result::{
    Band, Draw, Failures, Input, Nominal, QuantityResult, QuantitySpread, TornadoBar, Uncertainty,
};
pub use statistics::{Estimate, PERCENTS, Percentile, Statistics};
pub use study::{MAX_SAMPLES, MIN_SAMPLES, Settings, Study};

pub use crate::sweep::Observer;
