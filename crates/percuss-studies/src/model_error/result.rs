//! Model error to expect of a result. A run consults no benchmark: whoever shows a result adds it.

use super::{ModelErrorEstimate, estimate_error};
use crate::{Scenario, model::model, outcome::RunResult, regime::Regime};

/// Error to expect of a result's depth in the regime of its case; `None` where there is no estimate of it, or no depth. The benchmark has no law
/// of the caller's own.
pub(crate) fn expected_error(
    scenario: &Scenario,
    regime: &Regime,
    result: &RunResult,
) -> Option<ModelErrorEstimate> {
    // A depth of zero has no relative error.
    let has_depth = result.depth_of_penetration.is_some_and(|depth| depth > 0.0);
    if !has_depth || scenario.resistance.is_some() {
        return None;
    }
    estimate_error(model(result.model).ok()?, scenario, regime)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        case,
        outcome::{Outcome, Termination},
    };

    #[test]
    fn a_depth_of_zero_has_no_relative_error() {
        let text = "projectile = { material = 'copper', length = '12 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = '50 mm' }\n";
        let scenario = case::load_str("case.toml", text).unwrap();
        let regime = Regime::of(&scenario);
        let mut result = RunResult::new("chain", "", Outcome::AtRest, Termination::Quiescent);
        for (depth, has_error) in [(1e-3, true), (0.0, false)] {
            result.depth_of_penetration = Some(depth);
            let found = expected_error(&scenario, &regime, &result);
            assert_eq!(found.is_some(), has_error, "{depth} m");
        }
    }
}
