//! Intervals of the model error that cover: conformal prediction by pair of materials.
//!
//! The logarithm of model over reference is predicted by the most similar cases: their weighted median, and their mean absolute
//! deviation as a scale. Each case gets a score: the distance of its own logarithm from what the cases of the *other* pairs predict, over
//! the scale. The interval of a new case has the half width `q` scales, where `q` is the 80 % quantile of the scores, every pair with
//! the same weight and the level raised by one pair (CV+, hierarchical: \[barber2021\], \[dunn2023\]). So a new pair of materials is
//! treated as each known one was.

use serde::Serialize;

use super::{ErrorRecord, ModelErrorEstimate, features::Features};
use crate::statistics::{mean, quantile, sorted};

/// Cases that a prediction rests on, at most.
const NEAREST: usize = 12;
/// With fewer pairs of materials there is no interval.
const FEWEST_PAIRS: usize = 8;
/// Probability of the interval.
const LEVEL: f64 = 0.8;
/// Least scale: a few similar cases may agree by chance.
const LEAST_SCALE: f64 = 0.08;
/// Least depth over that of the reference, below which a model has none.
const LEAST_RATIO: f64 = 0.02;
/// Weight of the farthest of the cases, where the nearest has 1.
const FARTHEST: f64 = 0.1;
/// Part of the benchmark cases that have a neighbour of another pair within the distance beyond which a case is outside.
const NEIGHBOURLY: f64 = 0.95;

/// A benchmark case: pair of materials, place and logarithm of model over reference.
#[derive(Debug, Clone, Copy)]
struct Case {
    pair: usize,
    features: Features,
    error: f64,
}

/// Prediction of the logarithm of model over reference.
#[derive(Debug, Clone, Copy)]
struct Prediction {
    centre: f64,
    scale: f64,
    cases: usize,
    /// Distance of the nearest case.
    nearest: f64,
}

/// The benchmark cases of one candidate, calibrated.
#[derive(Debug)]
pub(super) struct Experience {
    cases: Vec<Case>,
    /// Half width of the interval, in scales.
    width: f64,
    /// Distance of the nearest case beyond which a case is outside.
    reach: f64,
}

/// Estimates for the cases of each pair of materials by the other pairs alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Coverage {
    /// Pairs of materials.
    pub pairs: usize,
    /// Cases.
    pub cases: usize,
    /// Part of the cases in the interval, mean over the pairs.
    pub coverage: f64,
    /// Median factor from the centre of the interval to its end.
    pub factor: f64,
}

fn cases_of(records: &[&ErrorRecord]) -> (Vec<Case>, usize) {
    let mut pairs: Vec<(&str, &str)> = records
        .iter()
        .map(|r| (&*r.projectile, &*r.target))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    let case = |record: &&ErrorRecord| {
        let own = (&*record.projectile, &*record.target);
        Some(Case {
            pair: pairs.iter().position(|pair| *pair == own)?,
            features: Features::of_record(record),
            error: (1.0 + record.error()).max(LEAST_RATIO).ln(),
        })
    };
    (records.iter().filter_map(case).collect(), pairs.len())
}

/// Prediction at a place by the nearest cases, of which there is one at least.
fn predict<'a>(cases: impl Iterator<Item = &'a Case>, at: &Features) -> Prediction {
    let mut near: Vec<(f64, f64)> = cases
        .map(|case| (case.features.distance(at), case.error))
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    near.truncate(NEAREST);
    let (nearest, farthest) = match near.as_slice() {
        [] => (f64::INFINITY, f64::INFINITY),
        [first, ..] => (first.0, near[near.len() - 1].0),
    };
    let part = |distance: f64| match farthest > 0.0 {
        true => distance / farthest,
        false => 0.0,
    };
    let mut weighted: Vec<(f64, f64)> = near
        .iter()
        .map(|(distance, error)| (*error, 1.0 - (1.0 - FARTHEST) * part(*distance).powi(2)))
        .collect();
    let centre = weighted_quantile(&mut weighted, 0.5);
    let total: f64 = weighted.iter().map(|(_, weight)| weight).sum();
    let deviations = weighted
        .iter()
        .map(|(error, weight)| weight * (error - centre).abs());
    Prediction {
        centre,
        scale: LEAST_SCALE + deviations.sum::<f64>() / total,
        cases: near.len(),
        nearest,
    }
}

/// Smallest value that has at least a part of the weight at or below it.
fn weighted_quantile(values: &mut [(f64, f64)], part: f64) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = values.iter().map(|(_, weight)| weight).sum();
    let mut sum = 0.0;
    for (value, weight) in values.iter() {
        sum += weight;
        if sum >= part * total {
            return *value;
        }
    }
    values.last().map_or(f64::INFINITY, |last| last.0)
}

/// Half width of the interval in scales, by the pairs except one, and distances of the nearest cases of other pairs.
fn calibrate(cases: &[Case], pairs: usize, without: Option<usize>) -> (f64, Vec<f64>) {
    let used = || cases.iter().filter(|case| Some(case.pair) != without);
    let of_pair = |pair: usize| used().filter(|case| case.pair == pair).count();
    let mut scores = Vec::new();
    let mut distances = Vec::new();
    for case in used() {
        let others = used().filter(|other| other.pair != case.pair);
        let prediction = predict(others, &case.features);
        let score = (case.error - prediction.centre).abs() / prediction.scale;
        scores.push((score, 1.0 / of_pair(case.pair) as f64));
        distances.push(prediction.nearest);
    }
    let count = pairs - usize::from(without.is_some());
    let level = LEVEL * (1.0 + 1.0 / count as f64);
    (weighted_quantile(&mut scores, level.min(1.0)), distances)
}

impl Experience {
    /// The cases of a candidate; `None` with too few pairs of materials.
    pub(super) fn of(records: &[&ErrorRecord]) -> Option<Self> {
        let (cases, pairs) = cases_of(records);
        if pairs < FEWEST_PAIRS {
            return None;
        }
        let (width, distances) = calibrate(&cases, pairs, None);
        Some(Self {
            reach: quantile(&sorted(distances), NEIGHBOURLY),
            cases,
            width,
        })
    }

    /// Error to expect of a case.
    pub(super) fn estimate(&self, at: &Features) -> ModelErrorEstimate {
        let prediction = predict(self.cases.iter(), at);
        let end =
            |side: f64| (prediction.centre + side * self.width * prediction.scale).exp() - 1.0;
        ModelErrorEstimate {
            median: prediction.centre.exp() - 1.0,
            low: end(-1.0),
            high: end(1.0),
            cases: prediction.cases,
            outside: prediction.nearest > self.reach,
        }
    }
}

impl Coverage {
    /// Leaves each pair of materials out of prediction and calibration, and counts its cases in their intervals.
    pub(super) fn of(records: &[&ErrorRecord]) -> Option<Self> {
        let (cases, pairs) = cases_of(records);
        if pairs <= FEWEST_PAIRS {
            return None;
        }
        let (mut covered, mut widths) = (Vec::new(), Vec::new());
        for pair in 0..pairs {
            let (width, _) = calibrate(&cases, pairs, Some(pair));
            let others = || cases.iter().filter(|case| case.pair != pair);
            let own: Vec<bool> = cases
                .iter()
                .filter(|case| case.pair == pair)
                .map(|case| {
                    let prediction = predict(others(), &case.features);
                    widths.push(width * prediction.scale);
                    (case.error - prediction.centre).abs() <= width * prediction.scale
                })
                .collect();
            let inside = own.iter().filter(|inside| **inside).count();
            covered.push(inside as f64 / own.len() as f64);
        }
        Some(Self {
            pairs,
            cases: cases.len(),
            coverage: mean(&covered),
            factor: quantile(&sorted(widths), 0.5).exp(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::regime::ProjectileRegime;

    /// Uniform numbers of a congruential generator.
    struct Uniform(u64);

    impl Uniform {
        fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    fn record(pair: usize, place: [f64; 4], error: f64) -> ErrorRecord {
        let [velocity, length, strength, density] = place;
        ErrorRecord {
            candidate: "made up".to_owned(),
            projectile: format!("{pair}"),
            target: "b".to_owned(),
            strength_ratio: strength,
            density_ratio: density,
            length_to_diameter: length,
            impact_velocity_m_s: velocity,
            regime: ProjectileRegime::Deforming,
            depth_of_penetration_mm: 1.0 + error,
            reference_depth_mm: 1.0,
            reference_uncertainty_mm: 0.0,
        }
    }

    fn made_up(pairs: usize, noise: f64, uniform: &mut Uniform) -> Vec<ErrorRecord> {
        let mut records = Vec::new();
        for pair in 0..pairs {
            let (strength, density) = (
                10.0_f64.powf(2.0 * uniform.next() - 1.0),
                1.0 + uniform.next(),
            );
            let of_pair = noise * (uniform.next() - 0.5);
            for _ in 0..4 {
                let velocity = 100.0 * 25.0_f64.powf(uniform.next());
                let error = 0.2 * strength.ln() + of_pair + noise * (uniform.next() - 0.5);
                let place = [velocity, 1.0 + 19.0 * uniform.next(), strength, density];
                records.push(record(pair, place, error.exp() - 1.0));
            }
        }
        records
    }

    #[test]
    fn the_most_similar_cases_decide_and_a_far_one_is_outside() {
        let slow = (0..12).map(|i| record(i, [150.0, 3.0, 1.0, 1.0], -0.5));
        let fast = (0..12).map(|i| record(i, [1500.0, 3.0, 1.0, 1.0], 0.5));
        let all: Vec<ErrorRecord> = slow.chain(fast).collect();
        let all: Vec<&ErrorRecord> = all.iter().collect();
        let experience = Experience::of(&all).unwrap();
        let near = record(0, [160.0, 3.0, 1.0, 1.0], 0.0);
        let found = experience.estimate(&Features::of_record(&near));
        assert!(
            (found.median + 0.5).abs() < 1e-12 && found.cases == 12,
            "{found:?}"
        );
        assert!(
            found.outside,
            "all others have a neighbour at their own place"
        );
        let here = record(0, [150.0, 3.0, 1.0, 1.0], 0.0);
        assert!(!experience.estimate(&Features::of_record(&here)).outside);
        assert!(Experience::of(&all[..7]).is_none());
    }

    /// New pairs of the same kind lie in the interval in 80 % of the cases, within the scatter of 30 × 20 pairs, whatever the noise.
    #[test]
    fn intervals_cover_new_pairs() {
        for noise in [0.05, 0.3, 1.0] {
            let mut uniform = Uniform(7);
            let mut parts = Vec::new();
            for _ in 0..30 {
                let known = made_up(25, noise, &mut uniform);
                let known: Vec<&ErrorRecord> = known.iter().collect();
                let experience = Experience::of(&known).unwrap();
                for case in made_up(20, noise, &mut uniform) {
                    let found = experience.estimate(&Features::of_record(&case));
                    let inside = (found.low..=found.high).contains(&case.error());
                    parts.push(f64::from(u8::from(inside)));
                }
            }
            let part = mean(&parts);
            assert!((0.77..=0.89).contains(&part), "{noise}: {part}");
        }
    }
}
