//! What shots of a model come to: whether one is perforated, where the limit is, and what to warn of.

use super::{
    Bracket, CurvePoint, LambertJonasFit, LimitOutcome, ModelLimit, fit_lambert_jonas,
    search::{Passage, Sample, bracket},
};
use crate::{
    Error, Scenario,
    model::Model,
    outcome::{Outcome, RunResult},
    units::significant,
};

/// What is kept of a shot.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shot {
    pub scheme: &'static str,
    /// Speed behind the target [m/s].
    pub residual: Option<f64>,
    /// Ballistic limit that the model states [m/s].
    pub stated: Option<f64>,
    pub warnings: Vec<String>,
    /// How it ended without a result.
    pub absent: Option<LimitOutcome>,
}

impl Shot {
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

/// Why a model cannot be asked, at whatever speed.
pub(super) fn unsuited(model: &dyn Model, scenario: &Scenario) -> Option<String> {
    if !model.guard().decides_perforation() {
        return Some("it does not say whether a target is perforated".to_owned());
    }
    match scenario.target_thickness() {
        Some(_) => None,
        None => Some("the target has no back face to perforate".to_owned()),
    }
}

/// Whether a shot went through.
pub(super) fn passage(result: &RunResult) -> Passage {
    let undecided = |reason: &str| Passage::Undecided(reason.to_owned());
    match result.outcome {
        Outcome::Perforated => Passage::Perforated,
        Outcome::AtRest | Outcome::Rebounded | Outcome::ProjectileEroded => Passage::Stopped,
        Outcome::Separated => {
            undecided("the target runs away from the projectile, and whether it opens is not said")
        }
        Outcome::OutOfTime => undecided("the run ended before the shot did"),
        Outcome::NotApplicable => undecided("the model does not apply"),
        Outcome::Failed => undecided("the model failed"),
    }
}

/// Why a run gave no result.
pub(super) fn reason(error: &Error) -> String {
    match error {
        Error::NotApplicable { reason, .. } => reason.clone(),
        other => other.to_string(),
    }
}

/// The limit of a search [m/s]: what the model states where the bracket holds it, otherwise the middle of the bracket.
pub(super) fn limit_of(samples: &[Sample<Shot>]) -> Option<f64> {
    let (below, above) = bracket(samples)?;
    let (low, high) = (samples[below].speed, samples[above].speed);
    let stated = stated(samples).filter(|limit| (low..=high).contains(limit));
    Some(stated.unwrap_or(0.5 * (low + high)))
}

/// What the model states at the lowest speed that perforated.
fn stated(samples: &[Sample<Shot>]) -> Option<f64> {
    let perforated = |sample: &&Sample<Shot>| sample.passage == Passage::Perforated;
    samples.iter().find(perforated)?.shot.as_ref()?.stated
}

/// Residual velocities of shots that perforated.
pub(super) fn curve(shots: &[Sample<Shot>]) -> Vec<CurvePoint> {
    let through = shots
        .iter()
        .filter(|sample| sample.passage == Passage::Perforated);
    through
        .filter_map(|sample| {
            Some(CurvePoint {
                impact_velocity_m_s: sample.speed,
                residual_velocity_m_s: sample.shot.as_ref()?.residual?,
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
        bracket: None,
        runs: 0,
        curve: Vec::new(),
        fit: None,
        warnings: Vec::new(),
    }
}

/// The entry of a model whose shots, in the order of their speeds, are these.
pub(super) fn entry(
    model: &'static str,
    samples: &[Sample<Shot>],
    curve: Vec<CurvePoint>,
) -> ModelLimit {
    let shots = || samples.iter().filter_map(|sample| sample.shot.as_ref());
    let runs = shots().count();
    let scheme = shots().map(|shot| shot.scheme).find(|s| !s.is_empty());
    let scheme = scheme.unwrap_or("");
    let stated = stated(samples);
    let Some((below, above)) = bracket(samples) else {
        let (outcome, reason) = no_bracket(samples);
        return ModelLimit {
            scheme,
            runs,
            stated_limit_m_s: stated,
            warnings: speeds_without_answer(samples).into_iter().collect(),
            ..without_limit(model, outcome, reason)
        };
    };
    let found = Bracket {
        stopped_m_s: samples[below].speed,
        perforated_m_s: samples[above].speed,
    };
    let of_shot = samples[above].shot.as_ref();
    let mut warnings = of_shot.map_or_else(Vec::new, |shot| shot.warnings.clone());
    warnings.extend(undecided_inside(&samples[below..=above]));
    warnings.extend(stated_outside(stated, found));
    warnings.extend(not_monotone(samples, above));
    warnings.extend(speeds_without_answer(samples));
    let limit = limit_of(samples);
    let fit = fit_lambert_jonas(&curve);
    warnings.extend(curve_starts_elsewhere(limit, fit));
    ModelLimit {
        model,
        scheme,
        outcome: LimitOutcome::Found,
        reason: None,
        ballistic_limit_m_s: limit,
        stated_limit_m_s: stated,
        bracket: Some(found),
        runs,
        fit,
        curve,
        warnings,
    }
}

fn speed(sample: &Sample<Shot>) -> String {
    significant(sample.speed, 4)
}

/// What shots without a change from stopped to perforated say.
fn no_bracket(samples: &[Sample<Shot>]) -> (LimitOutcome, String) {
    let first = |wanted: fn(&Passage) -> bool| samples.iter().find(|s| wanted(&s.passage));
    let stopped = samples
        .iter()
        .rfind(|sample| sample.passage == Passage::Stopped && sample.speed > 0.0);
    let perforated = first(|passage| *passage == Passage::Perforated);
    match (stopped, perforated) {
        (Some(stopped), None) => (
            LimitOutcome::NeverPerforates,
            match samples
                .last()
                .is_some_and(|last| last.speed > stopped.speed)
            {
                true => format!(
                    "it is stopped at every speed up to {} m/s, and at higher ones the model gives no answer",
                    speed(stopped)
                ),
                false => format!(
                    "it is stopped at every speed up to {} m/s; search further up",
                    speed(stopped)
                ),
            },
        ),
        (None, Some(perforated)) => (
            LimitOutcome::AlwaysPerforates,
            format!(
                "it perforates at every speed from {} m/s on; search further down",
                speed(perforated)
            ),
        ),
        (Some(stopped), Some(perforated)) => (
            LimitOutcome::Undecided,
            format!(
                "it perforates at {} m/s and is stopped at {} m/s, above it: no change from stopped to perforated lies in the range",
                speed(perforated),
                speed(stopped)
            ),
        ),
        (None, None) => {
            let absent = samples.iter().filter_map(|s| Some((s, s.shot.as_ref()?)));
            let mut outcomes = absent.map(|(_, shot)| shot.absent);
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

/// Says that shots inside the bracket are neither stopped nor perforated.
fn undecided_inside(bracket: &[Sample<Shot>]) -> Option<String> {
    let inside = bracket.get(1..bracket.len() - 1)?;
    let (first, last) = (inside.first()?, inside.last()?);
    let Passage::Undecided(reason) = &first.passage else {
        return None;
    };
    Some(format!(
        "from {} to {} m/s, inside the bracket, the model does not decide: {reason}",
        speed(first),
        speed(last)
    ))
}

/// Says that a model's own limit is not where its shots change.
fn stated_outside(stated: Option<f64>, found: Bracket) -> Option<String> {
    let stated = stated?;
    let inside = (found.stopped_m_s..=found.perforated_m_s).contains(&stated);
    (!inside).then(|| {
        format!(
            "the model states a limit of {} m/s, but its shots change between {} and {} m/s",
            significant(stated, 4),
            significant(found.stopped_m_s, 4),
            significant(found.perforated_m_s, 4)
        )
    })
}

/// Part of the limit by which the start of a fitted curve may lie off.
const SAME_START: f64 = 0.05;

/// Says that the fitted curve does not start at the limit.
fn curve_starts_elsewhere(limit: Option<f64>, fit: Option<LambertJonasFit>) -> Option<String> {
    let (limit, start) = (limit?, fit?.ballistic_limit_m_s);
    ((start - limit).abs() > SAME_START * limit).then(|| {
        format!(
            "the curve through the residual velocities starts at {} m/s and not at the limit, {} m/s: they do not follow the form \
             of Lambert and Jonas",
            significant(start, 4),
            significant(limit, 4)
        )
    })
}

/// Says that faster shots are stopped, or that slower ones perforate.
fn not_monotone(samples: &[Sample<Shot>], above: usize) -> Option<String> {
    let (low, high) = samples.split_at(above);
    let through = low.iter().find(|s| s.passage == Passage::Perforated);
    let faster = || high.iter().filter(|s| s.passage == Passage::Stopped);
    let (from, to) = (faster().next(), faster().next_back());
    let words = match (through, from.zip(to)) {
        (Some(slow), _) => format!("a shot at {} m/s perforates", speed(slow)),
        (None, Some((from, to))) => format!(
            "shots that are faster are stopped again, at {}",
            match from.speed == to.speed {
                true => format!("{} m/s", speed(from)),
                false => format!("{} to {} m/s", speed(from), speed(to)),
            }
        ),
        (None, None) => return None,
    };
    Some(format!(
        "perforation is not monotone in the speed: {words}; the limit is the lowest change from stopped to perforated that was seen"
    ))
}

/// Says at which speeds, outside the bracket or without one, the model gave no answer.
fn speeds_without_answer(samples: &[Sample<Shot>]) -> Option<String> {
    let bracket = bracket(samples);
    let outside = |i: usize| bracket.is_none_or(|(low, high)| i < low || i > high);
    let silent: Vec<(&Sample<Shot>, &String)> = samples
        .iter()
        .enumerate()
        .filter(|(i, _)| outside(*i))
        .filter_map(|(_, sample)| match &sample.passage {
            Passage::Undecided(reason) => Some((sample, reason)),
            _ => None,
        })
        .collect();
    let decided = silent.len() < samples.iter().filter(|s| s.shot.is_some()).count();
    let ((first, reason), (last, _)) = (silent.first()?, silent.last()?);
    let range = match first.speed == last.speed {
        true => format!("at {} m/s", speed(first)),
        false => format!(
            "at {} speeds from {} to {} m/s",
            silent.len(),
            speed(first),
            speed(last)
        ),
    };
    decided.then(|| format!("{range} the model gives no answer: {reason}"))
}
