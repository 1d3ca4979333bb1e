//! The ballistic limit that a model of residual velocity starts from.

use serde::Serialize;

/// Ballistic limit that a model of residual velocity starts from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct InputLimit {
    /// The limit [m/s].
    pub ballistic_limit_m_s: f64,
    /// Model that computes it; `None` where the case gives it.
    pub computed_by: Option<&'static str>,
}

impl InputLimit {
    /// Where the limit comes from, in words.
    pub fn origin_in_words(&self) -> &'static str {
        self.computed_by.unwrap_or("the case")
    }
}
