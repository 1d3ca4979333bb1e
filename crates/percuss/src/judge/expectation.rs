//! The error to expect of a depth, from the shots of the design that are most like a case.

use std::sync::LazyLock;

use serde::Serialize;

use super::{Contender, Verdict, design};
use crate::{
    Scenario,
    case::Nose,
    model::Model,
    regime::{ProjectileRegime, Regime, TargetKind},
};

/// The stored judgement.
const BUILT_IN: &str = include_str!("../../data/judge/verdicts.csv");

static VERDICTS: LazyLock<Vec<Verdict>> = LazyLock::new(|| {
    let mut reader = csv::Reader::from_reader(BUILT_IN.as_bytes());
    reader
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("the built-in judgement is valid")
});

/// Shots that an expectation rests on, at most.
const NEAREST: usize = 12;
/// Fewer shots of a regime say nothing.
const FEWEST: usize = 5;

/// Error to expect of a depth against the axisymmetric reference; plain numbers, 0.1 for 10 % too deep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Expectation {
    /// Median of the errors.
    pub median: f64,
    /// A tenth of the errors lie below.
    pub low: f64,
    /// A tenth of the errors lie above.
    pub high: f64,
    /// How many shots that rests on.
    pub shots: usize,
}

/// The stored judgement.
pub fn verdicts() -> &'static [Verdict] {
    &VERDICTS
}

/// Error to expect of a model's depth on a case; `None` where the design has too few shots like it: other noses, thin targets,
/// speeds or lengths beyond the design, options that were not judged.
pub fn expectation(model: &dyn Model, scenario: &Scenario, regime: &Regime) -> Option<Expectation> {
    let thick = matches!(
        regime.target,
        TargetKind::SemiInfinite | TargetKind::ThickPlate
    );
    if !thick || scenario.projectile.nose != Nose::Flat || scenario.projectile.temperature.is_some()
    {
        return None;
    }
    let length = scenario.projectile.length / scenario.projectile.diameter;
    let inside = |value: f64, of: &[f64]| {
        let (first, last) = (of.first().copied(), of.last().copied());
        first
            .zip(last)
            .is_some_and(|(first, last)| (first..=last).contains(&value))
    };
    if !inside(scenario.impact_speed, design::SPEEDS) || !inside(length, design::LENGTHS) {
        return None;
    }
    let contender = Contender::of(model, scenario)?;
    among(
        verdicts(),
        contender.name,
        regime.projectile,
        scenario.impact_speed,
        length,
    )
}

fn among(
    verdicts: &[Verdict],
    contender: &str,
    regime: ProjectileRegime,
    speed: f64,
    length_to_diameter: f64,
) -> Option<Expectation> {
    let distance = |verdict: &Verdict| {
        let speeds = (verdict.impact_velocity_m_s / speed).ln();
        let lengths = (verdict.length_to_diameter / length_to_diameter).ln();
        speeds.hypot(lengths)
    };
    let mut near: Vec<(f64, f64)> = verdicts
        .iter()
        .filter(|verdict| verdict.contender == contender && verdict.regime == regime)
        .map(|verdict| (distance(verdict), verdict.error()))
        .collect();
    if near.len() < FEWEST {
        return None;
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    near.truncate(NEAREST);
    let mut errors: Vec<f64> = near.iter().map(|(_, error)| *error).collect();
    errors.sort_by(f64::total_cmp);
    Some(Expectation {
        median: quantile(&errors, 0.5),
        low: quantile(&errors, 0.1),
        high: quantile(&errors, 0.9),
        shots: errors.len(),
    })
}

/// Quantile of numbers in order, straight between neighbours.
pub fn quantile(sorted: &[f64], part: f64) -> f64 {
    let place = part * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}
