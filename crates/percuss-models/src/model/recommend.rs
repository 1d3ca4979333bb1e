//! Recommended result among the models that gave one.

use serde::Serialize;

use crate::{
    Scenario,
    problem::Nose,
    regime::{ProjectileRegime, Regime},
    solver::Model,
};

/// What to rely on at a speed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Recommendation {
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// The models that are the first choice for this kind of case and gave a result; may be empty.
    pub models: Vec<Choice>,
    /// Remarks on the choice, if there is something.
    pub note: Option<String>,
}

/// A model and why it is recommended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Choice {
    /// Its name.
    pub model: &'static str,
    /// Why.
    pub because: &'static str,
}

impl Choice {
    /// The choice of a model for a case of a regime, if it is a first choice there.
    pub fn of(model: &dyn Model, scenario: &Scenario, regime: &Regime) -> Option<Self> {
        let mut choices = model.validity_for(scenario).first_choice.iter();
        let fitting = choices.find(|choice| choice.fits(scenario, regime))?;
        Some(Self {
            model: model.name(),
            because: fitting.because,
        })
    }

    /// [`Self::of`] where the case is in all ranges of the model.
    pub fn within(model: &dyn Model, scenario: &Scenario, regime: &Regime) -> Option<Self> {
        let choice = Self::of(model, scenario, regime);
        choice.filter(|_| outside(model, scenario).is_none())
    }
}

/// The range of a model that a case is outside of, in words.
pub fn outside(model: &dyn Model, scenario: &Scenario) -> Option<String> {
    let mut ranges = model.validity_for(scenario).ranges.iter();
    ranges.find_map(|range| range.diagnostic(scenario))
}

/// Whether a model gives a result, and why if it does not.
pub(super) type Given<'a> = Result<(), &'a str>;

/// First choices for a regime: those that gave a result within their ranges of validity, and the others with the reason why not. A model outside
/// its own range is not recommended, even where there is no other.
struct FirstChoices {
    given: Vec<Choice>,
    missed: Vec<(&'static str, String)>,
}

impl FirstChoices {
    fn of(
        models: &[&dyn Model],
        scenario: &Scenario,
        regime: &Regime,
        results: &[Given<'_>],
    ) -> Self {
        let mut choices = Self {
            given: Vec::new(),
            missed: Vec::new(),
        };
        for (model, result) in models.iter().zip(results) {
            let Some(choice) = Choice::of(*model, scenario, regime) else {
                continue;
            };
            match (result, outside(*model, scenario)) {
                (Ok(()), None) => choices.given.push(choice),
                (Ok(()), Some(reason)) => choices.missed.push((choice.model, reason)),
                (Err(reason), _) => choices.missed.push((choice.model, (*reason).to_owned())),
            }
        }
        choices
    }
}

/// What to rely on for a case in its regime, given what every model said.
pub fn recommend(
    models: &[&dyn Model],
    scenario: &Scenario,
    regime: &Regime,
    results: &[Given<'_>],
) -> Recommendation {
    let own = FirstChoices::of(models, scenario, regime, results);
    let neighbour: Option<(ProjectileRegime, Vec<Choice>)> = regime.neighbour.map(|neighbour| {
        let regime = Regime {
            projectile: neighbour,
            ..regime.clone()
        };
        let mut choices = FirstChoices::of(models, scenario, &regime, results).given;
        choices.retain(|choice| own.given.iter().all(|own| own.model != choice.model));
        (neighbour, choices)
    });
    // Behind a flat face a rigid rod goes much deeper than one that erodes: its model is no stand-in, only one to compare with.
    let erodes = regime.projectile == ProjectileRegime::Eroding;
    let is_stand_in = !own.given.is_empty() || !erodes || scenario.projectile.nose != Nose::Flat;
    let neighbour = neighbour.filter(|(kind, choices)| {
        !choices.is_empty() && (is_stand_in || *kind != ProjectileRegime::Rigid)
    });
    let mut notes: Vec<String> = own
        .missed
        .iter()
        .map(|(model, reason)| format!("`{model}` would be a first choice, but {reason}"))
        .collect();
    let models = match (own.given.is_empty(), neighbour) {
        (false, None) => own.given,
        (false, Some((kind, choices))) => {
            notes.push(format!(
                "the projectile may also be {}, for which {} is the first choice: compare both",
                kind.describe(),
                names(&choices)
            ));
            own.given
        }
        (true, Some((kind, choices))) => {
            notes.push(format!(
                "no first choice for {} projectiles gives a result within its range here; the projectile may also be {}",
                regime.projectile.describe(),
                kind.describe()
            ));
            choices
        }
        (true, None) => {
            notes.push(
                match results.iter().filter(|result| result.is_ok()).count() {
                    0 => "no model gives a result",
                    1 => "none of the models is the first choice for this kind of case; one gives a result",
                    _ => {
                        "none of the models is the first choice for this kind of case: take the spread of those that give a result for \
                          the uncertainty"
                    }
                }
                .to_owned(),
            );
            Vec::new()
        }
    };
    Recommendation {
        impact_velocity_m_s: scenario.impact_velocity,
        models,
        note: (!notes.is_empty()).then(|| notes.join("; ")),
    }
}

fn names(choices: &[Choice]) -> String {
    let names: Vec<String> = choices
        .iter()
        .map(|choice| format!("`{}`", choice.model))
        .collect();
    names.join(" or ")
}
