//! Gauges: points of the material, or places, at which a run keeps a time history, and the times of histories.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    check::{Check, limits},
    units::{Length, Time},
};

/// Most gauges of a case.
const MOST: usize = 64;

/// Times at which a numerical run keeps its histories, those at gauges included.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HistoryOptions {
    /// Time from one sample to the next [s]: the first time step that ends at each multiple or after it; when not given, up to 1600 samples, equally many steps apart.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<Time>,
}

impl HistoryOptions {
    /// Checks the values of the table.
    pub fn check(self, check: &mut Check<'_>) {
        check.quantity("interval", self.interval, limits::TIME);
    }

    /// Whether no key is given.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// A point of the material on the axis, which moves with it, or a place there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gauge {
    /// Name in files and figures; `gauge 1`, `gauge 2`, ... when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Position before the impact, below the struck face [m]; negative in the projectile.
    pub position: Length,
    /// `true` for a place that stays where it is, whatever material is there; a point of the material when not given.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub fixed: bool,
}

impl Gauge {
    /// Name in results of the gauge with this index.
    pub fn name(&self, index: usize) -> String {
        self.name
            .clone()
            .unwrap_or_else(|| format!("gauge {}", index + 1))
    }

    /// Checks positions and names of the gauges of a case, as far as they do not depend on its bodies.
    pub fn check_all(gauges: &[Self], check: &mut Check<'_>) {
        if gauges.len() > MOST {
            let message = format!("{} gauges are too many", gauges.len());
            check.fail("gauges", message, format!("allowed: up to {MOST}"));
        }
        for (i, gauge) in gauges.iter().enumerate() {
            let mut check = check.within(&format!("gauges.{i}"));
            check.quantity("position", gauge.position, limits::GAUGE_POSITION);
            let name = gauge.name(i);
            if name.trim().is_empty() {
                check.fail(
                    "name",
                    "the name is empty",
                    "give it letters, or remove the key",
                );
            }
            let mut before = gauges[..i].iter().enumerate();
            if before.any(|(j, other)| other.name(j) == name) {
                let message = format!("two gauges are named `{name}`");
                check.fail("name", message, "give each a name of its own");
            }
        }
    }
}
