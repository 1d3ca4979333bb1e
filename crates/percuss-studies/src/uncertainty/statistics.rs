//! Mean, standard deviation and percentiles of a sample, with intervals.

use serde::Serialize;

use crate::statistics::{quantile, sorted};

/// Percentiles that are given of everything.
pub const PERCENTS: [f64; 7] = [1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0];
/// Score within which a normal variable lies with a probability of 95 %.
pub(super) const SCORE_95: f64 = 1.959_963_984_540_054;

/// A number with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

/// A percentile with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Percentile {
    /// Which one: 95 lies above 95 % of the runs.
    pub percent: f64,
    /// Its value, straight between neighbours of the sample.
    pub value: f64,
    /// Lower end of the interval; null where the sample is too small to tell.
    pub low: Option<f64>,
    /// Upper end of the interval; null where the sample is too small to tell.
    pub high: Option<f64>,
}

/// Statistics of the runs that have a value. Intervals are those of independent draws; scrambled Sobol' points err less.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Statistics {
    /// Runs with a value.
    pub runs: usize,
    /// Mean.
    pub mean: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
    /// Standard deviation.
    pub standard_deviation: f64,
    /// Smallest value.
    pub smallest: f64,
    /// Largest value.
    pub largest: f64,
    /// Percentiles, rising.
    pub percentiles: Vec<Percentile>,
}

impl Statistics {
    /// Those of a sample; `None` when it is empty.
    pub fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let sorted = sorted(values);
        let (&smallest, &largest) = (sorted.first()?, sorted.last()?);
        let count = sorted.len() as f64;
        let mean = sorted.iter().sum::<f64>() / count;
        let squares: f64 = sorted.iter().map(|value| (value - mean).powi(2)).sum();
        // A single value has no spread that could be told.
        let deviation = (squares / (count - 1.0).max(1.0)).sqrt();
        Some(Self {
            runs: sorted.len(),
            mean,
            standard_error: deviation / count.sqrt(),
            standard_deviation: deviation,
            smallest,
            largest,
            percentiles: PERCENTS.iter().map(|p| percentile(&sorted, *p)).collect(),
        })
    }

    /// One of [`PERCENTS`].
    ///
    /// # Panics
    /// When it is none of them.
    pub fn percentile(&self, percent: f64) -> &Percentile {
        let found = self.percentiles.iter().find(|p| p.percent == percent);
        found.expect("one of PERCENTS")
    }
}

/// A percentile of values in order. Its interval lies between two of them: the number of draws below the true percentile is
/// binomial, whatever the distribution is, and is taken as normal.
fn percentile(sorted: &[f64], percent: f64) -> Percentile {
    let (count, part) = (sorted.len() as f64, percent / 100.0);
    let half = SCORE_95 * (count * part * (1.0 - part)).sqrt();
    let (low, high) = ((count * part - half).floor(), (count * part + half).ceil());
    let at = |rank: f64| (rank >= 1.0 && rank <= count).then(|| sorted[rank as usize - 1]);
    Percentile {
        percent,
        value: quantile(sorted, part),
        low: at(low),
        high: at(high + 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_whole_numbers_are_exact() {
        let found = Statistics::of((0..=1000).rev().map(f64::from)).unwrap();
        assert_eq!((found.runs, found.mean), (1001, 500.0));
        // Of 0 to n: n (n + 2) / 12, with n - 1 degrees of freedom.
        let variance = 1001.0 * 1002.0 / 12.0_f64;
        assert!((found.standard_deviation - variance.sqrt()).abs() < 1e-10);
        assert!((found.standard_error - (variance / 1001.0).sqrt()).abs() < 1e-12);
        for p in PERCENTS {
            assert!((found.percentile(p).value - 10.0 * p).abs() < 1e-10);
        }
        // 500.5 ± 1.96 · √250.25: ranks 469 and 533, of values counted from 0.
        let median = found.percentile(50.0);
        assert_eq!((median.low, median.high), (Some(468.0), Some(532.0)));
        assert_eq!((found.smallest, found.largest), (0.0, 1000.0));
    }

    #[test]
    fn a_small_sample_does_not_bound_its_tails() {
        let found = Statistics::of((0..20).map(f64::from)).unwrap();
        assert_eq!(found.percentile(1.0).low, None);
        assert_eq!(found.percentile(99.0).high, None);
        assert!(found.percentile(50.0).low.is_some());
        let one = Statistics::of(std::iter::once(3.0)).unwrap();
        assert_eq!((one.mean, one.standard_deviation), (3.0, 0.0));
        assert_eq!(Statistics::of(std::iter::empty()), None);
    }

    /// Intervals of independent draws hold the true percentile about as often as they say.
    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        use crate::sweep::{bits, stream};
        let (mut held, tries) = (0, 1000);
        for i in 0..tries {
            let stream = stream(5, 0, i);
            let draw = |j: u64| (bits(stream, j) >> 11) as f64 / (1_u64 << 53) as f64;
            let found = Statistics::of((0..400).map(draw)).unwrap();
            let of = found.percentile(75.0);
            held += u32::from(of.low.unwrap() <= 0.75 && 0.75 <= of.high.unwrap());
        }
        let part = f64::from(held) / tries as f64;
        assert!((0.94..0.985).contains(&part), "{part}");
    }
}
