//! Model error to expect of a result. A run consults no benchmark: whoever shows a result adds it.

use super::{ModelErrorEstimate, estimate_error};
use crate::{Scenario, model::model, outcome::RunResult, regime::Regime};

/// Depth in projectile diameters up to which a relative error says nothing: at a threshold of penetration it may be of any size.
const LEAST_DEPTH: f64 = 1e-3;

/// Error to expect of a result's depth in the regime of its case; `None` where there is no estimate of it, or no depth. The benchmark has no law
/// of the caller's own.
pub(crate) fn expected_error(
    scenario: &Scenario,
    regime: &Regime,
    result: &RunResult,
) -> Option<ModelErrorEstimate> {
    let least = LEAST_DEPTH * scenario.projectile.diameter;
    let has_depth = result
        .depth_of_penetration
        .is_some_and(|depth| depth > least);
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
    fn a_depth_of_nearly_zero_has_no_relative_error() {
        let text = "projectile = { material = 'copper', length = '12 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = '50 mm' }\n";
        let scenario = case::load_str("case.toml", text).unwrap();
        let regime = Regime::of(&scenario);
        let mut result = RunResult::new("chain", "", Outcome::AtRest, Termination::Quiescent);
        for (depth, has_error) in [(1e-3, true), (4e-6, false), (0.0, false)] {
            result.depth_of_penetration = Some(depth);
            let found = expected_error(&scenario, &regime, &result);
            assert_eq!(found.is_some(), has_error, "{depth} m");
        }
    }
}
