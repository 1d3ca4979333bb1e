//! V50, the speed at which half of the shots go through, from shots that were stopped or went through.
//!
//! Shots scatter: near the limit some are stopped that are faster than others that go through. The chance of going through is taken
//! as `F((v − V50)/s)` with the normal distribution (probit) or the logistic one (logit) for F, and V50 and s by maximum
//! likelihood \[mckaig1983\]. The interval is that of the likelihood ratio \[neyer1992\].
//!
//! ```
//! use percuss::v50::{Shot, estimate};
//!
//! let shot = |speed, perforated| Shot { speed, perforated };
//! let shots = [
//!     shot(180.0, false), shot(184.0, false), shot(186.0, true), shot(188.0, false), shot(190.0, true), shot(194.0, true),
//! ];
//! let v50 = estimate(&shots, 38.1);
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

/// A shot at a target that was stopped or went through.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Shot {
    /// Impact speed [m/s].
    #[serde(rename = "velocity_m_s")]
    pub speed: f64,
    /// Whether it went through.
    pub perforated: bool,
}

/// Level of the intervals.
pub const CONFIDENCE: f64 = 0.95;

/// Widest span of the shots that V50 is the mean of [m/s]: 125 ft/s \[milstd662f\].
pub const SPAN: f64 = 38.1;

/// How stopped shots and those that went through lie to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Some stopped shots are faster than some that went through: there is a zone of mixed results.
    Mixed,
    /// All stopped shots are slower than all that went through, or as fast as the slowest of them.
    Separated,
    /// All stopped shots are faster than all that went through, or as fast as the fastest of them.
    Reversed,
    /// All were stopped.
    AllStopped,
    /// All went through.
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
    /// Mean of equal numbers of the fastest stopped shots and the slowest that went through.
    MeanOfExtremes,
}

impl Method {
    /// The method in words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Probit => "probit",
            Self::Logit => "logit",
            Self::MeanOfExtremes => "extremes",
        }
    }
}

/// V50 by one method. The names are stable; what the shots do not give is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Estimate {
    /// The method.
    pub method: Method,
    /// V50 [m/s].
    pub v50_m_s: Option<f64>,
    /// Why there is none.
    pub reason: Option<String>,
    /// Standard deviation of the distribution, which is the scatter of the shots [m/s].
    pub standard_deviation_m_s: Option<f64>,
    /// Standard error of V50 from the observed information [m/s].
    pub standard_error_m_s: Option<f64>,
    /// Lower end of the interval of the likelihood ratio [m/s]; null when it has none.
    pub low_m_s: Option<f64>,
    /// Upper end of the interval of the likelihood ratio [m/s]; null when it has none.
    pub high_m_s: Option<f64>,
    /// Logarithm of the likelihood.
    pub log_likelihood: Option<f64>,
    /// Shots that V50 is the mean of.
    pub shots_used: Option<usize>,
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
            shots_used: None,
            span_m_s: None,
        }
    }
}

/// What shots say of V50. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct V50 {
    /// Number of shots.
    pub shots: usize,
    /// How many went through.
    pub perforated: usize,
    /// Fastest shot that was stopped [m/s].
    pub highest_stopped_m_s: Option<f64>,
    /// Slowest shot that went through [m/s].
    pub lowest_perforated_m_s: Option<f64>,
    /// How the two kinds lie to each other.
    pub pattern: Pattern,
    /// Level of the intervals.
    pub confidence: f64,
    /// One entry a method.
    pub estimates: Vec<Estimate>,
}

impl V50 {
    /// The entry of a method.
    pub fn of(&self, method: Method) -> Option<&Estimate> {
        self.estimates.iter().find(|entry| entry.method == method)
    }
}

/// Speeds of the shots that were stopped, or of those that went through.
fn speeds(shots: &[Shot], perforated: bool) -> impl Iterator<Item = f64> + Clone {
    let kind = shots.iter().filter(move |s| s.perforated == perforated);
    kind.map(|shot| shot.speed)
}

fn pattern(shots: &[Shot]) -> Pattern {
    let extremes = |perforated| {
        let speeds = speeds(shots, perforated);
        let low = speeds.clone().reduce(f64::min);
        low.zip(speeds.reduce(f64::max))
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

/// V50 of shots by every method; `span` is the widest one of the shots that it may be the mean of [m/s].
pub fn estimate(shots: &[Shot], span: f64) -> V50 {
    let pattern = pattern(shots);
    V50 {
        shots: shots.len(),
        perforated: speeds(shots, true).count(),
        highest_stopped_m_s: speeds(shots, false).reduce(f64::max),
        lowest_perforated_m_s: speeds(shots, true).reduce(f64::min),
        pattern,
        confidence: CONFIDENCE,
        estimates: vec![
            fit::likeliest(Link::Probit, shots, pattern),
            fit::likeliest(Link::Logit, shots, pattern),
            means::of_extremes(shots, span),
        ],
    }
}

/// Chance that a shot of this speed [m/s] goes through, by an estimate of maximum likelihood.
pub fn chance(estimate: &Estimate, speed: f64) -> Option<f64> {
    let link = match estimate.method {
        Method::Probit => Link::Probit,
        Method::Logit => Link::Logit,
        Method::MeanOfExtremes => return None,
    };
    let scale = estimate.standard_deviation_m_s? / link.standard_deviation();
    Some(link.chance((speed - estimate.v50_m_s?) / scale))
}
