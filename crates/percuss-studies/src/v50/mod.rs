//! V50, the impact velocity with a probability of complete penetration of one half, from partial and complete penetrations.
//!
//! Tests scatter: near the limit some partial penetrations are faster than some complete ones. The probability of complete penetration is taken
//! as `F((v − V50)/s)` with the normal distribution (probit) or the logistic one (logit) for F, and V50 and s by maximum
//! likelihood \[mckaig1983\]. The interval is that of the likelihood ratio \[neyer1992\].
//!
//! ```
//! use percuss::v50::{Test, estimate};
//!
//! let test = |impact_velocity, perforated| Test { impact_velocity, perforated };
//! let tests = [
//!     test(180.0, false), test(184.0, false), test(186.0, true), test(188.0, false), test(190.0, true), test(194.0, true),
//! ];
//! let v50 = estimate(&tests, 38.1);
//! assert!((v50.estimates[0].v50_m_s.unwrap() - 187.0).abs() < 1e-6);
//! ```

mod fit;
mod interval;
mod link;
mod means;
mod read;
#[cfg(test)]
mod tests;

use serde::Serialize;

use link::Link;

pub use read::{COLUMNS, read, read_str};

/// A test with a partial or a complete penetration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Test {
    /// Impact velocity [m/s].
    #[serde(rename = "impact_velocity_m_s")]
    pub impact_velocity: f64,
    /// Whether the penetration was complete.
    pub perforated: bool,
}

/// Level of the intervals.
pub const CONFIDENCE: f64 = 0.95;

/// Widest span of the tests that V50 is the mean of [m/s]: 125 ft/s \[milstd662f\].
pub const SPAN: f64 = 38.1;

/// Pattern of partial and complete penetrations over the impact velocity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Some partial penetrations are faster than some complete ones: a zone of mixed results.
    Mixed,
    /// All partial penetrations are slower than all complete ones, or as fast as the slowest: complete separation.
    Separated,
    /// All partial penetrations are faster than all complete ones, or as fast as the fastest.
    Reversed,
    /// All are partial penetrations.
    AllStopped,
    /// All are complete penetrations.
    AllPerforated,
}

/// How V50 was estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Maximum likelihood with the normal distribution.
    Probit,
    /// Maximum likelihood with the logistic distribution.
    Logit,
    /// Mean of equal numbers of the fastest partial and the slowest complete penetrations.
    MeanOfExtremes,
}

impl Method {
    /// The method in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Probit => "probit",
            Self::Logit => "logit",
            Self::MeanOfExtremes => "extremes",
        }
    }
}

/// V50 by one method. The names are stable; what the tests do not give is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Estimate {
    /// The method.
    pub method: Method,
    /// V50 [m/s].
    pub v50_m_s: Option<f64>,
    /// Why there is none.
    pub reason: Option<String>,
    /// Standard deviation of the distribution, which is the scatter of the tests [m/s].
    pub standard_deviation_m_s: Option<f64>,
    /// Standard error of V50 from the observed information [m/s].
    pub standard_error_m_s: Option<f64>,
    /// Lower end of the interval of the likelihood ratio [m/s]; null when it has none.
    pub low_m_s: Option<f64>,
    /// Upper end of the interval of the likelihood ratio [m/s]; null when it has none.
    pub high_m_s: Option<f64>,
    /// Logarithm of the likelihood.
    pub log_likelihood: Option<f64>,
    /// Tests that V50 is the mean of.
    pub tests_used: Option<usize>,
    /// Difference between the fastest and the slowest of them [m/s].
    pub span_m_s: Option<f64>,
}

impl Estimate {
    fn none(method: Method, reason: impl Into<String>) -> Self {
        Self {
            reason: Some(reason.into()),
            ..Self::empty(method)
        }
    }

    fn empty(method: Method) -> Self {
        Self {
            method,
            v50_m_s: None,
            reason: None,
            standard_deviation_m_s: None,
            standard_error_m_s: None,
            low_m_s: None,
            high_m_s: None,
            log_likelihood: None,
            tests_used: None,
            span_m_s: None,
        }
    }
}

/// What tests say of V50. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct V50 {
    /// Number of tests.
    pub tests: usize,
    /// Number of complete penetrations.
    pub perforated: usize,
    /// Fastest partial penetration [m/s].
    pub highest_stopped_m_s: Option<f64>,
    /// Slowest complete penetration [m/s].
    pub lowest_perforated_m_s: Option<f64>,
    /// How the two kinds lie to each other.
    pub pattern: Pattern,
    /// Level of the intervals.
    pub confidence: f64,
    /// One entry per method.
    pub estimates: Vec<Estimate>,
}

impl V50 {
    /// The entry of a method.
    pub fn of(&self, method: Method) -> Option<&Estimate> {
        self.estimates.iter().find(|entry| entry.method == method)
    }
}

/// Impact velocities of the partial penetrations, or of the complete ones.
fn velocities(tests: &[Test], perforated: bool) -> impl Iterator<Item = f64> + Clone {
    let kind = tests.iter().filter(move |s| s.perforated == perforated);
    kind.map(|test| test.impact_velocity)
}

fn pattern(tests: &[Test]) -> Pattern {
    let extremes = |perforated| {
        let velocities = velocities(tests, perforated);
        let low = velocities.clone().reduce(f64::min);
        low.zip(velocities.reduce(f64::max))
    };
    let (Some(stopped), Some(perforated)) = (extremes(false), extremes(true)) else {
        return match extremes(true) {
            Some(_) => Pattern::AllPerforated,
            None => Pattern::AllStopped,
        };
    };
    if stopped.1 <= perforated.0 {
        Pattern::Separated
    } else if perforated.1 <= stopped.0 {
        Pattern::Reversed
    } else {
        Pattern::Mixed
    }
}

/// V50 of tests by every method; `span` is the widest one of the tests that it may be the mean of [m/s].
pub fn estimate(tests: &[Test], span: f64) -> V50 {
    let pattern = pattern(tests);
    V50 {
        tests: tests.len(),
        perforated: velocities(tests, true).count(),
        highest_stopped_m_s: velocities(tests, false).reduce(f64::max),
        lowest_perforated_m_s: velocities(tests, true).reduce(f64::min),
        pattern,
        confidence: CONFIDENCE,
        estimates: vec![
            fit::likeliest(Link::Probit, tests, pattern),
            fit::likeliest(Link::Logit, tests, pattern),
            means::of_extremes(tests, span),
        ],
    }
}

/// Probability of complete penetration at an impact velocity [m/s], by an estimate of maximum likelihood.
pub fn probability(estimate: &Estimate, velocity: f64) -> Option<f64> {
    let link = match estimate.method {
        Method::Probit => Link::Probit,
        Method::Logit => Link::Logit,
        Method::MeanOfExtremes => return None,
    };
    let scale = estimate.standard_deviation_m_s? / link.standard_deviation();
    Some(link.probability((velocity - estimate.v50_m_s?) / scale))
}
