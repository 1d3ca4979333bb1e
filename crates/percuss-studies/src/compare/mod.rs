//! Every model on one case, at one or many impact velocities, and which of them to rely on.
//!
//! ```
//! use percuss::{case, compare::{compare, Observer}, model::fast_models};
//!
//! let scenario = case::load_str("taylor", r#"
//!     projectile = { material = "copper", length = "23.47 mm", diameter = "7.62 mm", impact_velocity = "183 m/s" }
//!     target = { rigid_wall = true }
//! "#)?;
//! let comparison = compare(&fast_models(), None, &scenario, &[89.0, 183.0], &mut Observer::default())?;
//! assert_eq!(comparison.results.len(), 2 * fast_models().len());
//! assert!(comparison.has_results());
//! # Ok::<(), percuss::Error>(())
//! ```

mod jobs;
mod quantities;
#[cfg(test)]
mod tests;

use serde::Serialize;

use crate::{
    Error, Scenario,
    axisymmetric::Request,
    cost,
    model::{Model, recommend},
    outcome::{BandQuantity, Outcome},
    regime::Regime,
    scenario::Measurement,
    summary::ResultRecord,
};

pub use crate::model::{Choice, Recommendation};
pub use jobs::{Observer, Progress};

/// What every model says of a case. The names are stable; those of `percuss run --json` have the same meaning.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Name of the case.
    pub case: String,
    /// Version of the program.
    pub percuss_version: &'static str,
    /// The recognised regime, one entry per impact velocity.
    pub regime: Vec<SpeedRegime>,
    /// What to rely on, one entry per impact velocity.
    pub recommended: Vec<Recommendation>,
    /// Quantities that tell most of this case, the leading one first.
    pub quantities: Vec<BandQuantity>,
    /// What was measured.
    pub experiments: Vec<ExperimentRecord>,
    /// One entry per velocity and model: velocities in the order given, and for each the models in theirs.
    pub results: Vec<ResultRecord>,
}

/// The regime at a velocity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpeedRegime {
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// The regime.
    #[serde(flatten)]
    pub regime: Regime,
}

/// A measured value, in the unit of its quantity's name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExperimentRecord {
    /// What was measured.
    pub quantity: BandQuantity,
    /// Impact velocity [m/s]; null for a ballistic limit without one.
    pub impact_velocity_m_s: Option<f64>,
    /// The value.
    pub value: f64,
    /// How far it may be off, either way.
    pub uncertainty: Option<f64>,
    /// Bibliography keys.
    pub sources: Vec<String>,
    /// Remarks on it.
    pub note: String,
}

impl ExperimentRecord {
    /// What was measured on runs of a case.
    pub(crate) fn all(scenario: &Scenario) -> Vec<Self> {
        let record = |measured: &Measurement| Self {
            quantity: measured.quantity,
            impact_velocity_m_s: measured.impact_velocity,
            value: measured.quantity.in_unit(measured.value),
            uncertainty: measured.uncertainty.map(|u| measured.quantity.in_unit(u)),
            sources: measured.sources.clone(),
            note: measured.note.clone(),
        };
        scenario.experiments.iter().map(record).collect()
    }
}

/// Runs models on a case at each of these impact velocities [m/s], on all cores. With an `axisymmetric` request the model `axi` is the
/// first one: its main number is the limit of the meshes, and its range the discretisation uncertainty.
///
/// A model that does not apply or that fails leaves the reason in its entry and never stops the others. The order of the
/// entries does not depend on the order in which runs end.
///
/// # Errors
/// [`Error::Input`] from [`Scenario::check`] at one of the velocities; [`Error::Cancelled`] when `observer` says so.
pub fn compare(
    models: &[&dyn Model],
    axisymmetric: Option<Request>,
    scenario: &Scenario,
    velocities: &[f64],
    observer: &mut Observer<'_>,
) -> Result<Comparison, Error> {
    let all = jobs::all_of(models, axisymmetric)?;
    let models: Vec<&dyn Model> = all.iter().map(|job| job.model()).collect();
    let runs: Vec<(Scenario, Regime)> = jobs::scenarios(scenario, velocities);
    for (scenario, _) in &runs {
        scenario.check()?;
    }
    let memory = jobs::memory(&all, &runs);
    let results = cost::within_memory(memory, || jobs::run(&all, &runs, observer))?;
    let recommended = runs
        .iter()
        .zip(results.chunks(models.len().max(1)))
        .map(|((scenario, regime), results)| {
            let given: Vec<_> = results
                .iter()
                .map(|(record, doubt)| match doubt {
                    Some(doubt) => Err(doubt.as_str()),
                    None => record.given(),
                })
                .collect();
            recommend(&models, scenario, regime, &given)
        })
        .collect();
    let results: Vec<ResultRecord> = results.into_iter().map(|(record, _)| record).collect();
    Ok(Comparison {
        case: scenario.name.clone(),
        percuss_version: env!("CARGO_PKG_VERSION"),
        recommended,
        quantities: quantities::leading(scenario, &results),
        experiments: ExperimentRecord::all(scenario),
        results,
        regime: runs
            .into_iter()
            .map(|(scenario, regime)| SpeedRegime {
                impact_velocity_m_s: scenario.impact_velocity,
                regime,
            })
            .collect(),
    })
}

/// Part of an impact velocity by which a run may differ from a measured one and still be the same.
const SAME_VELOCITY: f64 = 1e-3;

fn same_velocity(measured: f64, velocity: f64) -> bool {
    (measured - velocity).abs() <= SAME_VELOCITY * velocity
}

impl Comparison {
    /// Impact velocities [m/s].
    pub fn velocities(&self) -> Vec<f64> {
        self.regime
            .iter()
            .map(|at| at.impact_velocity_m_s)
            .collect()
    }

    /// Names of the models, in their order.
    pub fn models(&self) -> Vec<&'static str> {
        let count = self.results.len() / self.regime.len().max(1);
        self.results[..count]
            .iter()
            .map(|result| result.model)
            .collect()
    }

    /// The entries of a velocity, one per model.
    pub fn at_impact_velocity(&self, index: usize) -> &[ResultRecord] {
        let count = self.results.len() / self.regime.len().max(1);
        &self.results[index * count..(index + 1) * count]
    }

    /// The entries of a model, one per velocity.
    pub fn of_model<'a>(&'a self, model: &'a str) -> impl Iterator<Item = &'a ResultRecord> {
        self.results
            .iter()
            .filter(move |result| result.model == model)
    }

    /// Whether any model gave a result at any velocity.
    pub fn has_results(&self) -> bool {
        self.results.iter().any(ResultRecord::is_result)
    }

    /// How many measurements were made at none of the velocities; a ballistic limit holds for every velocity.
    pub fn experiments_elsewhere(&self) -> usize {
        let velocities = self.velocities();
        let elsewhere = |measured: &&ExperimentRecord| {
            measured.quantity != BandQuantity::BallisticLimit
                && measured.impact_velocity_m_s.is_some_and(|at| {
                    !velocities
                        .iter()
                        .any(|velocity| same_velocity(at, *velocity))
                })
        };
        self.experiments.iter().filter(elsewhere).count()
    }

    /// Mean of what was measured of a quantity at a velocity [m/s], in the quantity's unit, and of how many values.
    ///
    /// A ballistic limit holds for every velocity.
    pub fn measured(&self, quantity: BandQuantity, velocity: f64) -> Option<(f64, usize)> {
        let values: Vec<f64> = self
            .experiments
            .iter()
            .filter(|measured| measured.quantity == quantity)
            .filter(|measured| match measured.impact_velocity_m_s {
                _ if quantity == BandQuantity::BallisticLimit => true,
                Some(at) => same_velocity(at, velocity),
                None => false,
            })
            .map(|measured| measured.value)
            .collect();
        (!values.is_empty()).then(|| {
            (
                values.iter().sum::<f64>() / values.len() as f64,
                values.len(),
            )
        })
    }
}

impl ResultRecord {
    /// Whether the model gave a result.
    pub fn is_result(&self) -> bool {
        !matches!(self.outcome, Outcome::NotApplicable | Outcome::Failed)
    }

    /// Whether it is a result, and why if it is none.
    fn given(&self) -> Result<(), &str> {
        match self.is_result() {
            true => Ok(()),
            false => Err(self.reason.as_deref().unwrap_or_default()),
        }
    }

    /// One of the main numbers, in the unit of the quantity's name.
    pub fn value(&self, quantity: BandQuantity) -> Option<f64> {
        match quantity {
            BandQuantity::DepthOfPenetration => self.depth_of_penetration_mm,
            BandQuantity::ResidualVelocity => self.residual_velocity_m_s,
            BandQuantity::BallisticLimit => self.ballistic_limit_m_s,
            BandQuantity::ProjectileFinalLength => self.projectile_final_length_mm,
        }
    }
}
