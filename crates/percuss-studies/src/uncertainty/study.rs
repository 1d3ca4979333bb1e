//! A case with what is uncertain in it.

use std::path::Path;

use crate::{
    Error, Scenario,
    case::{self, Case, Document, ScenarioChange, Template},
    check::{Check, Diagnostic},
    summary::ResultNumber,
    sweep::{Axis, Copula, MAX_DIMENSIONS, check_values},
};

/// Fewest and most runs of a sample.
pub const MIN_SAMPLES: u64 = 16;
/// Most runs of a sample.
pub const MAX_SAMPLES: u64 = 1 << 20;

const EXAMPLE: &str = "add [[uncertainty.parameter]] with key = \"projectile.impact_velocity\" and \
                       normal = { mean = \"230 m/s\", standard_deviation = \"3 m/s\" }, and one for every other number that is uncertain";

/// A case that was read and checked, with the distributions of its uncertain numbers.
pub struct Study {
    /// The case as it stands.
    pub scenario: Scenario,
    /// Its uncertain numbers.
    pub axes: Vec<Axis>,
    pub(super) copula: Option<Copula>,
    pub(super) template: Template,
}

/// What is to be computed of a study.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Runs that the statistics rest on: [`MIN_SAMPLES`] to [`MAX_SAMPLES`]; a power of two serves best.
    pub samples: u64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// What to look at; the main quantities that the model gives when empty.
    pub quantities: Vec<&'static ResultNumber>,
    /// Whether to estimate Sobol' indices.
    pub indices: bool,
    /// Impact velocities of the bands [m/s], rising.
    pub velocities: Vec<f64>,
}

impl Study {
    /// Reads a case file with a table `uncertainty`.
    ///
    /// # Errors
    /// [`Error::Read`] and [`Error::Input`]: the case has to be valid, and every value that the table writes down possible.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::of(&Document::read(path)?)
    }

    /// Reads a case with a table `uncertainty`.
    ///
    /// # Errors
    /// [`Error::Input`], as [`Study::load`].
    pub fn of(document: &Document) -> Result<Self, Error> {
        let template = Template::of(document)?;
        let case: Case = document.parse()?;
        let Some(inputs) = case.uncertainty else {
            let diagnostic = Diagnostic::whole("the case has no uncertain parameters", EXAMPLE);
            return Err(document.place(diagnostic).into());
        };
        let mut diagnostics = Vec::new();
        let mut check = Check::new(&mut diagnostics);
        let mut check = check.within("uncertainty");
        let (axes, copula) = inputs.resolve(&mut check);
        if axes.len() > MAX_DIMENSIONS {
            check.fail(
                "parameter",
                format!(
                    "{} parameters are more than there are Sobol' points for",
                    axes.len()
                ),
                format!("give {MAX_DIMENSIONS} at most: those that matter"),
            );
        }
        check_values(&axes, &template, &mut check);
        document.report(diagnostics)?;
        Ok(Self {
            scenario: case::scenario(document)?,
            axes,
            copula,
            template,
        })
    }

    /// The same with a change of the case of every run.
    #[must_use]
    pub fn with_change(self, change: ScenarioChange) -> Self {
        Self {
            scenario: (change.change)(self.scenario),
            template: self.template.with_change(change),
            ..self
        }
    }

    /// Whether its parameters depend on each other.
    pub fn is_correlated(&self) -> bool {
        self.copula.is_some()
    }

    /// The case with every uncertain number at its median: the middle of its distribution.
    pub fn medians(&self) -> Vec<f64> {
        self.axes.iter().map(|axis| axis.at(0.5)).collect()
    }
}

impl std::fmt::Debug for Study {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Study")
            .field("case", &self.scenario.name)
            .field("axes", &self.axes)
            .finish_non_exhaustive()
    }
}
