//! Search for the impact velocity at which perforation begins.

use rayon::prelude::*;

use super::{Range, Tolerance};
use crate::Error;

/// Bound on the runs that narrow a bracket: twice what the precision of a velocity can ask for.
const MOST_RUNS: usize = 100;

/// What becomes of a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Passage {
    /// The target stops it.
    Stopped,
    /// Perforated.
    Perforated,
    /// Neither is known, for this reason.
    Undecided(String),
}

/// A run at a velocity.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sample<T> {
    /// Impact velocity [m/s].
    pub velocity: f64,
    /// What became of it.
    pub passage: Passage,
    /// What else is known of it.
    pub run: Option<T>,
}

/// Runs in the order of their velocities.
pub(super) type Samples<T> = Vec<Sample<T>>;

/// Tries the ends of equal intervals of a range, then narrows the lowest change from stopped to perforated.
///
/// # Errors
/// Those of `shoot`, which are not for reasons that a sample carries.
pub(super) fn search<T: Send>(
    range: Range,
    tolerance: Tolerance,
    intervals: u32,
    shoot: &(dyn Fn(f64) -> Result<Sample<T>, Error> + Sync),
) -> Result<Samples<T>, Error> {
    let mut samples: Samples<T> = (0..=intervals)
        .into_par_iter()
        .map(|i| shoot(range.at(f64::from(i) / f64::from(intervals))))
        .collect::<Result<_, _>>()?;
    for _ in 0..MOST_RUNS {
        let Some(velocity) = next_velocity(&samples, tolerance) else {
            break;
        };
        let at = samples.partition_point(|sample| sample.velocity < velocity);
        samples.insert(at, shoot(velocity)?);
    }
    Ok(samples)
}

/// Indices of the lowest pair of a stopped and a perforated run with none that is decided between them.
pub(super) fn bracket<T>(samples: &[Sample<T>]) -> Option<(usize, usize)> {
    let mut stopped = None;
    for (i, sample) in samples.iter().enumerate() {
        match (&sample.passage, stopped) {
            (Passage::Stopped, _) => stopped = Some(i),
            (Passage::Perforated, Some(below)) => return Some((below, i)),
            _ => {}
        }
    }
    None
}

/// Middle of the interval to narrow, unless that is narrow enough. Where undecided runs lie in the bracket, the intervals at its
/// two ends are narrowed; where there is no bracket, those in which a change may hide.
fn next_velocity<T>(samples: &[Sample<T>], tolerance: Tolerance) -> Option<f64> {
    let ends = match bracket(samples) {
        Some((below, above)) => vec![(below, below + 1), (above - 1, above)],
        None => edges(samples),
    };
    let narrow = |(low, high): (usize, usize)| {
        let (low, high) = (samples[low].velocity, samples[high].velocity);
        let middle = 0.5 * (low + high);
        let wide = high - low > tolerance.at(high) && low < middle && middle < high;
        wide.then_some(middle)
    };
    ends.into_iter().find_map(narrow)
}

/// Intervals from the highest stopped run to an undecided one above it, and from an undecided run to the lowest perforated one: the range of a
/// model ends there, and the limit may lie between its end and the last run that is decided.
fn edges<T>(samples: &[Sample<T>]) -> Vec<(usize, usize)> {
    let undecided =
        |i: usize| matches!(samples.get(i)?.passage, Passage::Undecided(_)).then_some(i);
    let stopped = samples.iter().rposition(|s| s.passage == Passage::Stopped);
    let perforated = samples
        .iter()
        .position(|s| s.passage == Passage::Perforated);
    let upper = stopped.filter(|_| perforated.is_none());
    let upper = upper.and_then(|i| Some((i, undecided(i + 1)?)));
    let lower = perforated.filter(|_| stopped.is_none());
    let lower = lower.and_then(|i| Some((undecided(i.checked_sub(1)?)?, i)));
    upper.into_iter().chain(lower).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn searched(passage: impl Fn(f64) -> Passage + Sync) -> Samples<()> {
        let range = Range {
            from: 0.0,
            to: 1600.0,
        };
        search(range, Tolerance::Absolute(0.5), 16, &|velocity| {
            Ok(Sample {
                velocity,
                passage: passage(velocity),
                run: None,
            })
        })
        .unwrap()
    }

    fn velocities(samples: &Samples<()>) -> Option<(f64, f64)> {
        bracket(samples).map(|(low, high)| (samples[low].velocity, samples[high].velocity))
    }

    fn over(limit: f64) -> impl Fn(f64) -> Passage {
        move |velocity| match velocity > limit {
            true => Passage::Perforated,
            false => Passage::Stopped,
        }
    }

    #[test]
    fn the_bracket_holds_the_limit_and_is_as_narrow_as_was_asked() {
        for limit in [0.0, 0.1, 184.5, 700.0, 1599.9] {
            let samples = searched(over(limit));
            let (low, high) = velocities(&samples).unwrap();
            assert!(low <= limit && limit < high, "{limit}: {low} to {high}");
            assert!(high - low <= 0.5);
            // 17 of the scan and 8 halvings of 100 m/s.
            assert_eq!(samples.len(), 25);
            assert!(samples.is_sorted_by(|a, b| a.velocity < b.velocity));
        }
    }

    #[test]
    fn a_relative_tolerance_is_one_of_the_velocity() {
        let range = Range {
            from: 100.0,
            to: 900.0,
        };
        let shoot = |velocity| {
            Ok(Sample {
                velocity,
                passage: over(400.0)(velocity),
                run: None::<()>,
            })
        };
        let samples = search(range, Tolerance::Relative(0.01), 16, &shoot).unwrap();
        let (low, high) = velocities(&samples).unwrap();
        assert!(high - low <= 4.04 && high - low > 1.0);
    }

    #[test]
    fn without_a_change_nothing_is_narrowed() {
        for samples in [
            searched(|_| Passage::Stopped),
            searched(|_| Passage::Perforated),
        ] {
            assert_eq!((samples.len(), velocities(&samples)), (17, None));
        }
    }

    #[test]
    fn a_limit_beside_the_end_of_a_models_range_is_found() {
        let unknown = || Passage::Undecided("out of range".to_owned());
        let below = |velocity: f64| {
            if velocity > 410.0 {
                unknown()
            } else {
                over(402.0)(velocity)
            }
        };
        let above = |velocity: f64| {
            if velocity < 395.0 {
                unknown()
            } else {
                over(398.0)(velocity)
            }
        };
        for (samples, limit) in [(searched(below), 402.0), (searched(above), 398.0)] {
            let (low, high) = velocities(&samples).unwrap();
            assert!(low <= limit && limit < high && high - low <= 0.5);
        }
        // Where there is none, the runs come as near to the end of the range as was asked.
        let samples = searched(|velocity| {
            if velocity > 410.0 {
                unknown()
            } else {
                Passage::Stopped
            }
        });
        let highest = samples
            .iter()
            .rfind(|s| s.passage == Passage::Stopped)
            .unwrap();
        assert!(velocities(&samples).is_none() && (409.5..=410.0).contains(&highest.velocity));
    }

    #[test]
    fn of_several_changes_the_lowest_is_narrowed() {
        let gap = |velocity: f64| match velocity {
            ..=350.0 => Passage::Stopped,
            ..=820.0 => Passage::Perforated,
            ..=1210.0 => Passage::Stopped,
            _ => Passage::Perforated,
        };
        let (low, high) = velocities(&searched(gap)).unwrap();
        assert!(low <= 350.0 && 350.0 < high && high - low <= 0.5);
    }

    #[test]
    fn both_ends_of_an_undecided_zone_are_narrowed() {
        let zone = |velocity: f64| match velocity {
            ..=333.0 => Passage::Stopped,
            ..=777.0 => Passage::Undecided("not known".to_owned()),
            _ => Passage::Perforated,
        };
        let (low, high) = velocities(&searched(zone)).unwrap();
        assert!((332.5..=333.0).contains(&low), "{low}");
        assert!((777.0..=777.5).contains(&high), "{high}");
    }
}
