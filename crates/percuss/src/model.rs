//! Models: what every one of them offers, and the list of all.

use std::ops::ControlFlow;

use crate::{
    Error, Scenario,
    analytic::{
        AwerbuchBodner, CraterEnergy, Forrestal, ForrestalConcrete, Hydrodynamic, LambertJonas,
        LanzOdermatt, PlateCavity, Plugging, Poncelet, QuasiStatic, RechtIpson, Tate, Taylor,
        WalkerAnderson, WilkinsGuinan,
    },
    axi::Axi,
    chain::Chain,
    error::nearest,
    fdm::Fdm,
    guard::{Guard, Verdict},
    judge,
    outcome::RunResult,
    regime::Regime,
};

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

    /// Why the model does not apply to a case that its guard lets pass, if it does not: an option or a number is missing.
    fn not_applicable(&self, _: &Scenario) -> Option<String> {
        None
    }

    /// Computes a case to which the model applies.
    ///
    /// # Errors
    /// [`Error::Numerical`] when the solution fails or its books do not balance; [`Error::Cancelled`].
    fn run(&self, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error>;
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

/// Computes a case whose regime is known already.
pub(crate) fn run_in(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
    control: &mut Control<'_>,
) -> Result<RunResult, Error> {
    let refuse = |reason: String| Error::NotApplicable {
        model: model.name(),
        reason,
    };
    let warnings = applicability_in(model, scenario, regime).map_err(refuse)?;
    let mut result = model.run(scenario, control)?;
    if let Some(depth) = result.depth_of_penetration
        && let Some(reason) = model.guard().depth_at_back_face(scenario, depth)
    {
        return Err(refuse(reason));
    }
    result.warnings.splice(0..0, warnings);
    if result.depth_of_penetration.is_some() {
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

fn applicability_in(
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

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Time step.
    pub step: u64,
    /// Time [s].
    pub time: f64,
    /// Estimated part done, 0 to 1: of a shot that ends by itself nobody knows the end beforehand.
    pub fraction: f64,
    /// Depth reached [m].
    pub depth: f64,
}

/// What a caller wants of a run: histories, progress, a way to stop it.
#[derive(Default)]
pub struct Control<'a> {
    /// Whether to keep time histories.
    pub record: bool,
    /// Called now and then; [`ControlFlow::Break`] ends the run with [`Error::Cancelled`].
    pub progress: Option<&'a mut dyn FnMut(Progress) -> ControlFlow<()>>,
}

impl Control<'_> {
    /// A run that keeps its time histories.
    pub fn recording() -> Self {
        Self {
            record: true,
            progress: None,
        }
    }

    pub(crate) fn report(&mut self, progress: Progress) -> Result<(), Error> {
        if let Some(callback) = &mut self.progress
            && callback(progress).is_break()
        {
            return Err(Error::Cancelled {
                step: progress.step,
                time_us: progress.time * 1e6,
            });
        }
        Ok(())
    }
}

impl std::fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Control")
            .field("record", &self.record)
            .finish_non_exhaustive()
    }
}
