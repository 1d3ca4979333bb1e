//! Results of the benchmark in words.

use percuss::{
    model_error::{
        Candidate, ErrorRecord, candidates,
        design::{LENGTHS, VELOCITIES},
    },
    regime::ProjectileRegime,
};

use super::{Errors, is_sharp, statistics::CLOSE};

/// Whether a model solves equations of motion along the axis, as opposed to a formula or a rod that moves as a whole.
fn is_one_dimensional(candidate: &Candidate) -> bool {
    matches!(candidate.model.name(), "chain" | "fdm")
}

/// The paper's closure.
const PAPER: &str = "chain: column";
/// The closure whose forms were chosen with the reference in view.
const NOT_BLIND: &str = "chain: expanding-cavity";

/// Sentences that answer whether one dimension is enough: who errs least, how the paper's closure does, and where a one-dimensional
/// closure has a median error of at most [`CLOSE`], either way.
pub fn findings(verdicts: &[ErrorRecord]) -> Vec<String> {
    if verdicts.is_empty() {
        return vec!["There is no reference to judge by.".to_owned()];
    }
    let shots = count_shots(verdicts);
    let sharp = count_shots(verdicts.iter().filter(|verdict| is_sharp(verdict)));
    let mut sentences = vec![format!(
        "{shots} shots have a reference that passes its convergence check on three meshes: {sharp} are known within 10 %."
    )];
    let all = |_: &ErrorRecord| true;
    if let Some((closure, errors)) = best(verdicts, is_one_dimensional, shots, all) {
        sentences.push(format!(
            "Of the one-dimensional models and closures, `{}` errs least: {}.",
            closure.name,
            words(&errors)
        ));
        sentences.push(where_close(verdicts, closure.name));
    }
    if errors_of(verdicts, NOT_BLIND, all).is_some() {
        sentences.push(format!(
            "No constant of any model was fitted to the reference, but the forms of the parts of `{NOT_BLIND}` were chosen with it in \
             view: its errors are not blind."
        ));
    }
    if let Some(errors) = errors_of(verdicts, PAPER, all) {
        sentences.push(format!(
            "The paper's own closure, `{PAPER}` with constraint factor and border shear: {}.",
            words(&errors)
        ));
        sentences.push(where_close(verdicts, PAPER));
    }
    if let Some((formula, errors)) = best(verdicts, |c| !is_one_dimensional(c), shots, all) {
        sentences.push(format!(
            "Of the others that answer at least half of the shots, `{}` errs least: {}.",
            formula.name,
            words(&errors)
        ));
    }
    for &regime in ProjectileRegime::ALL {
        let own = |verdict: &ErrorRecord| verdict.regime == regime;
        let shots = count_shots(verdicts.iter().filter(|verdict| own(verdict)));
        if let Some((candidate, errors)) = best(verdicts, |_| true, shots, own) {
            sentences.push(format!(
                "On {} projectiles ({shots} shots) `{}` errs least of all: {}.",
                regime.describe(),
                candidate.name,
                words(&errors)
            ));
        }
    }
    sentences
}

fn count_shots<'a>(verdicts: impl IntoIterator<Item = &'a ErrorRecord>) -> usize {
    let mut shots: Vec<_> = verdicts
        .into_iter()
        .map(|v| {
            let numbers = (
                v.length_to_diameter.to_bits(),
                v.impact_velocity_m_s.to_bits(),
            );
            (&v.projectile, &v.target, numbers)
        })
        .collect();
    shots.sort_unstable();
    shots.dedup();
    shots.len()
}

fn errors_of(
    verdicts: &[ErrorRecord],
    candidate: &str,
    of: impl Fn(&ErrorRecord) -> bool,
) -> Option<Errors> {
    let own = verdicts
        .iter()
        .filter(|verdict| verdict.candidate == candidate && of(verdict));
    Errors::of(own.map(ErrorRecord::error))
}

/// The candidate with the smallest median magnitude of error among those that answer at least half of the shots.
fn best(
    verdicts: &[ErrorRecord],
    wanted: impl Fn(&Candidate) -> bool,
    shots: usize,
    of: impl Fn(&ErrorRecord) -> bool,
) -> Option<(&'static Candidate, Errors)> {
    candidates()
        .iter()
        .filter(|candidate| wanted(candidate))
        .filter_map(|candidate| Some((candidate, errors_of(verdicts, candidate.name, &of)?)))
        .filter(|(_, errors)| 2 * errors.count >= shots)
        .min_by(|a, b| a.1.median_absolute.total_cmp(&b.1.median_absolute))
}

fn words(errors: &Errors) -> String {
    let signed = |error: f64| match (100.0 * error).round() {
        0.0 => "0 %".to_owned(),
        percent => format!("{percent:+.0} %").replace('-', "\u{2212}"),
    };
    format!(
        "median error {}, {} to {} for eight of ten, median magnitude {:.0} %, {:.0} % of {} shots within 25 %",
        signed(errors.median),
        signed(errors.low),
        signed(errors.high),
        100.0 * errors.median_absolute,
        100.0 * errors.within_25_percent,
        errors.count
    )
}

/// Lengths and speeds at which the median magnitude of a candidate's error is small.
fn where_close(verdicts: &[ErrorRecord], candidate: &str) -> String {
    let (mut close, mut all) = (0, 0);
    let mut places = Vec::new();
    for &length in LENGTHS {
        let mut speeds = Vec::new();
        for &speed in VELOCITIES {
            let here =
                |v: &ErrorRecord| v.length_to_diameter == length && v.impact_velocity_m_s == speed;
            if let Some(errors) = errors_of(verdicts, candidate, here) {
                all += 1;
                if errors.median_absolute <= CLOSE {
                    close += 1;
                    speeds.push(speed.to_string());
                }
            }
        }
        if !speeds.is_empty() {
            places.push(format!("L/D {length} at {} m/s", speeds.join(", ")));
        }
    }
    let places = match places.is_empty() {
        true => String::new(),
        false => format!(": {}", places.join("; ")),
    };
    format!(
        "Its median magnitude is at most 25 % in {close} of {all} combinations of speed and length{places}."
    )
}
