//! Ballistic limit of a case by every model that predicts perforation, and residual velocities.
//!
//! ```
//! use percuss::{case, limit::{limits, LimitOutcome, Search, Observer}, model::fast_models};
//!
//! let scenario = case::load_str("plate", r#"
//!     projectile = { material = "tool-steel-hrc53", mass = "197 g", diameter = "20 mm", impact_velocity = "300 m/s" }
//!     target = { material = "weldox-460-e", thickness = "12 mm" }
//! "#)?;
//! let limits = limits(&fast_models(), &scenario, &Search::default(), &mut Observer::default())?;
//! let plugging = limits.results.iter().find(|limit| limit.model == "plugging").unwrap();
//! assert_eq!(plugging.outcome, LimitOutcome::Found);
//! assert!((plugging.ballistic_limit_m_s.unwrap() - 131.43).abs() < 0.01);
//! # Ok::<(), percuss::Error>(())
//! ```

mod axisymmetric;
mod fit;
mod jobs;
mod rear_face;
mod recommended;
mod run_results;
mod search;
#[cfg(test)]
mod study_tests;
#[cfg(test)]
mod tests;
mod warnings;

use std::ops::RangeInclusive;

use serde::Serialize;

use crate::{
    Error, Scenario,
    analytic::InputLimit,
    axisymmetric::Request,
    check::{Diagnostic, limits},
    compare::{Choice, ExperimentRecord},
    cost, limit_error,
    model::{Estimate, Model},
    outcome::BandQuantity,
};

pub use crate::compare::{Observer, Progress};
pub use crate::limit_choice::with_free_rear_face;
pub use crate::limit_error::ExpectedLimitError;
pub use axisymmetric::{AxisymmetricLimit, LimitOnMesh};
pub use fit::{LambertJonasFit, fit_lambert_jonas, fit_lambert_jonas_from};
pub use rear_face::RearFace;

/// Range of impact velocities [m/s], ends included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Lowest.
    pub from: f64,
    /// Highest.
    pub to: f64,
}

impl Range {
    /// The velocity at a part of the way, 0 to 1; both ends are met exactly.
    fn at(self, part: f64) -> f64 {
        self.from * (1.0 - part) + self.to * part
    }
}

/// How narrow a bracket is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// This wide [m/s].
    Absolute(f64),
    /// As wide as this part of the velocity.
    Relative(f64),
}

impl Tolerance {
    /// Absolute widths that are allowed [m/s].
    pub const WIDTHS: RangeInclusive<f64> = 1e-6..=1000.0;
    /// Parts of the velocity that are allowed.
    pub const PARTS: RangeInclusive<f64> = 1e-8..=0.5;

    fn is_allowed(self) -> bool {
        match self {
            Self::Absolute(width) => Self::WIDTHS.contains(&width),
            Self::Relative(part) => Self::PARTS.contains(&part),
        }
    }

    /// Width at a velocity [m/s].
    fn at(self, velocity: f64) -> f64 {
        match self {
            Self::Absolute(width) => width,
            Self::Relative(part) => part * velocity,
        }
    }
}

/// Where and how closely to search, and how many residual velocities to compute.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// Range of impact velocities.
    pub range: Range,
    /// How narrow the bracket is to be.
    pub tolerance: Tolerance,
    /// Residual velocities to compute above the limit; none for 0.
    pub points: usize,
    /// Search with the axisymmetric model, beside the models. Beyond the budget there is a reason in place of a limit.
    pub axisymmetric: Option<Request>,
}

impl Search {
    fn check(&self) -> Result<(), Error> {
        let Range { from, to } = self.range;
        let allowed = limits::IMPACT_VELOCITY;
        let wrong = if !(allowed.allow(from) && allowed.allow(to) && from < to) {
            let message = format!("the range {from} to {to} m/s cannot be searched");
            let help = format!(
                "allowed: {} to {} m/s, the end above the start",
                allowed.min, allowed.max
            );
            Diagnostic::at("range", message, help)
        } else if !self.tolerance.is_allowed() {
            let message = format!("{:?} is out of range", self.tolerance);
            let help = "allowed: 1e-6 to 1000 m/s, or parts of 1e-8 to 0.5";
            Diagnostic::at("tolerance", message, help)
        } else {
            return Ok(());
        };
        Err(wrong.in_no_file("search").into())
    }
}

impl Default for Search {
    fn default() -> Self {
        Self {
            range: Range {
                from: 0.0,
                to: 2000.0,
            },
            tolerance: Tolerance::Absolute(0.1),
            points: 12,
            axisymmetric: None,
        }
    }
}

/// What a search came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LimitOutcome {
    /// A bracket was found.
    Found,
    /// The model starts from a given limit and predicts none.
    Input,
    /// Nothing in the range perforates.
    NeverPerforates,
    /// Everything in the range perforates.
    AlwaysPerforates,
    /// The runs do not say.
    Undecided,
    /// The model does not apply.
    NotApplicable,
    /// The model failed at every velocity.
    Failed,
}

impl LimitOutcome {
    /// The outcome in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Found => "found",
            Self::Input => "limit is an input",
            Self::NeverPerforates => "never perforates",
            Self::AlwaysPerforates => "always perforates",
            Self::Undecided => "undecided",
            Self::NotApplicable => "not applicable",
            Self::Failed => "failed",
        }
    }
}

/// The two runs that enclose a limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bracket {
    /// Highest impact velocity below the limit that was stopped [m/s].
    pub stopped_m_s: f64,
    /// Lowest impact velocity above it that perforated [m/s].
    pub perforated_m_s: f64,
}

/// A residual velocity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CurvePoint {
    /// Impact velocity [m/s].
    pub impact_velocity_m_s: f64,
    /// Residual velocity [m/s].
    pub residual_velocity_m_s: f64,
}

/// What one model says. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelLimit {
    /// Name of the model.
    pub model: &'static str,
    /// Scheme of the model.
    pub scheme: &'static str,
    /// What the search came to.
    pub outcome: LimitOutcome,
    /// Why there is no limit, if there is none.
    pub reason: Option<String>,
    /// Ballistic limit [m/s]: what the model states where the bracket holds it, otherwise the middle of the bracket.
    pub ballistic_limit_m_s: Option<f64>,
    /// Ballistic limit that the model states of itself [m/s].
    pub stated_limit_m_s: Option<f64>,
    /// Ballistic limit that the model starts from; it is no prediction.
    pub input_limit: Option<InputLimit>,
    /// Expected error of the limit, from published limits of the same kind.
    pub expected_error: Option<ExpectedLimitError>,
    /// The bracket.
    pub bracket: Option<Bracket>,
    /// Runs that were computed, those of the curve included.
    pub runs: usize,
    /// Residual velocities above the limit.
    pub curve: Vec<CurvePoint>,
    /// The curve of Lambert and Jonas through them, which starts at the limit where it was found.
    pub fit: Option<LambertJonasFit>,
    /// Limitations of the numbers.
    pub warnings: Vec<String>,
}

/// What every model says of the ballistic limit of a case. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Limits {
    /// Name of the case.
    pub case: String,
    /// Version of the program.
    pub percuss_version: &'static str,
    /// Lowest and highest impact velocity of the search [m/s].
    pub searched_m_s: (f64, f64),
    /// Rear face of the target; null where it has none.
    pub rear_face: Option<RearFace>,
    /// The models that are the first choice at their own limit and predict limits; may be empty.
    pub recommended: Vec<Choice>,
    /// Remarks on that choice, if there is something.
    pub note: Option<String>,
    /// The axisymmetric limit, where it contradicts a recommended one [m/s]; not in JSON.
    #[serde(skip)]
    pub contradiction: Option<f64>,
    /// Range of the limits that models predict within their ranges of validity, the axisymmetric one of layers that can fail included; null where
    /// none does.
    pub range: Option<LimitRange>,
    /// Limit by the axisymmetric model in the limit of fine meshes; null where it was not asked for.
    pub axisymmetric: Option<AxisymmetricLimit>,
    /// What was measured.
    pub experiments: Vec<ExperimentRecord>,
    /// One entry per model, in their order.
    pub results: Vec<ModelLimit>,
}

/// Lowest and highest of the limits that models predict. The names are stable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LimitRange {
    /// Lowest [m/s].
    pub lowest_m_s: f64,
    /// Highest [m/s].
    pub highest_m_s: f64,
    /// How many models predict one.
    pub models: usize,
}

/// Part of the time of a study with axisymmetric runs that the other models take.
const ONE_DIMENSIONAL: f64 = 0.02;

/// Searches for the ballistic limit of a case by these models, on all cores.
///
/// The rear face of a plate is free unless the case gives another one; behind a fixed one perforation is impossible. A model that
/// does not apply, fails or finds none leaves the reason in its entry and never stops the others.
///
/// # Errors
/// [`Error::Input`] for a range or tolerance that is not allowed; [`Error::Cancelled`] when `observer` says so.
pub fn limits(
    models: &[&dyn Model],
    scenario: &Scenario,
    search: &Search,
    observer: &mut Observer<'_>,
) -> Result<Limits, Error> {
    search.check()?;
    scenario.check()?;
    let free = with_free_rear_face(scenario);
    let scenario = free.as_ref().unwrap_or(scenario);
    let of_models = models.iter().map(|model| cost::of_run(*model, scenario));
    let of_meshes = search.axisymmetric.map(|request| request.memory(scenario));
    let memory = of_models
        .sum::<Estimate>()
        .memory
        .max(of_meshes.unwrap_or(0.0));
    cost::within_memory(memory, || searched(models, scenario, search, observer))
}

/// The same on these threads, for a plate whose rear face is as it has to be.
fn searched(
    models: &[&dyn Model],
    scenario: &Scenario,
    search: &Search,
    observer: &mut Observer<'_>,
) -> Result<Limits, Error> {
    // Runs of one-dimensional models and formulae take no time beside those of the axisymmetric model.
    let share = match search.axisymmetric {
        Some(_) => ONE_DIMENSIONAL,
        None => 1.0,
    };
    let mut report = axisymmetric::part_of(observer, 0, [0.0, share]);
    let mut first = Observer {
        progress: Some(&mut report),
    };
    let mut results = jobs::run(models, scenario, search, &mut first)?;
    drop(report);
    for (model, entry) in models.iter().zip(&mut results) {
        let limit = entry.ballistic_limit_m_s;
        let expected = limit.map(|limit| limit_error::expected_error(*model, scenario, limit));
        entry.expected_error = expected.flatten();
    }
    let of_models = LimitRange::of(results.iter().filter_map(|entry| entry.ballistic_limit_m_s));
    let axisymmetric = search
        .axisymmetric
        .map(|request| {
            let runs = results.iter().map(|entry| entry.runs).sum();
            let mut report = axisymmetric::part_of(observer, runs, [share, 1.0]);
            let mut rest = Observer {
                progress: Some(&mut report),
            };
            axisymmetric::on_meshes(scenario, &request, search, of_models, &mut rest)
        })
        .transpose()?;
    let (recommended, note, contradiction) =
        recommended::recommended(models, scenario, &results, axisymmetric.as_ref());
    let reliable = recommended::within_range(models, scenario, &results).chain(
        recommended::of_failing_layers(scenario, axisymmetric.as_ref()),
    );
    let range = LimitRange::of(reliable);
    Ok(Limits {
        case: scenario.name.clone(),
        percuss_version: env!("CARGO_PKG_VERSION"),
        searched_m_s: (search.range.from, search.range.to),
        rear_face: RearFace::of(scenario),
        recommended,
        note,
        contradiction,
        range,
        axisymmetric,
        experiments: ExperimentRecord::all(scenario),
        results,
    })
}

impl LimitRange {
    fn of(limits: impl Iterator<Item = f64>) -> Option<Self> {
        let found: Vec<f64> = limits.collect();
        let values = || found.iter().copied();
        Some(Self {
            lowest_m_s: values().reduce(f64::min)?,
            highest_m_s: values().reduce(f64::max)?,
            models: found.len(),
        })
    }
}

impl Limits {
    /// Whether any model found a limit.
    pub fn has_results(&self) -> bool {
        self.results
            .iter()
            .any(|limit| limit.outcome == LimitOutcome::Found)
    }

    /// Whether a model is recommended.
    pub fn is_recommended(&self, model: &str) -> bool {
        self.recommended.iter().any(|choice| choice.model == model)
    }

    /// Models that predict a limit and have no expected error of it.
    pub fn without_expected_error(&self) -> Vec<&'static str> {
        let found = self.results.iter();
        let found = found.filter(|entry| entry.outcome == LimitOutcome::Found);
        found
            .filter(|entry| entry.expected_error.is_none())
            .map(|entry| entry.model)
            .collect()
    }

    /// Mean of the measured ballistic limits [m/s], and of how many.
    pub fn measured(&self) -> Option<(f64, usize)> {
        let measured = self.experiments.iter();
        let limits: Vec<f64> = measured
            .filter(|measured| measured.quantity == BandQuantity::BallisticLimit)
            .map(|measured| measured.value)
            .collect();
        let count = limits.len();
        (count > 0).then(|| (limits.iter().sum::<f64>() / count as f64, count))
    }
}
