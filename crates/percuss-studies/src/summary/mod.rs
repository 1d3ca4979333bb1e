//! The result of a run as one flat record in the field's units: what `--json` prints and tables show.

mod number;
mod record;
mod seeds;
#[cfg(test)]
mod tests;

use serde::Serialize;

use crate::{
    Error,
    axisymmetric::AxisymmetricAnswer,
    chain::resistance_model_in_use,
    fragments::FragmentRecord,
    measured_curves::compare_curves,
    model_error::expected_error,
    options::TargetResistanceModel,
    outcome::{Band, BandQuantity, Outcome, RunResult},
    regime::Regime,
    scenario::Scenario,
};

pub use number::{FieldKind, InStatistics, ResultField, ResultNumber, Role};
pub use record::{RESULT_FIELDS, ResultRecord};
pub use seeds::{SeedNumber, SeedStudy};

/// The numbers of a result in the order of JSON.
pub fn result_numbers() -> impl Iterator<Item = &'static ResultNumber> + Clone {
    RESULT_FIELDS
        .iter()
        .filter_map(|field| field.number.as_ref())
}

/// The result number of this name.
pub fn result_number(name: &str) -> Option<&'static ResultNumber> {
    result_numbers().find(|number| number.name == name)
}

/// One case and the results of one or more models. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CaseResults {
    /// Name of the case.
    pub case: String,
    /// Version of the program.
    pub percuss_version: &'static str,
    /// One entry per model.
    pub results: Vec<ResultRecord>,
    /// Axisymmetric answer; null where none was asked for.
    pub axisymmetric: Option<AxisymmetricAnswer>,
    /// Means and spread over seeds of the packing; null where they were not asked for.
    pub seeds: Option<SeedStudy>,
}

impl ResultRecord {
    /// The record of a result, with the estimated error of its depth.
    pub fn new(scenario: &Scenario, result: &RunResult) -> Self {
        Self::in_regime(scenario, &Regime::of(scenario), result)
    }

    /// The record of a result of a case whose regime is known already.
    pub(crate) fn in_regime(scenario: &Scenario, regime: &Regime, result: &RunResult) -> Self {
        Self {
            model: result.model,
            scheme: result.scheme,
            model_choice: result.model_choice.clone(),
            target_resistance: target_resistance(scenario, result.model),
            target_resistance_choice: result.target_resistance_choice.clone(),
            outcome: result.outcome,
            criterion: (!result.criterion.is_empty()).then(|| result.criterion.clone()),
            termination: Some(result.termination),
            expected_error: expected_error(scenario, regime, result),
            band: result.band.clone(),
            fragments: result.fragments.iter().map(FragmentRecord::from).collect(),
            measured_curves: compare_curves(scenario, result),
            details: result.details.clone(),
            warnings: result.warnings.clone(),
            ..Self::of_numbers(scenario, Some(result))
        }
    }

    /// The record with another value and range of a main number, in the unit of its name.
    pub(crate) fn with_main_number(
        self,
        quantity: BandQuantity,
        value: Option<f64>,
        band: Option<Band>,
    ) -> Self {
        let mut record = Self { band, ..self };
        let place = match quantity {
            BandQuantity::DepthOfPenetration => &mut record.depth_of_penetration_mm,
            BandQuantity::ResidualVelocity => &mut record.residual_velocity_m_s,
            BandQuantity::BallisticLimit => &mut record.ballistic_limit_m_s,
            BandQuantity::ProjectileFinalLength => &mut record.projectile_final_length_mm,
        };
        *place = value;
        record
    }

    /// The record of a model that gave no result on a case, with the reason.
    ///
    /// [`Error::NotApplicable`] becomes [`Outcome::NotApplicable`], any other error [`Outcome::Failed`].
    pub fn without_result(scenario: &Scenario, model: &'static str, error: &Error) -> Self {
        let (outcome, reason) = match error {
            Error::NotApplicable { refusal, .. } => (Outcome::NotApplicable, refusal.to_string()),
            other => (Outcome::Failed, other.to_string()),
        };
        Self {
            model,
            target_resistance: target_resistance(scenario, model),
            outcome,
            reason: Some(reason),
            ..Self::of_numbers(scenario, None)
        }
    }
}

fn target_resistance(scenario: &Scenario, model: &str) -> Option<&'static str> {
    let resistance = resistance_model_in_use(scenario).filter(|_| model == "chain");
    resistance.map(TargetResistanceModel::name)
}

impl CaseResults {
    /// The results of a case.
    pub fn new(scenario: &Scenario, results: &[RunResult]) -> Self {
        Self {
            case: scenario.name.clone(),
            percuss_version: env!("CARGO_PKG_VERSION"),
            results: results
                .iter()
                .map(|result| ResultRecord::new(scenario, result))
                .collect(),
            axisymmetric: None,
            seeds: None,
        }
    }

    /// The results with a study over seeds.
    #[must_use]
    pub fn with_seeds(self, seeds: Option<SeedStudy>) -> Self {
        Self { seeds, ..self }
    }

    /// The results with the axisymmetric answer of the case.
    #[must_use]
    pub fn with_axisymmetric(self, axisymmetric: Option<AxisymmetricAnswer>) -> Self {
        Self {
            axisymmetric,
            ..self
        }
    }
}
