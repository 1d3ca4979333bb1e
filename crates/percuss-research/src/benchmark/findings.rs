//! Findings of the benchmark as sentences.

use percuss::{
    model_error::{
        Candidate, ErrorRecord, candidates,
        design::{LENGTHS, VELOCITIES},
    },
    regime::ProjectileRegime,
};

use super::{Errors, PAIRS, is_sharp, statistics::CLOSE};

/// Whether a model solves equations of motion along the axis, unlike formulae and rigid rods.
fn is_one_dimensional(candidate: &Candidate) -> bool {
    matches!(candidate.model.name(), "chain" | "fdm")
}

/// Target resistance model of the seed paper.
const PAPER: &str = "chain: column";
/// Models that were developed or corrected with the cases of both designs in view.
const SEEN: &str = "No constant of any model was fitted to the reference. The forms of `chain: expanding-cavity`, `energy_balance` and \
                    `momentum_balance` were chosen or corrected with these cases in view, so their errors are not blind.";

/// Sentences on the accuracy of one-dimensional models: the most accurate one, that of the seed paper, and where the median absolute error
/// is at most [`CLOSE`].
pub fn findings(verdicts: &[ErrorRecord]) -> Vec<String> {
    if verdicts.is_empty() {
        return vec!["There is no reference depth to compare with.".to_owned()];
    }
    let cases = count_cases(verdicts);
    let sharp = count_cases(verdicts.iter().filter(|verdict| is_sharp(verdict)));
    let mut sentences = vec![format!(
        "{cases} cases have a reference that passes its convergence check on three meshes; the uncertainty of {sharp} is at most 10 %."
    )];
    let all = |_: &ErrorRecord| true;
    if let Some((closure, errors)) = best(verdicts, is_one_dimensional, cases, all) {
        sentences.push(format!(
            "Most accurate one-dimensional model: `{}`, {}.",
            closure.name,
            words(&errors)
        ));
        sentences.extend(where_close(verdicts, closure.name));
    }
    let is_blind = !verdicts
        .iter()
        .any(|verdict| PAIRS.contains(&(verdict.projectile.as_str(), verdict.target.as_str())));
    sentences.push(SEEN.to_owned());
    if is_blind {
        sentences
            .push("No other model was developed on these cases: the errors are blind.".to_owned());
    }
    if let Some(errors) = errors_of(verdicts, PAPER, all) {
        sentences.push(format!(
            "Target resistance model of the seed paper, `{PAPER}` with constraint factor and border shear: {}.",
            words(&errors)
        ));
        sentences.extend(where_close(verdicts, PAPER));
    }
    if let Some((formula, errors)) = best(verdicts, |c| !is_one_dimensional(c), cases, all) {
        sentences.push(format!(
            "Most accurate other model with results for at least half of the cases: `{}`, {}.",
            formula.name,
            words(&errors)
        ));
    }
    for &regime in ProjectileRegime::ALL {
        let own = |verdict: &ErrorRecord| verdict.regime == regime;
        let cases = count_cases(verdicts.iter().filter(|verdict| own(verdict)));
        if let Some((candidate, errors)) = best(verdicts, |_| true, cases, own) {
            sentences.push(format!(
                "Most accurate model for {} projectiles ({cases} cases): `{}`, {}.",
                regime.describe(),
                candidate.name,
                words(&errors)
            ));
        }
    }
    sentences
}

fn count_cases<'a>(verdicts: impl IntoIterator<Item = &'a ErrorRecord>) -> usize {
    let mut cases: Vec<_> = verdicts
        .into_iter()
        .map(|v| {
            let numbers = (
                v.length_to_diameter.to_bits(),
                v.impact_velocity_m_s.to_bits(),
            );
            (&v.projectile, &v.target, numbers)
        })
        .collect();
    cases.sort_unstable();
    cases.dedup();
    cases.len()
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

/// Candidate with the smallest median absolute error among those with results for at least half of the cases.
fn best(
    verdicts: &[ErrorRecord],
    wanted: impl Fn(&Candidate) -> bool,
    cases: usize,
    of: impl Fn(&ErrorRecord) -> bool,
) -> Option<(&'static Candidate, Errors)> {
    candidates()
        .iter()
        .filter(|candidate| wanted(candidate))
        .filter_map(|candidate| Some((candidate, errors_of(verdicts, candidate.name, &of)?)))
        .filter(|(_, errors)| 2 * errors.count >= cases)
        .min_by(|a, b| a.1.median_absolute.total_cmp(&b.1.median_absolute))
}

fn words(errors: &Errors) -> String {
    let signed = |error: f64| match (100.0 * error).round() {
        0.0 => "0 %".to_owned(),
        percent => format!("{percent:+.0} %").replace('-', "\u{2212}"),
    };
    format!(
        "median error {}, 10th-90th percentile {} to {}, median absolute error {:.0} %, {:.0} % of {} cases within 25 %",
        signed(errors.median),
        signed(errors.low),
        signed(errors.high),
        100.0 * errors.median_absolute,
        100.0 * errors.within_25_percent,
        errors.count
    )
}

/// Lengths and velocities at which the median absolute error of a candidate is at most [`CLOSE`]; `None` without cases of the grid.
fn where_close(verdicts: &[ErrorRecord], candidate: &str) -> Option<String> {
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
    (all > 0).then(|| {
        format!(
            "Its median absolute error is at most 25 % in {close} of {all} combinations of velocity and length{places}."
        )
    })
}
