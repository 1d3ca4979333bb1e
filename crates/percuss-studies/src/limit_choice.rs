//! Which ballistic limit comes first: that of a model, or the axisymmetric one.

use crate::{
    Scenario, chain,
    limit_error::expected_error,
    model::{self, Choice, Control, Model, fast_models},
    outcome::{BandQuantity, Outcome, RunResult},
    problem::RearFaceCondition,
    regime::Regime,
    scenario::TargetBody,
    validity::NoseKind,
};

/// A model as first choice for a case of a regime; outside its ranges only where the error of its limit is known.
pub(crate) fn first_choice(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
    is_judged: bool,
) -> Option<Choice> {
    match is_judged {
        true => Choice::of(model, scenario, regime),
        false => Choice::within(model, scenario, regime),
    }
}

/// Whether the limit of a first choice comes before the axisymmetric one: its error is known, or the nose is flat. Failure around a plug is the
/// least certain part of `axi`.
pub(crate) fn comes_first(scenario: &Scenario, is_judged: bool) -> bool {
    is_judged || NoseKind::of(scenario.projectile.nose) == NoseKind::Flat
}

/// What the first choices for limits that come before the axisymmetric one say of an impact on a plate with a free rear face: name of each and
/// its result.
fn results_before_axisymmetric(
    scenario: &Scenario,
) -> impl Iterator<Item = (&'static str, RunResult)> {
    let is_free = scenario.rear_face() == Some(RearFaceCondition::Free);
    let models = is_free.then(fast_models).unwrap_or_default();
    let regime = Regime::of(scenario);
    models.into_iter().filter_map(move |model| {
        if !model
            .validity()
            .predicts
            .contains(&BandQuantity::BallisticLimit)
        {
            return None;
        }
        Choice::of(model, scenario, &regime)?;
        let found = model::run(model, scenario, &mut Control::default()).ok()?;
        let is_judged = expected_error(model, scenario, scenario.impact_velocity).is_some();
        let choice = first_choice(model, scenario, &regime, is_judged)?;
        comes_first(scenario, is_judged).then_some((choice.model, found))
    })
}

/// A first choice for limits that comes before the axisymmetric one and sees another outcome of an impact: its name and its outcome.
pub(crate) fn another_outcome(
    scenario: &Scenario,
    outcome: Outcome,
) -> Option<(&'static str, Outcome)> {
    let is_open = |outcome| matches!(outcome, Outcome::OutOfTime | Outcome::Failed);
    if is_open(outcome) {
        return None;
    }
    results_before_axisymmetric(scenario)
        .map(|(model, found)| (model, found.outcome))
        .find(|(_, found)| {
            let differs = (*found == Outcome::Perforated) != (outcome == Outcome::Perforated);
            differs && !is_open(*found)
        })
}

/// A first choice for limits that comes before the axisymmetric one and perforates the plate: its name and its residual velocity [m/s].
pub(crate) fn another_residual_velocity(scenario: &Scenario) -> Option<(&'static str, f64)> {
    results_before_axisymmetric(scenario)
        .filter(|(_, found)| found.outcome == Outcome::Perforated)
        .find_map(|(model, found)| Some((model, found.residual_velocity?)))
}

/// The case as its ballistic limit is asked for: the rear face of a plate is free unless the case gives another one. `None`
/// where nothing changes.
pub fn with_free_rear_face(scenario: &Scenario) -> Option<Scenario> {
    let mut free = scenario.clone();
    let TargetBody::Layers {
        layers, back_face, ..
    } = &mut free.target
    else {
        return None;
    };
    if scenario.given.rear_face || layers.last()?.thickness.is_none() {
        return None;
    }
    *back_face = RearFaceCondition::Free;
    chain::choose_target_resistance(&mut free);
    Some(free)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case;

    /// The limit that comes first decides on which side an impact lies: the other outcome is named, if it is certain.
    #[test]
    fn an_outcome_on_the_other_side_of_the_limit_to_use_is_named() {
        let of = |velocity: f64, nose: &str, face: &str| {
            let text = format!(
                "projectile = {{ material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '{velocity} m/s', nose = {nose} }}\n\
                 target = {{ material = 'weldox-460-e', thickness = '12 mm', back_face = '{face}' }}"
            );
            case::load_str("blunt", &text).unwrap()
        };
        let flat =
            |velocity: f64, outcome| another_outcome(&of(velocity, "'flat'", "free"), outcome);
        let by_plug = |outcome| Some(("power_balance", outcome));
        assert_eq!(
            flat(250.0, Outcome::Rebounded),
            by_plug(Outcome::Perforated)
        );
        assert_eq!(flat(150.0, Outcome::Perforated), by_plug(Outcome::AtRest));
        assert_eq!(flat(250.0, Outcome::Perforated), None);
        assert_eq!(flat(150.0, Outcome::Rebounded), None);
        assert_eq!(flat(250.0, Outcome::OutOfTime), None);
        let held = of(250.0, "'flat'", "fixed");
        assert_eq!(another_outcome(&held, Outcome::Rebounded), None);
        let (model, velocity) = another_residual_velocity(&of(250.0, "'flat'", "free")).unwrap();
        assert!(model == "power_balance" && velocity > 0.0 && velocity < 250.0);
        assert_eq!(
            another_residual_velocity(&of(150.0, "'flat'", "free")),
            None
        );
        assert_eq!(another_residual_velocity(&held), None);
        // Too few limits of sharp noses on steel are published for one to come before `axi`; of cores on aluminium there are enough.
        let cone = of(200.0, "{ cone = { length_to_diameter = 1.7 } }", "free");
        assert_eq!(another_outcome(&cone, Outcome::Perforated), None);
        let core = "projectile = { material = 'apm2-core', mass = '5.25 g', diameter = '6.17 mm', impact_velocity = '580 m/s', nose = { ogive = { crh = 3.0 } } }\n\
             target = { material = '6061-t6', thickness = '26 mm', back_face = 'free' }";
        let core = case::load_str("core", core).unwrap();
        let by_hole = another_outcome(&core, Outcome::Perforated);
        assert_eq!(by_hole, Some(("plate_cavity", Outcome::AtRest)));
    }
}
