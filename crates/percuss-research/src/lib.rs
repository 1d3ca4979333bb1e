//! Research of the project: the benchmark, the reproduction of the seed paper, the damping study and other codes, for `percuss benchmark` and
//! `percuss reproduce` only.
//!
//! [`benchmark`] compares every depth model with the axisymmetric model, [`benchmark_report`] writes the comparison; [`paper_case`] is the
//! seed paper's case by the axisymmetric model and by one-dimensional variants; [`paper`] checks the seed paper item by item, [`damping`]
//! its question about damping, and [`codes`] compares percuss with other codes. Of all this the product uses one file: the benchmark's results, for its estimate of the model error.

pub mod benchmark;
pub mod benchmark_report;
pub mod codes;
pub mod damping;
pub mod paper;
pub mod paper_case;
