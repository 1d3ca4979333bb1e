//! Sources that a model was fitted to or chosen on.

use serde::Serialize;

/// Sources of measurements that a constant of a model was fitted to, or that its form was chosen on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct FittedTo {
    /// Keys of the bibliography.
    pub sources: &'static [&'static str],
    /// What was fitted or chosen.
    pub because: &'static str,
}

/// How many sources are named one by one.
const FEW: usize = 3;

impl FittedTo {
    /// The sources, and what was fitted to them or chosen on them.
    pub fn describe(&self) -> String {
        let sources = if self.sources.len() > FEW {
            format!("{} sources of tests", self.sources.len())
        } else {
            self.sources.join(", ")
        };
        format!("not blind to {sources}: {}", self.because)
    }
}
