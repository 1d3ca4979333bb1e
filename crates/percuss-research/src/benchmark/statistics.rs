//! Errors of every candidate, by what may decide them.

use percuss::{
    model_error::{
        ErrorRecord, candidates,
        design::{LENGTHS, VELOCITIES},
    },
    regime::ProjectileRegime,
    statistics::{quantile, sorted},
};
use serde::Serialize;

use super::PAIRS;

/// Uncertainty over depth up to which a reference is called sharp: well below the errors that are computed with it.
pub const SHARP: f64 = 0.1;

/// Magnitude of a relative error up to which a depth is called right.
pub const CLOSE: f64 = 0.25;

/// What verdicts are grouped by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Grouping {
    /// All of a candidate together.
    All,
    /// Impact speed.
    Speed,
    /// Length of the projectile over its diameter.
    Length,
    /// What the projectile does.
    Regime,
    /// Materials.
    Pair,
    /// How well the reference itself is known.
    Reference,
}

/// Errors of a candidate in a group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Group {
    /// Name of the candidate.
    pub candidate: &'static str,
    /// What it is grouped by.
    pub grouping: Grouping,
    /// The group.
    pub value: String,
    /// Its errors.
    #[serde(flatten)]
    pub errors: Errors,
}

/// Statistics of relative errors: plain numbers, positive where the candidate goes too deep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Errors {
    /// How many shots.
    pub count: usize,
    /// Median.
    pub median: f64,
    /// A tenth lies below.
    pub low: f64,
    /// A tenth lies above.
    pub high: f64,
    /// Median of the magnitudes.
    pub median_absolute: f64,
    /// Part of the shots with an error of at most [`CLOSE`], either way.
    pub within_25_percent: f64,
}

impl Errors {
    /// Statistics of errors; `None` without any.
    pub fn of(errors: impl IntoIterator<Item = f64>) -> Option<Self> {
        let errors = sorted(errors);
        if errors.is_empty() {
            return None;
        }
        let sizes = sorted(errors.iter().map(|error| error.abs()));
        let close = sizes.iter().filter(|size| **size <= CLOSE).count();
        Some(Self {
            count: errors.len(),
            median: quantile(&errors, 0.5),
            low: quantile(&errors, 0.1),
            high: quantile(&errors, 0.9),
            median_absolute: quantile(&sizes, 0.5),
            within_25_percent: close as f64 / errors.len() as f64,
        })
    }
}

impl Grouping {
    /// All of them.
    pub const ALL: &'static [Self] = &[
        Self::All,
        Self::Speed,
        Self::Length,
        Self::Regime,
        Self::Pair,
        Self::Reference,
    ];

    /// What groups are by, in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::All => "all shots",
            Self::Speed => "speed",
            Self::Length => "L/D",
            Self::Regime => "regime",
            Self::Pair => "materials",
            Self::Reference => "the reference's own uncertainty",
        }
    }

    /// The groups in their order.
    pub fn values(self) -> Vec<String> {
        match self {
            Self::All => vec!["all".to_owned()],
            Self::Speed => VELOCITIES.iter().map(|speed| speed_name(*speed)).collect(),
            Self::Length => LENGTHS.iter().map(|length| length_name(*length)).collect(),
            Self::Regime => ProjectileRegime::ALL
                .iter()
                .map(|regime| regime.describe().to_owned())
                .collect(),
            Self::Pair => PAIRS
                .iter()
                .map(|(projectile, target)| pair_name(projectile, target))
                .collect(),
            Self::Reference => [true, false].map(sharp_name).to_vec(),
        }
    }

    /// The group of a verdict.
    pub fn value(self, verdict: &ErrorRecord) -> String {
        match self {
            Self::All => "all".to_owned(),
            Self::Speed => speed_name(verdict.impact_velocity_m_s),
            Self::Length => length_name(verdict.length_to_diameter),
            Self::Regime => verdict.regime.describe().to_owned(),
            Self::Pair => pair_name(&verdict.projectile, &verdict.target),
            Self::Reference => sharp_name(is_sharp(verdict)),
        }
    }
}

/// Whether the reference of a shot is known within [`SHARP`].
pub fn is_sharp(verdict: &ErrorRecord) -> bool {
    verdict.reference_uncertainty_mm <= SHARP * verdict.reference_depth_mm
}

fn speed_name(speed: f64) -> String {
    format!("{speed} m/s")
}

fn length_name(length: f64) -> String {
    format!("L/D {length}")
}

/// A pair of materials in words.
pub fn pair_name(projectile: &str, target: &str) -> String {
    format!("{projectile} on {target}")
}

fn sharp_name(sharp: bool) -> String {
    let percent = 100.0 * SHARP;
    match sharp {
        true => format!("within {percent} %"),
        false => format!("over {percent} %"),
    }
}

/// Statistics of every candidate by a grouping; candidates and groups in their order, those without a verdict left out.
pub fn statistics(verdicts: &[ErrorRecord], grouping: Grouping) -> Vec<Group> {
    let values = grouping.values();
    candidates()
        .iter()
        .flat_map(|candidate| {
            let own: Vec<(String, f64)> = verdicts
                .iter()
                .filter(|verdict| verdict.candidate == candidate.name)
                .map(|verdict| (grouping.value(verdict), verdict.error()))
                .collect();
            let groups = values.iter().filter_map(|value| {
                let errors = own.iter().filter(|(of, _)| of == value).map(|(_, e)| *e);
                Some(Group {
                    candidate: candidate.name,
                    grouping,
                    value: value.clone(),
                    errors: Errors::of(errors)?,
                })
            });
            groups.collect::<Vec<_>>()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::Errors;

    #[test]
    fn statistics_of_known_numbers() {
        let errors = Errors::of([0.3, -0.1, 0.0, 0.2, -0.6]).unwrap();
        assert_eq!((errors.count, errors.median), (5, 0.0));
        assert!((errors.median_absolute - 0.2).abs() < 1e-15);
        assert!((errors.low + 0.4).abs() < 1e-15 && (errors.high - 0.26).abs() < 1e-15);
        assert!((errors.within_25_percent - 0.6).abs() < 1e-15);
        assert_eq!(Errors::of([]), None);
    }
}
