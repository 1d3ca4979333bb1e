//! Error statistics of every candidate by velocity, length, regime, materials and uncertainty of the reference.

use percuss::{
    model_error::{
        ErrorRecord, candidates,
        design::{LENGTHS, VELOCITIES},
    },
    regime::ProjectileRegime,
    statistics::{quantile, sorted},
};
use serde::Serialize;

use super::{PAIRS, SPREAD_PAIRS};

/// Largest relative uncertainty of a sharp reference, well below the errors that are computed with it.
pub const SHARP: f64 = 0.1;

/// Largest absolute relative error of a close depth.
pub const CLOSE: f64 = 0.25;

/// Property by which results are grouped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Grouping {
    /// All cases.
    All,
    /// Impact velocity.
    Speed,
    /// Length of the projectile over its diameter.
    Length,
    /// Regime of the projectile.
    Regime,
    /// Materials.
    Pair,
    /// Uncertainty of the reference.
    Reference,
}

/// Errors of a candidate in a group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Group {
    /// Name of the candidate.
    pub candidate: &'static str,
    /// Grouping property.
    pub grouping: Grouping,
    /// Value of the property.
    pub value: String,
    /// Error statistics.
    #[serde(flatten)]
    pub errors: Errors,
}

/// Statistics of relative errors (depth by the model / reference - 1).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Errors {
    /// Number of cases.
    pub count: usize,
    /// Median.
    pub median: f64,
    /// 10th percentile.
    pub low: f64,
    /// 90th percentile.
    pub high: f64,
    /// Median absolute error.
    pub median_absolute: f64,
    /// Fraction of the cases with an absolute error of at most [`CLOSE`].
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
    /// All groupings.
    pub const ALL: &'static [Self] = &[
        Self::All,
        Self::Speed,
        Self::Length,
        Self::Regime,
        Self::Pair,
        Self::Reference,
    ];

    /// Name of the property.
    pub fn describe(self) -> &'static str {
        match self {
            Self::All => "all cases",
            Self::Speed => "impact velocity",
            Self::Length => "L/D",
            Self::Regime => "regime",
            Self::Pair => "materials",
            Self::Reference => "uncertainty of the reference",
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
                .chain(SPREAD_PAIRS)
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

/// Whether the reference of a case is known within [`SHARP`].
pub fn is_sharp(verdict: &ErrorRecord) -> bool {
    verdict.reference_uncertainty_mm <= SHARP * verdict.reference_depth_mm
}

/// Name of the group of a velocity: the nearest of the grid.
fn speed_name(speed: f64) -> String {
    format!("{} m/s", nearest(VELOCITIES, speed))
}

/// Name of the group of an L/D: the nearest of the grid.
fn length_name(length: f64) -> String {
    format!("L/D {}", nearest(LENGTHS, length))
}

/// The value of a list that is nearest in ratio.
fn nearest(values: &[f64], to: f64) -> f64 {
    let distance = |value: &f64| (value / to).ln().abs();
    let nearest = values
        .iter()
        .copied()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.unwrap_or(to)
}

/// A pair of materials in words.
pub fn pair_name(projectile: &str, target: &str) -> String {
    format!("{projectile} on {target}")
}

fn sharp_name(sharp: bool) -> String {
    let percent = 100.0 * SHARP;
    match sharp {
        true => format!("within {percent} %"),
        false => format!("above {percent} %"),
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
