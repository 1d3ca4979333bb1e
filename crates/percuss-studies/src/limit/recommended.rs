//! Models to rely on for a ballistic limit.

use super::{AxisymmetricLimit, LimitOutcome, ModelLimit};
use crate::{
    Scenario, axi,
    axisymmetric::MODEL,
    compare::Choice,
    limit_choice::{comes_first, first_choice},
    model::{Model, outside},
    options::BorderShearLaw,
    outcome::BandQuantity,
    regime::Regime,
    units::significant,
    validity::Range,
};

/// Ratio of two limits from which on the axisymmetric one is named beside the recommended one: more than the errors of both on published limits
/// under blunt noses (RMS of `power_balance` 13 % on steel, `axi` 12 % high).
const CONTRADICTION: f64 = 1.3;

/// The first choices among the models that predict limits, each classified at its own limit, and what to know of them.
///
/// A first choice that predicts depths alone has not been compared with measured limits: it is named, not recommended. An axisymmetric
/// limit of targets that can fail is the first choice where no other one has an expected error, but not before a first choice under flat noses:
/// failure around a plug is the least certain part of `axi`. How far the two are apart does not matter, so that the choice stays along a series
/// of thicknesses. The last value is an axisymmetric limit that is far from the recommended one [m/s].
pub(super) fn recommended(
    models: &[&dyn Model],
    scenario: &Scenario,
    results: &[ModelLimit],
    axisymmetric: Option<&AxisymmetricLimit>,
) -> (Vec<Choice>, Option<String>, Option<f64>) {
    let (choices, note) = of_models(models, scenario, results);
    let Some(value) = of_failing_layers(scenario, axisymmetric) else {
        return (choices, note, None);
    };
    let judged = choices
        .iter()
        .any(|choice| is_judged(results, choice.model));
    if choices.is_empty() || !comes_first(scenario, judged) {
        let because = "it solves the whole impact, its mesh error is known, and no first choice has been compared with enough published limits of this kind";
        let choice = Choice {
            model: MODEL,
            because,
        };
        return (vec![choice], None, None);
    }
    let ratio = |choice: &Choice| {
        let entry = results.iter().find(|entry| entry.model == choice.model);
        Some(value / entry?.ballistic_limit_m_s?)
    };
    let mut ratios = choices.iter().filter_map(ratio);
    let Some(ratio) = ratios.find(|ratio| ratio.max(1.0 / ratio) > CONTRADICTION) else {
        return (choices, note, None);
    };
    let advice = match judged {
        true => "the error stated with it is that on published limits of its kind",
        false => "take the range of all models as the uncertainty",
    };
    let contradiction = format!(
        "the axisymmetric limit is {} times that of this model. Failure of plates is the least certain part of `axi`: {advice}",
        significant(ratio, 2)
    );
    let notes = note.into_iter().chain([contradiction]);
    (choices, Some(Vec::from_iter(notes).join("; ")), Some(value))
}

/// Axisymmetric limit of layers that can fail [m/s]: without failure a plate only stretches and thins, and the limit is too high.
pub(super) fn of_failing_layers(
    scenario: &Scenario,
    axisymmetric: Option<&AxisymmetricLimit>,
) -> Option<f64> {
    let value = axisymmetric?.ballistic_limit_m_s?;
    let can_fail = axi::layers_that_cannot_fail(scenario).is_empty();
    can_fail.then_some(value)
}

/// Limits of the models that are within their ranges of validity there, or whose error is known [m/s].
pub(super) fn within_range(
    models: &[&dyn Model],
    scenario: &Scenario,
    results: &[ModelLimit],
) -> impl Iterator<Item = f64> {
    models.iter().zip(results).filter_map(|(model, entry)| {
        let limit = entry.ballistic_limit_m_s?;
        let is_within = || {
            outside(*model, &scenario.at_impact_velocity(limit)).is_none()
                && !is_column_of_a_thin_plate(*model, scenario)
        };
        (entry.expected_error.is_some() || is_within()).then_some(limit)
    })
}

/// Whether a model is a column, which includes neither the plug nor the bending by which a thin plate fails.
fn is_column_of_a_thin_plate(model: &dyn Model, scenario: &Scenario) -> bool {
    let has_plug = scenario.options.chain.border_shear_law() == BorderShearLaw::ShearBand;
    let is_column = match model.name() {
        "chain" => !has_plug,
        name => name == "fdm",
    };
    is_column && Range::COLUMN.diagnostic(scenario).is_some()
}

/// Whether the error of a model's limit is known.
fn is_judged(results: &[ModelLimit], model: &str) -> bool {
    let mut results = results.iter().filter(|entry| entry.model == model);
    results.any(|entry| entry.expected_error.is_some())
}

/// The first choices among the models without the axisymmetric limit.
fn of_models(
    models: &[&dyn Model],
    scenario: &Scenario,
    results: &[ModelLimit],
) -> (Vec<Choice>, Option<String>) {
    let found: Vec<(&dyn Model, f64)> = models
        .iter()
        .zip(results)
        .filter_map(|(model, entry)| Some((*model, entry.ballistic_limit_m_s?)))
        .collect();
    if found.is_empty() {
        let inputs = results.iter().any(|r| r.outcome == LimitOutcome::Input);
        let note = inputs.then(|| {
            "no model predicts a limit of this case between the velocities searched".to_owned()
        });
        return (Vec::new(), note);
    }
    let choices = |of: fn(&Scenario) -> Option<Regime>| -> Vec<(&dyn Model, Choice)> {
        let fitting = found.iter().filter_map(|(model, limit)| {
            let scenario = scenario.at_impact_velocity(*limit);
            let regime = of(&scenario)?;
            let judged = is_judged(results, model.name());
            Some((*model, first_choice(*model, &scenario, &regime, judged)?))
        });
        fitting.collect()
    };
    let own = choices(|scenario| Some(Regime::of(scenario)));
    let neighbours = choices(|scenario| {
        let regime = Regime::of(scenario);
        let projectile = regime.neighbour?;
        Some(Regime {
            projectile,
            ..regime
        })
    });
    let (own, others) = by_quantity(own);
    if !own.is_empty() {
        return (own, None);
    }
    let (neighbours, _) = by_quantity(neighbours);
    if !neighbours.is_empty() {
        let note = "the projectile is at the edge of another regime, whose first choice this is";
        return (neighbours, Some(note.to_owned()));
    }
    let unproven: String = others
        .iter()
        .map(|choice| {
            format!(
                "; `{}` is the first choice for other results of this case, but its limits have not been compared with measured ones",
                choice.model
            )
        })
        .collect();
    if within_range(models, scenario, results).next().is_none() {
        let note =
            format!("no model that gives a limit is within its range of validity here{unproven}");
        return (Vec::new(), Some(note));
    }
    // Columns by two methods are one model: their agreement says nothing.
    let is_column = |name: &str| ["chain", "fdm"].contains(&name);
    let columns = found.iter().filter(|(model, _)| is_column(model.name()));
    let judged = results.iter().any(|entry| entry.expected_error.is_some());
    let error = match found.len() - columns.count().saturating_sub(1) {
        1 if judged => "rely on its estimated error",
        1 => "its error is not known",
        _ => "take the range as its uncertainty",
    };
    let note = format!(
        "no model is the first choice for the limit of this kind of case: {error}{unproven}"
    );
    (Vec::new(), Some(note))
}

/// Choices of models that predict limits, and the others.
fn by_quantity(choices: Vec<(&dyn Model, Choice)>) -> (Vec<Choice>, Vec<Choice>) {
    let (limits, others): (Vec<_>, Vec<_>) = choices.into_iter().partition(|(model, _)| {
        let predicts = model.validity().predicts;
        predicts.contains(&BandQuantity::BallisticLimit)
    });
    let only = |choices: Vec<(&dyn Model, Choice)>| choices.into_iter().map(|(_, c)| c).collect();
    (only(limits), only(others))
}
