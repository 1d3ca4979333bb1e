//! Model error to expect of a result. A run consults no benchmark: whoever shows a result adds it.

use super::{Expectation, expectation};
use crate::{Scenario, model::model, outcome::RunResult, regime::Regime};

/// Error to expect of a result's depth in the regime of its case; `None` where there is no depth or no estimate of its error, and with
/// a resistance law of the caller's own, which no benchmark has.
pub(crate) fn expected_error(
    scenario: &Scenario,
    regime: &Regime,
    result: &RunResult,
) -> Option<Expectation> {
    if result.depth_of_penetration.is_none() || scenario.resistance.is_some() {
        return None;
    }
    expectation(model(result.model).ok()?, scenario, regime)
}
