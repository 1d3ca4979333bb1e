//! Sweeps: one case with some of its numbers varied, computed in blocks.
//!
//! SweepRun i of a sweep is a pure function of the sweep file, the base case and i, and so is its row: which thread, process or
//! machine computes it, and when, makes no difference.

mod axisymmetric;
mod batch;
#[cfg(test)]
mod block_tests;
mod compute;
#[cfg(test)]
mod copula_tests;
mod file;
mod kernel;
mod load;
mod panic_guard;
mod points;
mod random;
mod sobol;
#[cfg(test)]
mod tests;
mod written_values;

use std::{
    ops::Range,
    path::{Path, PathBuf},
};

pub use axisymmetric::AxisymmetricRow;
pub use batch::BatchKernel;
pub use compute::Observer;
pub(crate) use compute::in_blocks;
pub use kernel::{Kernel, ScalarKernel, Stopped, SweepRow, SweepRun};
pub(crate) use points::Points;
pub(crate) use random::{bits, permuted, stream};
pub(crate) use sobol::MAX_DIMENSIONS;
pub(crate) use written_values::check_values;

pub use crate::inputs::{
    Axis, Correlation, Design, ListValue, Lognormal, Normal, Parameter, QuantityLiteral, Steps,
    Triangular, UncertainInputs, Uniform,
};
pub(crate) use crate::inputs::{Copula, Distribution, Values, score, values};

use crate::{
    Error,
    case::{Document, ScenarioChange, Template},
    cost,
    model::{Estimate, Model},
};

/// Runs from which the cost of a sweep is estimated.
const ESTIMATED_RUNS: u64 = 16;

/// A sweep that was read and checked.
pub struct Sweep {
    /// One line that says what it is.
    pub title: String,
    /// The case that is varied.
    pub base: PathBuf,
    /// The model that computes it.
    pub model: &'static dyn Model,
    /// The numbers that are varied.
    pub axes: Vec<Axis>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Runs in a block; the last block may have fewer.
    pub block_size: u64,
    points: Points,
    copula: Option<Copula>,
    template: Template,
    content: String,
}

impl Sweep {
    /// Reads a sweep file and the case that it names.
    ///
    /// # Errors
    /// [`Error::Read`] and [`Error::Input`]: every value that the file writes down has to be one that the case can have.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Error> {
        load::load(path.as_ref())
    }

    /// Reads a sweep from a text, with the case of another text instead of the file that it names.
    ///
    /// # Errors
    /// [`Error::Input`], as [`Sweep::load`].
    pub fn of(file: &Document, case: &Document) -> Result<Self, Error> {
        load::read(file, |_| Ok(case.clone()))
    }

    /// The same with a change of the case of every run.
    #[must_use]
    pub fn with_change(self, change: ScenarioChange) -> Self {
        Self {
            template: self.template.with_change(change),
            ..self
        }
    }

    /// Name of the case that is varied.
    pub fn case(&self) -> &str {
        self.template.name()
    }

    /// Title of the case that is varied; empty where it has none.
    pub fn case_title(&self) -> &str {
        self.template.title()
    }

    /// How its runs are chosen.
    pub fn design(&self) -> Design {
        self.points.design
    }

    /// Number of runs.
    pub fn runs(&self) -> u64 {
        self.points.runs
    }

    /// Number of blocks.
    pub fn blocks(&self) -> u64 {
        self.runs().div_ceil(self.block_size)
    }

    /// The runs of a block.
    pub fn block(&self, block: u64) -> Range<u64> {
        let start = block * self.block_size;
        start..(start + self.block_size).min(self.runs())
    }

    /// What the results rest on besides the program: sweep file, case and its material files, without comments.
    pub fn content(&self) -> [&str; 2] {
        [&self.content, &self.template.content]
    }

    /// Estimated cost of so many of its runs, from a few that are spread over all.
    pub fn estimate(&self, runs: u64) -> Estimate {
        let few = self.spread(runs.min(ESTIMATED_RUNS));
        let part = runs as f64 / few.len().max(1) as f64;
        let scenarios = few.iter().filter_map(|i| self.run(*i).scenario.ok());
        let estimates = scenarios.map(|scenario| cost::of_run(self.model, &scenario));
        estimates.sum::<Estimate>().times(part)
    }

    /// Memory of a thread that computes it [bytes], from a few runs that are spread over all.
    pub fn memory_of_thread(&self) -> f64 {
        let few = self.spread(self.runs().min(ESTIMATED_RUNS));
        let scenarios = few.iter().filter_map(|i| self.run(*i).scenario.ok());
        scenarios
            .map(|scenario| BatchKernel::memory_of_thread(self.model, &scenario))
            .fold(0.0, f64::max)
    }

    /// A run, counted from 0.
    pub fn run(&self, index: u64) -> SweepRun {
        let inputs = self.points.values(&self.axes, self.copula.as_ref(), index);
        SweepRun::new(&self.template, &self.axes, index, inputs, &[])
    }
}

impl std::fmt::Debug for Sweep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Sweep")
            .field("base", &self.base)
            .field("model", &self.model.name())
            .field("axes", &self.axes)
            .field("points", &self.points)
            .finish_non_exhaustive()
    }
}
