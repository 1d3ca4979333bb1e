//! Limitations of a limit that was searched for.

use super::{
    Bracket, LambertJonasFit,
    run_results::{LimitRun, velocity},
    search::{Passage, Sample, bracket},
};
use crate::units::significant;

/// Says that runs inside the bracket are neither stopped nor perforated.
pub(super) fn undecided_inside(bracket: &[Sample<LimitRun>]) -> Option<String> {
    undecided(bracket, ", inside the bracket,")
}

/// Where in a bracket no run is decided, with what stands after the velocities, and why.
pub(super) fn undecided(bracket: &[Sample<LimitRun>], place: &str) -> Option<String> {
    let inside = bracket.get(1..bracket.len() - 1)?;
    let (first, last) = (inside.first()?, inside.last()?);
    let Passage::Undecided(reason) = &first.passage else {
        return None;
    };
    let velocities = match inside.len() {
        1 => format!("at {}", velocity(first)),
        _ => format!("from {} to {}", velocity(first), velocity(last)),
    };
    Some(format!(
        "{velocities} m/s{place} the model does not decide: {reason}"
    ))
}

/// Says that a model's own limit is not where its runs change.
pub(super) fn stated_outside(stated: Option<f64>, found: Bracket) -> Option<String> {
    let stated = stated?;
    let inside = (found.stopped_m_s..=found.perforated_m_s).contains(&stated);
    (!inside).then(|| {
        format!(
            "the model states a limit of {} m/s, but its runs change between {} and {} m/s",
            significant(stated, 4),
            significant(found.stopped_m_s, 4),
            significant(found.perforated_m_s, 4)
        )
    })
}

/// Part of the limit by which the start of a curve with a free limit may lie off.
const SAME_START: f64 = 0.05;

/// Says that a curve with a free limit would not start at the limit.
pub(super) fn curve_starts_elsewhere(
    limit: Option<f64>,
    free: Option<LambertJonasFit>,
) -> Option<String> {
    let (limit, start) = (limit?, free?.ballistic_limit_m_s);
    ((start - limit).abs() > SAME_START * limit).then(|| {
        format!(
            "the residual velocities do not follow the form of Lambert and Jonas: with v_bl fixed at the limit, {} m/s, their curve is rough \
             near it; a free v_bl would be {} m/s",
            significant(limit, 4),
            significant(start, 4)
        )
    })
}

/// Part of 1 by which `a` of a fitted curve may exceed 1, for rounding.
const ROUNDING: f64 = 1e-3;

/// Says that a fitted curve leaves faster than it arrives.
pub(super) fn curve_gains_velocity(fit: Option<LambertJonasFit>) -> Option<String> {
    let a = fit?.a;
    (a > 1.0 + ROUNDING).then(|| {
        format!(
            "the curve through the residual velocities has a = {}: above 1 the fit is not physical, a fast projectile would leave faster than it \
             arrived; do not use it beyond the computed velocities",
            significant(a, 4)
        )
    })
}

/// Says that faster runs are stopped, or that slower ones perforate.
pub(super) fn not_monotone(samples: &[Sample<LimitRun>], above: usize) -> Option<String> {
    let (low, high) = samples.split_at(above);
    let through = low.iter().find(|s| s.passage == Passage::Perforated);
    let faster = || high.iter().filter(|s| s.passage == Passage::Stopped);
    let (from, to) = (faster().next(), faster().next_back());
    let words = match (through, from.zip(to)) {
        (Some(slow), _) => format!("a run at {} m/s perforates", velocity(slow)),
        (None, Some((from, to))) => format!(
            "runs that are faster are stopped again, at {}",
            match from.velocity == to.velocity {
                true => format!("{} m/s", velocity(from)),
                false => format!("{} to {} m/s", velocity(from), velocity(to)),
            }
        ),
        (None, None) => return None,
    };
    Some(format!(
        "perforation is not monotone in the velocity: {words}; the limit is the lowest change from stopped to perforated that was seen"
    ))
}

/// Says at which velocities, outside the bracket or without one, the model gave no answer.
pub(super) fn velocities_without_answer(samples: &[Sample<LimitRun>]) -> Option<String> {
    let bracket = bracket(samples);
    let outside = |i: usize| bracket.is_none_or(|(low, high)| i < low || i > high);
    let silent: Vec<(&Sample<LimitRun>, &String)> = samples
        .iter()
        .enumerate()
        .filter(|(i, _)| outside(*i))
        .filter_map(|(_, sample)| match &sample.passage {
            Passage::Undecided(reason) => Some((sample, reason)),
            _ => None,
        })
        .collect();
    let decided = silent.len() < samples.iter().filter(|s| s.run.is_some()).count();
    let ((first, reason), (last, _)) = (silent.first()?, silent.last()?);
    let range = match first.velocity == last.velocity {
        true => format!("at {} m/s", velocity(first)),
        false => format!(
            "at {} velocities from {} to {} m/s",
            silent.len(),
            velocity(first),
            velocity(last)
        ),
    };
    decided.then(|| format!("{range} the model gives no answer: {reason}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_above_the_impact_velocity_is_not_physical() {
        let of = |a: f64| {
            curve_gains_velocity(Some(LambertJonasFit {
                a,
                p: 2.0,
                ballistic_limit_m_s: 200.0,
                rms_m_s: 1.0,
            }))
        };
        assert_eq!(
            (of(0.9), of(1.0005), curve_gains_velocity(None)),
            (None, None, None)
        );
        let words = of(1.234_56).unwrap();
        assert!(
            words.contains("a = 1.235: above 1 the fit is not physical"),
            "{words}"
        );
    }
}
