//! Estimate of the model error of a depth, from the benchmark cases that are most like a case.

use std::{collections::HashMap, sync::LazyLock};

use serde::Serialize;

use super::{Candidate, ErrorRecord, design};
use crate::{
    Scenario,
    case::{Nose, RearFaceCondition, TargetResistanceModel},
    chain,
    model::Model,
    regime::{ProjectileRegime, Regime, TargetKind},
    scenario::TargetBody,
    statistics::{quantile, sorted},
};

/// The stored results of the benchmark.
const BUILT_IN: &str = include_str!("../../data/model-error/errors.csv");

static RECORDS: LazyLock<Vec<ErrorRecord>> = LazyLock::new(|| {
    let mut reader = csv::Reader::from_reader(BUILT_IN.as_bytes());
    reader
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("the built-in results are valid")
});

/// The stored results by candidate and regime, for expectations that cost next to nothing.
static INDEX: LazyLock<HashMap<(&str, ProjectileRegime), Vec<&ErrorRecord>>> =
    LazyLock::new(|| {
        let mut index: HashMap<_, Vec<&ErrorRecord>> = HashMap::new();
        for record in records() {
            let key = (record.candidate.as_str(), record.regime);
            index.entry(key).or_default().push(record);
        }
        index
    });

/// Cases that an expectation rests on, at most.
const NEAREST: usize = 12;
/// Fewer cases of a regime say nothing.
const FEWEST: usize = 5;

/// Error to expect of a depth against the axisymmetric reference; plain numbers, 0.1 for 10 % too deep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelErrorEstimate {
    /// Median of the errors.
    pub median: f64,
    /// A tenth of the errors lie below.
    pub low: f64,
    /// A tenth of the errors lie above.
    pub high: f64,
    /// How many cases that rests on.
    pub cases: usize,
}

impl ModelErrorEstimate {
    /// Median and 10th and 90th percentile of errors, of which there is one at least.
    pub(crate) fn of(errors: impl IntoIterator<Item = f64>) -> Self {
        let errors = sorted(errors);
        Self {
            median: quantile(&errors, 0.5),
            low: quantile(&errors, 0.1),
            high: quantile(&errors, 0.9),
            cases: errors.len(),
        }
    }

    /// The numbers in words: `−32 % (−86 … +14 %)`.
    pub fn describe(&self) -> String {
        let signed = |error: f64| match (100.0 * error).round() {
            0.0 => "0".to_owned(),
            percent => format!("{percent:+.0}").replace('-', "\u{2212}"),
        };
        let [median, low, high] = [self.median, self.low, self.high].map(signed);
        format!("{median} % ({low} … {high} %)")
    }
}

/// The stored results of the benchmark.
pub fn records() -> &'static [ErrorRecord] {
    &RECORDS
}

/// Error to expect of a model's depth on a case; `None` where the design has too few cases like it: other noses, thin targets,
/// velocities or lengths beyond the design, options that are not in the benchmark.
pub fn estimate_error(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
) -> Option<ModelErrorEstimate> {
    let rod = &scenario.projectile;
    let room = rod.material.room_temperature.si();
    let heated = rod
        .temperature
        .is_some_and(|temperature| temperature != room);
    if !is_deep(model, scenario, regime.target) || rod.nose != Nose::Flat || heated {
        return None;
    }
    let length = scenario.projectile.length / scenario.projectile.diameter;
    let inside = |value: f64, of: &[f64]| {
        let (first, last) = (of.first().copied(), of.last().copied());
        first
            .zip(last)
            .is_some_and(|(first, last)| (first..=last).contains(&value))
    };
    if !inside(scenario.impact_velocity, design::VELOCITIES) || !inside(length, design::LENGTHS) {
        return None;
    }
    let candidate = Candidate::of(model, scenario)?;
    let records = INDEX.get(&(candidate.name, regime.projectile))?;
    among(records, scenario.impact_velocity, length)
}

/// Whether a target acts like the semi-infinite ones of the design, as long as the crater does not reach the rear face.
///
/// Over the design's pairs at L/D 3, 300, 600 and 1000 m/s, the depth by the expanding cavity over that by `axi` is 0.85 to 1.09 times what it
/// is on semi-infinite targets in plates of 1 to 5 diameters on a fixed rear face, and 0.80 to 1.08 times with a free one from 3 diameters
/// on. A column does not follow.
fn is_deep(model: &dyn Model, scenario: &Scenario, target: TargetKind) -> bool {
    let cavity = model.name() == "chain"
        && chain::resistance_model_in_use(scenario) == Some(TargetResistanceModel::ExpandingCavity);
    match target {
        TargetKind::SemiInfinite | TargetKind::ThickPlate => true,
        TargetKind::Plate if cavity => {
            let fewest = match scenario.target {
                TargetBody::Layers {
                    back_face: RearFaceCondition::Free,
                    ..
                } => 3.0,
                _ => 1.0,
            };
            let thickness = scenario.target_thickness();
            thickness.is_some_and(|h| h >= fewest * scenario.projectile.diameter)
        }
        _ => false,
    }
}

/// The error to expect from records of one candidate and regime.
fn among(
    records: &[&ErrorRecord],
    velocity: f64,
    length_to_diameter: f64,
) -> Option<ModelErrorEstimate> {
    let distance = |record: &ErrorRecord| {
        let velocities = (record.impact_velocity_m_s / velocity).ln();
        let lengths = (record.length_to_diameter / length_to_diameter).ln();
        velocities.hypot(lengths)
    };
    let mut near: Vec<(f64, f64)> = records
        .iter()
        .map(|record| (distance(record), record.error()))
        .collect();
    if near.len() < FEWEST {
        return None;
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    near.truncate(NEAREST);
    Some(ModelErrorEstimate::of(near.iter().map(|(_, error)| *error)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(velocity: f64, error: f64) -> ErrorRecord {
        ErrorRecord {
            candidate: "made up".to_owned(),
            projectile: "a".to_owned(),
            target: "b".to_owned(),
            length_to_diameter: 3.0,
            impact_velocity_m_s: velocity,
            regime: ProjectileRegime::Deforming,
            depth_of_penetration_mm: 1.0 + error,
            reference_depth_mm: 1.0,
            reference_uncertainty_mm: 0.0,
        }
    }

    #[test]
    fn the_most_similar_cases_decide() {
        let slow = (0..12).map(|i| record(150.0, -0.5 + 0.01 * f64::from(i)));
        let fast = (0..12).map(|i| record(1500.0, 0.5 + 0.01 * f64::from(i)));
        let all: Vec<ErrorRecord> = slow.chain(fast).collect();
        let all: Vec<&ErrorRecord> = all.iter().collect();
        let expected = among(&all, 200.0, 3.0).unwrap();
        assert_eq!(expected.cases, 12);
        assert!((expected.median + 0.445).abs() < 1e-12, "{expected:?}");
        assert_eq!(
            expected.describe(),
            "\u{2212}44 % (\u{2212}49 … \u{2212}40 %)"
        );
        assert!(among(&all, 1200.0, 3.0).unwrap().median > 0.5);
        assert_eq!(among(&all[..FEWEST - 1], 200.0, 3.0), None);
    }
}
