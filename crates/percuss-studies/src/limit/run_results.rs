//! Results of the runs of a model: perforation, ballistic limit, warnings.

use super::{
    Bracket, CurvePoint, LimitOutcome, ModelLimit, RearFace, fit_lambert_jonas,
    fit_lambert_jonas_from,
    search::{Passage, Sample, bracket},
    warnings,
};
use crate::{
    Error, Scenario,
    analytic::InputLimit,
    model::Model,
    outcome::{Outcome, RunResult},
    units::significant,
};

/// What is kept of a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LimitRun {
    pub scheme: &'static str,
    /// Residual velocity [m/s].
    pub residual: Option<f64>,
    /// Ballistic limit that the model states [m/s].
    pub stated: Option<f64>,
    pub warnings: Vec<String>,
    /// How it ended without a result.
    pub absent: Option<LimitOutcome>,
}

impl LimitRun {
    pub(super) fn of(result: RunResult) -> Self {
        Self {
            scheme: result.scheme,
            residual: result.residual_velocity,
            stated: result.ballistic_limit,
            warnings: result.warnings,
            absent: None,
        }
    }

    pub(super) fn failed(error: &Error) -> Self {
        Self {
            scheme: "",
            residual: None,
            stated: None,
            warnings: Vec::new(),
            absent: Some(match error {
                Error::NotApplicable { .. } => LimitOutcome::NotApplicable,
                _ => LimitOutcome::Failed,
            }),
        }
    }
}

/// Why a model cannot be asked, at whatever velocity, and what the search comes to then.
pub(super) fn unsuited(model: &dyn Model, scenario: &Scenario) -> Option<(LimitOutcome, String)> {
    if !model.validity().decides_perforation() {
        let reason = "it does not predict perforation".to_owned();
        return Some((LimitOutcome::NotApplicable, reason));
    }
    match RearFace::of(scenario) {
        Some(face) => Some((LimitOutcome::NeverPerforates, face.impossible()?)),
        None => Some((
            LimitOutcome::NotApplicable,
            "the target has no rear face to perforate".to_owned(),
        )),
    }
}

/// Whether a run perforates.
pub(super) fn passage(result: &RunResult) -> Passage {
    let why = match result.outcome {
        Outcome::Separated => "the target translates as a rigid body, and perforation is undecided",
        Outcome::OutOfTime => "the run ended before the impact did",
        Outcome::NotApplicable => "the model does not apply",
        _ => "the model failed",
    };
    match result.outcome.perforated() {
        Some(true) => Passage::Perforated,
        Some(false) => Passage::Stopped,
        None => Passage::Undecided(why.to_owned()),
    }
}

/// Why a run gave no result.
pub(super) fn reason(error: &Error) -> String {
    match error {
        Error::NotApplicable { refusal, .. } => refusal.to_string(),
        other => other.to_string(),
    }
}

/// The limit of a search [m/s]: what the model states where the bracket holds it, otherwise the middle of the bracket.
pub(super) fn limit_of(samples: &[Sample<LimitRun>]) -> Option<f64> {
    let (below, above) = bracket(samples)?;
    let (low, high) = (samples[below].velocity, samples[above].velocity);
    let stated = stated(samples).filter(|limit| (low..=high).contains(limit));
    Some(stated.unwrap_or(0.5 * (low + high)))
}

/// What the model states at the lowest velocity that perforated.
fn stated(samples: &[Sample<LimitRun>]) -> Option<f64> {
    let perforated = |sample: &&Sample<LimitRun>| sample.passage == Passage::Perforated;
    samples.iter().find(perforated)?.run.as_ref()?.stated
}

/// Residual velocities of runs that perforated; zero where a plug has left and the projectile does not follow it.
pub(super) fn curve(runs: &[Sample<LimitRun>]) -> Vec<CurvePoint> {
    let through = runs
        .iter()
        .filter(|sample| sample.passage == Passage::Perforated);
    through
        .filter_map(|sample| {
            Some(CurvePoint {
                impact_velocity_m_s: sample.velocity,
                residual_velocity_m_s: sample.run.as_ref()?.residual?.max(0.0),
            })
        })
        .collect()
}

/// The entry of a model without a limit.
pub(super) fn without_limit(
    model: &'static str,
    outcome: LimitOutcome,
    reason: String,
) -> ModelLimit {
    ModelLimit {
        model,
        scheme: "",
        outcome,
        reason: Some(reason),
        ballistic_limit_m_s: None,
        stated_limit_m_s: None,
        input_limit: None,
        expected_error: None,
        bracket: None,
        runs: 0,
        curve: Vec::new(),
        fit: None,
        warnings: Vec::new(),
    }
}

/// The entry of a model whose runs, in the order of their velocities, are these.
pub(super) fn entry(
    model: &'static str,
    samples: &[Sample<LimitRun>],
    curve: Vec<CurvePoint>,
) -> ModelLimit {
    let results = || samples.iter().filter_map(|sample| sample.run.as_ref());
    let runs = results().count();
    let scheme = results().map(|run| run.scheme).find(|s| !s.is_empty());
    let scheme = scheme.unwrap_or("");
    let stated = stated(samples);
    let Some((below, above)) = bracket(samples) else {
        let (outcome, reason) = no_bracket(samples);
        return ModelLimit {
            scheme,
            runs,
            stated_limit_m_s: stated,
            warnings: warnings::velocities_without_answer(samples)
                .into_iter()
                .collect(),
            ..without_limit(model, outcome, reason)
        };
    };
    // At rest nothing penetrates: that alone bounds no limit from below.
    if samples[below].velocity == 0.0
        && let Some(undecided) = warnings::undecided(&samples[below..=above], "")
    {
        let reason = format!(
            "complete penetration at {} m/s; {undecided}",
            velocity(&samples[above])
        );
        return ModelLimit {
            scheme,
            runs,
            stated_limit_m_s: stated,
            curve,
            ..without_limit(model, LimitOutcome::Undecided, reason)
        };
    }
    let found = Bracket {
        stopped_m_s: samples[below].velocity,
        perforated_m_s: samples[above].velocity,
    };
    let of_run = samples[above].run.as_ref();
    let mut said = of_run.map_or_else(Vec::new, |run| run.warnings.clone());
    said.extend(warnings::undecided_inside(&samples[below..=above]));
    said.extend(warnings::stated_outside(stated, found));
    said.extend(warnings::not_monotone(samples, above));
    said.extend(warnings::velocities_without_answer(samples));
    let limit = limit_of(samples);
    let free = fit_lambert_jonas(&curve);
    let fit = match limit {
        Some(limit) => fit_lambert_jonas_from(limit, &curve),
        None => free,
    };
    said.extend(warnings::curve_starts_elsewhere(limit, free));
    said.extend(warnings::curve_gains_velocity(fit));
    ModelLimit {
        scheme,
        reason: None,
        ballistic_limit_m_s: limit,
        stated_limit_m_s: stated,
        bracket: Some(found),
        runs,
        fit,
        curve,
        warnings: said,
        ..without_limit(model, LimitOutcome::Found, String::new())
    }
}

/// The entry of a model that starts from a limit, whose runs above it, in the order of their velocities, are these.
pub(super) fn input_entry(
    model: &'static str,
    input: InputLimit,
    samples: &[Sample<LimitRun>],
) -> ModelLimit {
    let runs = || samples.iter().filter_map(|sample| sample.run.as_ref());
    let curve = curve(samples);
    let input_limit = Some(input);
    if curve.is_empty() && !samples.is_empty() {
        let (outcome, reason) = no_bracket(samples);
        return ModelLimit {
            input_limit,
            runs: runs().count(),
            ..without_limit(model, outcome, reason)
        };
    }
    let mut said = runs()
        .next()
        .map_or_else(Vec::new, |run| run.warnings.clone());
    said.extend(warnings::velocities_without_answer(samples));
    ModelLimit {
        scheme: runs()
            .map(|run| run.scheme)
            .find(|scheme| !scheme.is_empty())
            .unwrap_or(""),
        input_limit,
        runs: runs().count(),
        fit: fit_lambert_jonas(&curve),
        curve,
        warnings: said,
        ..without_limit(
            model,
            LimitOutcome::Input,
            format!(
                "it starts from the limit of {}, {} m/s, and predicts none",
                input.origin_in_words(),
                significant(input.ballistic_limit_m_s, 4)
            ),
        )
    }
}

pub(super) fn velocity(sample: &Sample<LimitRun>) -> String {
    significant(sample.velocity, 4)
}

/// What runs without a change from stopped to perforated say.
fn no_bracket(samples: &[Sample<LimitRun>]) -> (LimitOutcome, String) {
    let first = |wanted: fn(&Passage) -> bool| samples.iter().find(|s| wanted(&s.passage));
    let stopped = samples
        .iter()
        .rfind(|sample| sample.passage == Passage::Stopped && sample.velocity > 0.0);
    let perforated = first(|passage| *passage == Passage::Perforated);
    match (stopped, perforated) {
        (Some(stopped), None) => (
            LimitOutcome::NeverPerforates,
            match samples
                .last()
                .is_some_and(|last| last.velocity > stopped.velocity)
            {
                true => format!(
                    "partial penetration at every velocity up to {} m/s; at higher ones the model gives no answer",
                    velocity(stopped)
                ),
                false => format!(
                    "partial penetration at every velocity up to {} m/s; search a range of higher velocities",
                    velocity(stopped)
                ),
            },
        ),
        (None, Some(perforated)) => (
            LimitOutcome::AlwaysPerforates,
            format!(
                "complete penetration at every velocity from {} m/s on; search a range of lower velocities",
                velocity(perforated)
            ),
        ),
        (Some(stopped), Some(perforated)) => (
            LimitOutcome::Undecided,
            format!(
                "complete penetration at {} m/s and partial at {} m/s, above it: no change from partial to complete lies in the range",
                velocity(perforated),
                velocity(stopped)
            ),
        ),
        (None, None) => {
            let absent = samples.iter().filter_map(|s| Some((s, s.run.as_ref()?)));
            let mut outcomes = absent.map(|(_, run)| run.absent);
            let one = outcomes.next().flatten();
            let all_same = one.is_some() && outcomes.all(|outcome| outcome == one);
            let reason = samples.iter().find_map(|sample| match &sample.passage {
                Passage::Undecided(reason) => Some(reason.clone()),
                _ => None,
            });
            let outcome = one.filter(|_| all_same).unwrap_or(LimitOutcome::Undecided);
            (outcome, reason.unwrap_or_default())
        }
    }
}
