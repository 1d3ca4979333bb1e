//! Models: what every one of them offers, and the list of all.

mod choice;

use crate::{
    Error, Scenario,
    analytic::{
        AwerbuchBodner, CraterEnergy, Forrestal, ForrestalConcrete, Hydrodynamic, InputLimit,
        LambertJonas, LanzOdermatt, PlateCavity, Plugging, Poncelet, QuasiStatic, RechtIpson, Tate,
        Taylor, WalkerAnderson, WilkinsGuinan,
    },
    axi::Axi,
    chain::Chain,
    error::nearest,
    fdm::Fdm,
    guard::{Guard, Verdict},
    judge,
    outcome::{Outcome, RunResult},
    regime::Regime,
};

pub use choice::{ChosenModel, DEFAULT_MODEL, choose, default_model};

pub use crate::control::{Checkpoints, Control, OnFrame, Progress};

/// A way to compute what becomes of a shot.
pub trait Model: Sync {
    /// Name on the command line and in results.
    fn name(&self) -> &'static str;

    /// One line that says what it is.
    fn summary(&self) -> &'static str;

    /// The regime that it is made for.
    fn guard(&self) -> &'static Guard;

    /// Whether a run takes minutes: comparisons and validations then run it only when it is asked for by name.
    fn is_slow(&self) -> bool {
        false
    }

    /// Whether it computes fields in two dimensions, which [`Control::frames`] gets, and can go on from a checkpoint.
    fn has_fields(&self) -> bool {
        false
    }

    /// Why the model does not apply to a case that its guard lets pass, if it does not: an option or a number is missing.
    fn not_applicable(&self, _: &Scenario) -> Option<String> {
        None
    }

    /// Ballistic limit that a model of residual velocity starts from, where the case has one; `None` for a model that needs none.
    fn input_limit(&self, _: &Scenario) -> Option<InputLimit> {
        None
    }

    /// Computes a case to which the model applies.
    ///
    /// # Errors
    /// [`Error::Numerical`] when the solution fails or its books do not balance; [`Error::Cancelled`].
    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error>;

    /// Adds to a result what its own choices are worth, for people; a model without choices has nothing to add.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    fn explain(
        &self,
        _scenario: &Scenario,
        _result: &mut RunResult,
        _control: &mut Control<'_>,
    ) -> Result<(), Error> {
        Ok(())
    }
}

/// All models. Adding one is one file and one line here.
pub static MODELS: &[&dyn Model] = &[
    &Chain,
    &Fdm,
    &Axi,
    &Tate,
    &WalkerAnderson,
    &LanzOdermatt,
    &Hydrodynamic,
    &Forrestal,
    &ForrestalConcrete,
    &QuasiStatic,
    &Poncelet,
    &CraterEnergy,
    &Taylor,
    &WilkinsGuinan,
    &PlateCavity,
    &Plugging,
    &RechtIpson,
    &LambertJonas,
    &AwerbuchBodner,
];

/// The models that answer at once: what comparisons and validations run unless models are named.
pub fn quick() -> Vec<&'static dyn Model> {
    MODELS
        .iter()
        .copied()
        .filter(|model| !model.is_slow())
        .collect()
}

/// The model with this name.
///
/// # Errors
/// [`Error::UnknownModel`].
pub fn model(name: &str) -> Result<&'static dyn Model, Error> {
    MODELS
        .iter()
        .find(|model| model.name() == name)
        .copied()
        .ok_or_else(|| Error::UnknownModel {
            name: name.to_owned(),
            suggestion: nearest(name, MODELS.iter().map(|model| model.name())),
            known: MODELS.iter().map(|model| model.name()).collect(),
        })
}

/// Computes a case by a model.
///
/// # Errors
/// [`Error::NotApplicable`] when the model does not apply; otherwise those of [`Model::run`].
pub fn run(
    model: &dyn Model,
    scenario: &Scenario,
    control: &mut Control<'_>,
) -> Result<RunResult, Error> {
    run_in(model, scenario, &Regime::of(scenario), control)
}

/// Computes a case by a model, with what its own choices are worth: which target resistance model is in force if it is not the usual one,
/// and the range of the result over its numerical constants. It may take a few runs of a quick model.
///
/// # Errors
/// As [`run`].
pub fn run_explained(
    model: &dyn Model,
    scenario: &Scenario,
    control: &mut Control<'_>,
) -> Result<RunResult, Error> {
    let mut result = run(model, scenario, control)?;
    model.explain(scenario, &mut result, control)?;
    Ok(result)
}

/// Computes a case whose regime is known already.
pub(crate) fn run_in(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
    control: &mut Control<'_>,
) -> Result<RunResult, Error> {
    let warnings =
        applicability_in(model, scenario, regime).map_err(|reason| refusal(model, reason))?;
    let result = model.run(scenario, control)?;
    complete(model, scenario, regime, warnings, result)
}

fn refusal(model: &dyn Model, reason: String) -> Error {
    Error::NotApplicable {
        model: model.name(),
        reason,
    }
}

/// What [`run_in`] makes of the model's own result, for a case to which the model applies with some warnings.
pub(crate) fn complete(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
    warnings: Vec<String>,
    mut result: RunResult,
) -> Result<RunResult, Error> {
    if let Some(depth) = result.depth_of_penetration
        && let Some(reason) = model.guard().depth_at_back_face(scenario, depth)
    {
        return Err(refusal(model, reason));
    }
    result.warnings.splice(0..0, warnings);
    // The benchmark has no law of the caller's own, and a crater that reached the rear face has the depth of the plate.
    let is_depth_of_crater =
        result.depth_of_penetration.is_some() && result.outcome != Outcome::Perforated;
    if is_depth_of_crater && scenario.resistance.is_none() {
        result.expected_error = judge::expectation(model, scenario, regime);
    }
    Ok(result)
}

/// Whether a model applies to a case: the warnings of its guard, or the reason why not.
///
/// # Errors
/// The reason in words.
pub fn applicability(model: &dyn Model, scenario: &Scenario) -> Result<Vec<String>, String> {
    applicability_in(model, scenario, &Regime::of(scenario))
}

pub(crate) fn applicability_in(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
) -> Result<Vec<String>, String> {
    match model.guard().verdict(scenario, regime) {
        Verdict::Outside(reason) => Err(reason),
        Verdict::Inside(warnings) => match model.not_applicable(scenario) {
            Some(reason) => Err(reason),
            None => Ok(warnings),
        },
    }
}
