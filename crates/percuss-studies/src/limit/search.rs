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

/// What the search reads of a run.
pub(super) trait HasResidual {
    /// Velocity of the projectile behind the target [m/s].
    fn residual(&self) -> Option<f64>;
}

/// Runs in the order of their velocities.
pub(super) type Samples<T> = Vec<Sample<T>>;

/// Tries the ends of equal intervals of a range, then narrows the lowest change from stopped to perforated: beside the limit that residual
/// velocities point to, and in the middle where two runs have not halved the bracket.
///
/// # Errors
/// Those of `shoot`, which are not for reasons that a sample carries.
pub(super) fn search<T: Send + HasResidual>(
    range: Range,
    tolerance: Tolerance,
    intervals: u32,
    shoot: &(dyn Fn(f64) -> Result<Sample<T>, Error> + Sync),
) -> Result<Samples<T>, Error> {
    let mut samples: Samples<T> = (0..=intervals)
        .into_par_iter()
        .map(|i| shoot(range.at(f64::from(i) / f64::from(intervals))))
        .collect::<Result<_, _>>()?;
    let mut widths: Vec<f64> = Vec::new();
    while widths.len() < MOST_RUNS {
        let Some([low, high]) = wide_interval(&samples, tolerance) else {
            break;
        };
        let is_slow = widths
            .iter()
            .nth_back(1)
            .is_some_and(|before| high - low > 0.5 * before);
        widths.push(high - low);
        let beside = || beside_the_limit(&samples, [low, high], tolerance.at(high));
        let velocity = match is_slow {
            true => None,
            false => beside(),
        };
        let velocity = velocity.unwrap_or(0.5 * (low + high));
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

/// Ends of the interval to narrow [m/s], unless that is narrow enough. Where undecided runs lie in the bracket, the intervals at its two
/// ends are narrowed.
fn wide_interval<T>(samples: &[Sample<T>], tolerance: Tolerance) -> Option<[f64; 2]> {
    let (below, above) = bracket(samples)?;
    let ends = [[below, below + 1], [above - 1, above]];
    let ends = ends.map(|interval| interval.map(|i| samples[i].velocity));
    ends.into_iter().find(|[low, high]| {
        let middle = 0.5 * (low + high);
        high - low > tolerance.at(*high) && *low < middle && middle < *high
    })
}

/// A velocity within the tolerance [m/s] of the limit that the two lowest perforated runs point to: above it, then below. `None` where
/// they point out of the interval.
///
/// Above a limit the squares of residual velocities rise about linearly with the square of the impact velocity [recht1963].
fn beside_the_limit<T: HasResidual>(
    samples: &[Sample<T>],
    [low, high]: [f64; 2],
    tolerance: f64,
) -> Option<f64> {
    let (_, above) = bracket(samples)?;
    let [first, second] = samples.get(above..above + 2)? else {
        return None;
    };
    let squares = |sample: &Sample<T>| {
        let residual = sample.run.as_ref()?.residual()?;
        Some((sample.velocity.powi(2), residual.max(0.0).powi(2)))
    };
    let ((x1, y1), (x2, y2)) = (squares(first)?, squares(second)?);
    let square = x1 - y1 * (x2 - x1) / (y2 - y1);
    let limit = (y2 > y1 && square > 0.0).then(|| square.sqrt())?;
    // Two runs on either side, this far from the limit, enclose it within the tolerance.
    let margin = 0.45 * tolerance;
    let beside = match limit + margin < high {
        true => limit + margin,
        false => limit - margin,
    };
    (low < beside && beside < high).then_some(beside)
}

#[cfg(test)]
mod tests {
    use super::*;

    impl HasResidual for () {
        fn residual(&self) -> Option<f64> {
            None
        }
    }

    impl HasResidual for f64 {
        fn residual(&self) -> Option<f64> {
            Some(*self)
        }
    }

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

    fn velocities<T>(samples: &Samples<T>) -> Option<(f64, f64)> {
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

    /// Residual velocities of the form of Lambert and Jonas: those of Recht and Ipson (p = 2) need two runs beside the limit. A jump at the
    /// limit points below it.
    #[test]
    fn residual_velocities_lead_to_the_limit() {
        for (p, jump, most) in [(2.0, 0.0, 2), (1.6, 0.0, 8), (3.7, 0.0, 8), (2.0, 90.0, 12)] {
            for limit in [0.1, 184.5, 699.98, 1499.9] {
                let range = Range {
                    from: 0.0,
                    to: 1600.0,
                };
                let residual =
                    |v: f64| jump + 0.8 * (v.powf(p) - f64::powf(limit, p)).powf(1.0 / p);
                let shoot = |velocity: f64| {
                    Ok(Sample {
                        velocity,
                        passage: over(limit)(velocity),
                        run: (velocity > limit).then(|| residual(velocity)),
                    })
                };
                let samples = search(range, Tolerance::Absolute(0.1), 16, &shoot).unwrap();
                let (low, high) = velocities(&samples).unwrap();
                assert!(low <= limit && limit < high, "{limit}: {low} to {high}");
                assert!(high - low <= 0.1);
                // Halving alone takes ten.
                let runs = samples.len() - 17;
                assert!(runs <= most, "{p} {jump} {limit}: {runs}");
            }
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
