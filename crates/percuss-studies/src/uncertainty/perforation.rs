//! Probability of perforation.

use serde::Serialize;

use super::statistics::SCORE_95;
use crate::outcome::Outcome;

/// Number of perforations, and the probability of perforation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Perforation {
    /// Runs with perforation.
    pub perforated: usize,
    /// Runs that were stopped.
    pub stopped: usize,
    /// Runs of which it cannot be said: those that failed among them.
    pub undecided: usize,
    /// Part of the decided runs with perforation.
    pub probability: f64,
    /// Lower end of its 95 % interval.
    pub low: f64,
    /// Upper end of its 95 % interval.
    pub high: f64,
}

impl Perforation {
    /// What outcomes come to; `None` when none of them is decided.
    pub fn of(outcomes: impl Iterator<Item = Outcome>) -> Option<Self> {
        let [mut perforated, mut stopped, mut undecided] = [0; 3];
        for outcome in outcomes {
            match outcome.perforated() {
                Some(true) => perforated += 1,
                Some(false) => stopped += 1,
                None => undecided += 1,
            }
        }
        let decided = perforated + stopped;
        if decided == 0 {
            return None;
        }
        let (low, high) = wilson(perforated, decided);
        Some(Self {
            perforated,
            stopped,
            undecided,
            probability: perforated as f64 / decided as f64,
            low,
            high,
        })
    }
}

/// The 95 % score interval of a proportion [wilson1927].
fn wilson(hits: usize, count: usize) -> (f64, f64) {
    let (n, p, z2) = (
        count as f64,
        hits as f64 / count as f64,
        SCORE_95 * SCORE_95,
    );
    let middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = SCORE_95 * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt() / (1.0 + z2 / n);
    // At the ends the two parts are equal, up to rounding.
    let low = if hits == 0 { 0.0 } else { middle - half };
    let high = if hits == count { 1.0 } else { middle + half };
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked numbers, computed with a score of 1.96.
    #[test]
    fn intervals_are_the_known_ones() {
        for (hits, count, low, high) in [
            (0, 1, 0.0, 0.793_456_7),
            (1, 11, 0.016_231_8, 0.377_364_6),
            (10, 100, 0.055_228_5, 0.174_367_3),
            (50, 100, 0.403_829_8, 0.596_170_2),
            (100, 100, 0.963_005_2, 1.0),
        ] {
            let found = wilson(hits, count);
            assert!(
                (found.0 - low).abs() < 2e-5 && (found.1 - high).abs() < 2e-5,
                "{found:?}"
            );
        }
    }

    #[test]
    fn only_decided_runs_count() {
        use Outcome::{AtRest, Failed, NotApplicable, OutOfTime, Perforated, Rebounded};
        let outcomes = [
            Perforated,
            AtRest,
            Rebounded,
            Failed,
            NotApplicable,
            OutOfTime,
            AtRest,
        ];
        let found = Perforation::of(outcomes.into_iter()).unwrap();
        assert_eq!(
            (found.perforated, found.stopped, found.undecided),
            (1, 3, 3)
        );
        assert_eq!(found.probability, 0.25);
        assert_eq!(Perforation::of([Failed].into_iter()), None);
    }
}
