//! Estimate of the model error of a depth, from the benchmark cases that are most like a case.

use std::{collections::HashMap, sync::LazyLock};

use serde::Serialize;

use super::{
    Candidate, ErrorRecord,
    conformal::{Coverage, Experience},
    design,
    features::Features,
};
use crate::{
    Scenario,
    case::{Nose, RearFaceCondition, TargetResistanceModel},
    chain,
    model::Model,
    regime::{Regime, TargetKind},
    scenario::TargetBody,
    statistics::{quantile, sorted},
};

/// The stored results of the benchmark, for the grid and for the spread design.
const BUILT_IN: [&str; 2] = [
    include_str!("../../data/model-error/errors.csv"),
    include_str!("../../data/model-error/errors-spread.csv"),
];

static RECORDS: LazyLock<Vec<ErrorRecord>> = LazyLock::new(|| {
    let read = |text: &str| -> Vec<ErrorRecord> {
        let rows = csv::Reader::from_reader(text.as_bytes()).into_deserialize();
        rows.collect::<Result<_, _>>()
            .expect("the built-in results are valid")
    };
    BUILT_IN.iter().copied().flat_map(read).collect()
});

/// The stored results by candidate, calibrated, for estimates that cost next to nothing.
static INDEX: LazyLock<HashMap<&str, Experience>> = LazyLock::new(|| {
    let mut index: HashMap<&str, Vec<&ErrorRecord>> = HashMap::new();
    for record in records() {
        index.entry(&record.candidate).or_default().push(record);
    }
    let calibrated = index.into_iter();
    calibrated
        .filter_map(|(name, records)| Some((name, Experience::of(&records)?)))
        .collect()
});

/// Error to expect of a depth against the axisymmetric reference; plain numbers, 0.1 for 10 % too deep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelErrorEstimate {
    /// Median of the errors of the most similar cases.
    pub median: f64,
    /// Lower end of the 80 % interval.
    pub low: f64,
    /// Upper end of the 80 % interval.
    pub high: f64,
    /// How many cases that rests on.
    pub cases: usize,
    /// Whether the case is farther from all of them than they are from each other: its error may be larger.
    pub outside: bool,
}

impl ModelErrorEstimate {
    /// Median and 10th and 90th percentile of errors, of which there is one at least: an interval without a calibration.
    pub(crate) fn of(errors: impl IntoIterator<Item = f64>) -> Self {
        let errors = sorted(errors);
        Self {
            median: quantile(&errors, 0.5),
            low: quantile(&errors, 0.1),
            high: quantile(&errors, 0.9),
            cases: errors.len(),
            outside: false,
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

/// Coverage and width of the estimates of a candidate where its pairs of materials are left out in turn.
pub fn coverage(candidate: &str) -> Option<Coverage> {
    let own = records().iter().filter(|r| r.candidate == candidate);
    Coverage::of(&own.collect::<Vec<_>>())
}

/// Error to expect of a model's depth on a case; `None` where the design has too few cases like it: other noses, thin targets,
/// velocities or lengths beyond the design, options that are not in the benchmark.
pub fn estimate_error(
    model: &dyn Model,
    scenario: &Scenario,
    regime: &Regime,
) -> Option<ModelErrorEstimate> {
    let rod = &scenario.projectile;
    if !is_deep(model, scenario, regime.target) || rod.nose != Nose::Flat || scenario.is_heated() {
        return None;
    }
    let length = scenario.projectile.length / scenario.projectile.diameter;
    if !design::VELOCITY_RANGE.contains(&scenario.impact_velocity)
        || !design::LENGTH_RANGE.contains(&length)
    {
        return None;
    }
    let candidate = Candidate::of(model, scenario)?;
    let experience = INDEX.get(candidate.name)?;
    Some(experience.estimate(&Features::of(scenario)?))
}

/// Whether a target acts like the semi-infinite ones of the design, as long as the crater does not reach the rear face.
///
/// Over the design's pairs at L/D 3, 300, 600 and 1000 m/s, the depth by the expanding cavity over that by `axi` is 0.84 to 1.07 times what it
/// is on semi-infinite targets in plates of 1 to 5 diameters on a fixed rear face, and 0.87 to 1.11 times with a free one from 3 diameters
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
