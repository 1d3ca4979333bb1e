//! Model error to expect of a result. A run consults no benchmark: whoever shows a result adds it.

use super::{ModelErrorEstimate, estimate_error};
use crate::{
    Scenario,
    model::model,
    outcome::{Outcome, RunResult},
    regime::Regime,
};

/// Error to expect of a result's depth in the regime of its case; `None` where there is no estimate of it. The benchmark has no law of
/// the caller's own, and a crater that reached the rear face has the depth of the plate.
pub(crate) fn expected_error(
    scenario: &Scenario,
    regime: &Regime,
    result: &RunResult,
) -> Option<ModelErrorEstimate> {
    let is_depth_of_crater =
        result.depth_of_penetration.is_some() && result.outcome != Outcome::Perforated;
    if !is_depth_of_crater || scenario.resistance.is_some() {
        return None;
    }
    estimate_error(model(result.model).ok()?, scenario, regime)
}
