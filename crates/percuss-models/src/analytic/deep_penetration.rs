//! Input and result that the models of deep penetration have in common.

use crate::{
    Refusal,
    material::Material,
    outcome::{Outcome, RunResult, Termination},
    scenario::{Rod, Scenario},
};

use super::rigid_motion::Stop;

/// A projectile on a target of one material.
#[derive(Debug, Clone, Copy)]
pub(super) struct DeepPenetration<'a> {
    pub(super) rod: &'a Rod,
    pub(super) speed: f64,
    pub(super) target: &'a Material,
}

impl<'a> DeepPenetration<'a> {
    /// `None` when the target is not of one material.
    pub(super) fn of(scenario: &'a Scenario) -> Option<Self> {
        let plate = scenario.only_layer()?;
        Some(Self {
            rod: &scenario.projectile,
            speed: scenario.impact_velocity,
            target: &plate.material,
        })
    }
}

/// Why a case has no one material to resist.
pub(super) const NOT_ONE_TARGET: &str = "it takes one layer of target";
/// Why a target has no resistance.
pub(super) const NEVER_YIELDS: &str = "the target's material never yields";

/// The refusal of a target that never yields; `key` stands for its resistance.
pub(super) fn never_yields(key: Option<&str>) -> Refusal {
    let law = "give it another strength law";
    Refusal::new(NEVER_YIELDS).with_remedy(match key {
        Some(key) => format!("{law}, or give {key}"),
        None => law.to_owned(),
    })
}

/// The result of a rigid projectile that stops in its target.
pub(super) fn at_rest(
    model: &'static str,
    scheme: &'static str,
    scenario: &Scenario,
    stop: Stop,
) -> RunResult {
    let mut result = RunResult::new(model, scheme, Outcome::AtRest, termination(scenario));
    result.depth_of_penetration = Some(stop.depth);
    result.residual_velocity = Some(0.0);
    result.projectile_final_length = Some(scenario.projectile.length);
    result.projectile_final_diameter = Some(scenario.projectile.diameter);
    result.projectile_final_mass = Some(scenario.projectile.mass);
    result.time_to_rest = stop.time;
    result.end_time = stop.time;
    result.peak_force = Some(if scenario.impact_velocity > 0.0 {
        stop.peak_force
    } else {
        0.0
    });
    result
}

/// Why a formula ends.
pub(super) fn termination(scenario: &Scenario) -> Termination {
    if scenario.impact_velocity > 0.0 {
        Termination::ClosedForm
    } else {
        Termination::NothingMoves
    }
}
