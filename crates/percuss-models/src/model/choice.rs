//! Default model of a run: the chain where it applies, otherwise the model that a comparison recommends.

use super::{
    Control, MODELS, Model, applicability_in, fast_models, memory, model, recommend, run_in,
};
use crate::{Error, Scenario, outcome::RunResult, quote::capitalized, regime::Regime};

/// Name of the model of a run that names none.
pub const DEFAULT_MODEL: &str = "chain";

/// Model of cases that no quick model takes: it includes what they leave out, at a cost of a second or more.
const WHOLE_IMPACT: &str = "axi";

/// Model of a run.
#[derive(Clone)]
pub struct ChosenModel {
    /// The model.
    pub model: &'static dyn Model,
    /// Why it is not [`DEFAULT_MODEL`] although the run names none; `None` otherwise.
    pub note: Option<String>,
}

impl ChosenModel {
    /// Computes a case by it; the result holds why it is this model.
    ///
    /// # Errors
    /// Those of [`super::run_explained`].
    pub fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
        let result = super::run_explained(self.model, scenario, control)?;
        Ok({
            let mut result = result;
            result.model_choice = self.note.clone();
            result
        })
    }
}

impl std::fmt::Debug for ChosenModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ChosenModel")
            .field("model", &self.model.name())
            .field("note", &self.note)
            .finish()
    }
}

/// The model with this name, or the default one for a case where none is named.
///
/// # Errors
/// [`Error::UnknownModel`]; [`Error::NoModelApplies`].
pub fn choose(name: Option<&str>, scenario: &Scenario) -> Result<ChosenModel, Error> {
    match name {
        Some(name) => Ok(ChosenModel {
            model: model(name)?,
            note: None,
        }),
        None => default_model(scenario),
    }
}

/// The model of a run that names none: [`DEFAULT_MODEL`] where it applies, otherwise the one that a comparison recommends, otherwise
/// the first quick one that gives a result, otherwise `axi` where it applies.
///
/// # Errors
/// [`Error::NoModelApplies`] with the reason of every fast model; [`Error::NotApplicable`] where the default model takes too much memory.
pub fn default_model(scenario: &Scenario) -> Result<ChosenModel, Error> {
    let chain = model(DEFAULT_MODEL)?;
    let regime = Regime::of(scenario);
    let Err(refused) = applicability_in(chain, scenario, &regime) else {
        return Ok(ChosenModel {
            model: chain,
            note: None,
        });
    };
    // A model that takes less memory is no answer to a mesh that is too fine.
    if memory::refusal(chain.estimate(scenario).memory).as_ref() == Some(&refused) {
        return Err(Error::not_applicable(chain.name(), refused));
    }
    let models = fast_models();
    let results: Vec<Result<(), String>> = models
        .iter()
        .map(|model| gives_result(*model, scenario, &regime))
        .collect();
    let given: Vec<_> = results
        .iter()
        .map(|result| match result {
            Ok(()) => Ok(()),
            Err(reason) => Err(reason.as_str()),
        })
        .collect();
    let names: Vec<&dyn Model> = models.iter().map(|model| *model as &dyn Model).collect();
    let recommended = recommend(&names, scenario, &regime, &given);
    let axisymmetric = model(WHOLE_IMPACT)?;
    let first = models.iter().zip(&given).find(|(_, given)| given.is_ok());
    let (chosen, why) = match recommended.models.first() {
        Some(choice) => (
            Some(choice.model),
            match &recommended.note {
                Some(note) => format!("a comparison recommends it: {}; {note}", choice.because),
                None => format!("a comparison recommends it: {}", choice.because),
            },
        ),
        None if first.is_none() && applicability_in(axisymmetric, scenario, &regime).is_ok() => (
            Some(WHOLE_IMPACT),
            "no quick model applies, and it computes the whole impact".to_owned(),
        ),
        None => (
            first.map(|(model, _)| model.name()),
            "no model is the first choice here, and it is the first that gives a result".to_owned(),
        ),
    };
    match chosen {
        Some(name) => Ok(ChosenModel {
            model: model(name)?,
            note: Some(format!(
                "model `{name}` instead of the default `{DEFAULT_MODEL}`, which does not apply: {refused}. {}",
                capitalized(&why)
            )),
        }),
        None => Err(Error::NoModelApplies {
            reasons: models
                .iter()
                .zip(results)
                .filter_map(|(model, result)| Some((model.name(), result.err()?)))
                .collect(),
            by_name: MODELS
                .iter()
                .filter(|model| models.iter().all(|fast| fast.name() != model.name()))
                .filter(|model| applicability_in(**model, scenario, &regime).is_ok())
                .map(|model| model.name())
                .collect(),
        }),
    }
}

/// Whether a model gives a result; one that takes a plate for semi-infinite is run to see whether its depth stands.
fn gives_result(
    model: &'static dyn Model,
    scenario: &Scenario,
    regime: &Regime,
) -> Result<(), String> {
    applicability_in(model, scenario, regime).map_err(|refusal| refusal.to_string())?;
    if model.validity().sees_back_face || scenario.target_thickness().is_none() {
        return Ok(());
    }
    match run_in(model, scenario, regime, &mut Control::default()) {
        Ok(_) => Ok(()),
        Err(Error::NotApplicable { refusal, .. }) => Err(refusal.to_string()),
        Err(error) => Err(error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        case,
        compare::{Observer, compare},
    };

    fn scenario(projectile: &str, target: &str) -> Scenario {
        let text = format!(
            "projectile = {{ material = '4340', length = '40 mm', diameter = '8 mm', impact_velocity = '400 m/s'{projectile} }}\n\
             target = {{ {target} }}"
        );
        case::load_str("case", &text).unwrap_or_else(|error| panic!("{error}"))
    }

    const OGIVE: &str = ", nose = { ogive = { crh = 3.0 } }";
    const THICK: &str = "material = 'aluminium-2024-t351', thickness = '200 mm'";

    #[test]
    fn the_chain_is_the_default_where_it_applies() {
        for target in [THICK, "rigid_wall = true"] {
            let chosen = default_model(&scenario("", target)).unwrap();
            assert_eq!((chosen.model.name(), chosen.note), (DEFAULT_MODEL, None));
        }
    }

    /// Elsewhere it is what a comparison of all models recommends.
    #[test]
    fn it_is_what_a_comparison_recommends_elsewhere() {
        let concrete = "material = 'concrete-35-forrestal', thickness = 'semi-infinite'";
        let plate = "material = 'aluminium-2024-t351', thickness = '26 mm'";
        let semi_infinite = "material = 'aluminium-2024-t351', thickness = 'semi-infinite'";
        let mut recommended = Vec::new();
        for (projectile, target) in [
            (OGIVE, THICK),
            (OGIVE, plate),
            (OGIVE, semi_infinite),
            (OGIVE, concrete),
            (", nose = 'hemisphere'", THICK),
        ] {
            let case = scenario(projectile, target);
            let chosen = default_model(&case).unwrap_or_else(|error| panic!("{target}: {error}"));
            let compared = compare(
                &fast_models(),
                None,
                &case,
                &[case.impact_velocity],
                &mut Observer::default(),
            );
            let compared = compared.unwrap();
            let results = compared.results.iter().find(|result| result.is_result());
            let first = compared.recommended[0].models.first();
            recommended.extend(first.map(|_| (projectile, target)));
            let expected = first.map_or(results.unwrap().model, |choice| choice.model);
            assert_eq!(chosen.model.name(), expected, "{projectile} on {target}");
            let note = chosen.note.unwrap();
            assert!(note.contains(&format!(
                "model `{expected}` instead of the default `chain`"
            )));
        }
        // The other four have results and no recommendation.
        assert_eq!(recommended, [(OGIVE, concrete)]);
    }

    /// A bullet of lead flattens against steel, which no quick model includes.
    #[test]
    fn what_no_quick_model_takes_is_axisymmetric() {
        let bullet = "projectile = { material = 'lead', mass = '8 g', diameter = '9 mm', impact_velocity = '350 m/s', nose = 'hemisphere' }\n\
            target = { material = '1006', thickness = '3 mm' }";
        let bullet = case::load_str("case", bullet).unwrap_or_else(|error| panic!("{error}"));
        for case in [bullet, scenario(OGIVE, "rigid_wall = true")] {
            let chosen = default_model(&case).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(chosen.model.name(), "axi");
            let note = chosen.note.unwrap();
            assert!(note.ends_with("No quick model applies, and it computes the whole impact"));
        }
    }

    #[test]
    fn where_no_model_applies_every_reason_is_given() {
        let apart = "layers = [{ material = '4340', thickness = '4 mm' }, { material = '4340', thickness = '4 mm', gap = '9 mm' }]";
        let error = default_model(&scenario(OGIVE, apart)).unwrap_err();
        let Error::NoModelApplies { reasons, by_name } = &error else {
            panic!("{error}");
        };
        assert_eq!(reasons.len(), fast_models().len());
        assert!(by_name.is_empty(), "{by_name:?}");
        assert!(
            error.to_string().contains("chain: it takes flat noses"),
            "{error}"
        );
    }
}
