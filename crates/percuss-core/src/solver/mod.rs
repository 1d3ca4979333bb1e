//! Model interface: what every model offers, how a run of one is started, watched, interrupted and resumed.

pub mod archive;
pub mod checkpoint;
mod control;
mod courant_retry;
pub mod driver;
pub mod estimate;
pub mod frames;
pub mod gauge;
mod input_limit;
pub mod interface;
pub mod limits;
pub mod memory;
pub mod monitor;
mod particle;

use std::borrow::Cow;

use crate::{
    Error, Refusal, Scenario,
    outcome::{Outcome, RunResult},
    regime::Regime,
    validity::{Applicability, ValidityDomain, free_rear_face_assumed},
};

pub use checkpoint::CHECKPOINT_START;
pub(crate) use control::go_on;
pub use control::{Checkpoints, Control, OnFrame, Progress, go_on_to_next_run};
pub use courant_retry::AttemptError;
pub use estimate::{Estimate, time_in_words};
pub use input_limit::InputLimit;
pub use particle::Particle;
pub use particle::equivalent;

/// Order of the time that one run of a model takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CostClass {
    /// A formula or an ordinary differential equation: less than a millisecond.
    Analytic,
    /// A one-dimensional numerical model: up to seconds.
    Seconds,
    /// A two-dimensional numerical model: minutes. Comparisons and validations run it only where it is named.
    Minutes,
}

/// A number of elements times a factor, at least one.
pub fn times(elements: impl Into<f64>, factor: f64) -> u32 {
    (elements.into() * factor)
        .round()
        .clamp(1.0, u32::MAX.into()) as u32
}

/// A way to compute an impact.
pub trait Model: Sync {
    /// Name on the command line and in results.
    fn name(&self) -> &'static str;

    /// Name for readers, as figures have it: that of its authors or of its method.
    fn label(&self) -> Cow<'static, str> {
        Cow::Owned(self.name().replace('_', " "))
    }

    /// One line that says what it is.
    fn summary(&self) -> &'static str;

    /// The regime that it is made for.
    fn validity(&self) -> &'static ValidityDomain;

    /// The regime that it takes with the options of a case, where these widen or narrow it.
    fn validity_for(&self, _: &Scenario) -> &'static ValidityDomain {
        self.validity()
    }

    /// Order of the time that a run takes.
    fn cost(&self) -> CostClass {
        CostClass::Analytic
    }

    /// Whether it steps through time: then [`Control::frames`] gets its fields, and a run continues from a checkpoint.
    fn has_fields(&self) -> bool {
        false
    }

    /// Whether its fields are two-dimensional.
    fn is_two_dimensional(&self) -> bool {
        false
    }

    /// Whether it reads the table of options of the model with this name.
    fn reads_options_of(&self, model: &str) -> bool {
        model == self.name()
    }

    /// Why the model does not apply to a case inside its validity domain, if it does not: an option or a number is missing.
    fn not_applicable(&self, _: &Scenario) -> Option<Refusal> {
        None
    }

    /// Memory, steps and time that a run of a case takes, estimated without building it.
    fn estimate(&self, _: &Scenario) -> Estimate {
        Estimate::LITTLE
    }

    /// Ballistic limit that a model of residual velocity starts from, where the case has one; `None` for a model that needs none.
    fn input_limit(&self, _: &Scenario) -> Option<InputLimit> {
        None
    }

    /// The same case on a mesh that is `factor` times finer, or coarser below 1; `None` from a model without a mesh.
    fn refined(&self, _scenario: &Scenario, _factor: f64) -> Option<Scenario> {
        None
    }

    /// Computes a case to which the model applies.
    ///
    /// # Errors
    /// [`Error::Numerical`] when the solution fails or its balances do not close; [`Error::Cancelled`].
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

/// Computes a case by a model. [`Model::estimate`] says beforehand what that takes.
///
/// # Errors
/// [`Error::Input`] from [`Scenario::check`]; [`Error::NotApplicable`] when the model does not apply; otherwise those of [`Model::run`].
pub fn run(
    model: &dyn Model,
    scenario: &Scenario,
    control: &mut Control<'_>,
) -> Result<RunResult, Error> {
    scenario.check()?;
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
pub fn run_in(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
    control: &mut Control<'_>,
) -> Result<RunResult, Error> {
    let warnings =
        applicability_in(model, scenario, regime).map_err(|refusal| refused(model, refusal))?;
    let result = model.run(scenario, control)?;
    complete(model, scenario, warnings, result)
}

fn refused(model: &dyn Model, refusal: impl Into<Refusal>) -> Error {
    Error::not_applicable(model.name(), refusal)
}

/// What [`run_in`] makes of the model's own result, for a case to which the model applies with some warnings.
pub fn complete(
    model: &dyn Model,
    scenario: &Scenario,
    warnings: Vec<String>,
    mut result: RunResult,
) -> Result<RunResult, Error> {
    if let Some(depth) = result.depth_of_penetration
        && let Some(reason) = model.validity().depth_at_back_face(scenario, depth)
    {
        return Err(refused(model, reason));
    }
    if result.outcome == Outcome::Perforated {
        result.depth_of_penetration = None;
        result.largest_depth = None;
        result.permanent_depth = None;
        if !model.has_fields() {
            let assumed = free_rear_face_assumed(scenario);
            result.warnings.extend(assumed.map(str::to_owned));
        }
    }
    result.warnings.splice(0..0, warnings);
    Ok(result)
}

/// Whether a model applies to a case: the warnings of its validity, or the reason why not.
///
/// # Errors
/// Why it does not.
pub fn applicability(model: &dyn Model, scenario: &Scenario) -> Result<Vec<String>, Refusal> {
    if let Some(fault) = scenario.faults().into_iter().next() {
        let reason = format!("`{}`: {}", fault.key, fault.message);
        return Err(Refusal::new(reason).with_remedy(fault.help));
    }
    applicability_in(model, scenario, &Regime::of(scenario))
}

/// As [`applicability`], for a case whose regime is known.
///
/// # Errors
/// Why it does not.
pub fn applicability_in(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
) -> Result<Vec<String>, Refusal> {
    match model.validity_for(scenario).applicability(scenario, regime) {
        Applicability::Outside(refusal) => Err(refusal),
        Applicability::Inside(warnings) => match model.not_applicable(scenario) {
            Some(refusal) => Err(refusal),
            None => match memory::refusal(model.estimate(scenario).memory) {
                Some(refusal) => Err(refusal),
                None => Ok(warnings),
            },
        },
    }
}
