//! Tables of curves that were measured against time in the test of a case.

use std::{collections::BTreeMap, path::PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Gauge, SourceKeys};
use crate::{
    check::{Check, Limits, limits},
    units::Time,
};

/// Correlation time of errors [s]: those of 0 are independent.
const CORRELATION_TIME: Limits = Limits {
    min: 0.0,
    max: limits::TIME.max,
};

/// A table of curves measured against time; no model sees it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredTable {
    /// File of comma-separated values, relative to the case file: `time` and quantities of `history.csv` or of a gauge, with their units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Text of such a table, in place of a file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub csv: Option<String>,
    /// Gauge of the case at which the quantities were measured; without it they are quantities of `history.csv`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gauge: Option<String>,
    /// Name in tables and figures; that of the file when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Standard uncertainty of the values with its unit, for `percuss calibrate`; a table of them by quantity where there are several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<CurveUncertainty>,
    /// Correlation time of the differences from a model [s], for `percuss calibrate`, which otherwise estimates it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub correlation_time: Option<Time>,
    /// Bibliography key, or a list of keys, of where the curves were read; the name when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceKeys>,
}

/// Standard uncertainty of the values of a table, with units.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "a number with its unit in quotes, such as \"5 MPa\", or a table of them by quantity"
)]
pub enum CurveUncertainty {
    /// Of the only quantity.
    Of(String),
    /// Of each quantity.
    Each(BTreeMap<String, String>),
}

impl MeasuredTable {
    /// Name in tables and figures of the table with this index.
    pub fn name(&self, index: usize) -> String {
        let of_file = || Some(self.file.as_ref()?.file_stem()?.display().to_string());
        let named = self.name.clone().or_else(of_file);
        named.unwrap_or_else(|| format!("measured curve {}", index + 1))
    }

    /// Checks the tables of a case that has these gauges.
    pub fn check_all(tables: &[Self], gauges: &[Gauge], check: &mut Check<'_>) {
        let names: Vec<String> = (0..).zip(gauges).map(|(i, g)| g.name(i)).collect();
        for (i, table) in tables.iter().enumerate() {
            table.check(&names, &mut check.within(&format!("measured_curves.{i}")));
        }
    }

    fn check(&self, gauges: &[String], check: &mut Check<'_>) {
        match (&self.file, &self.csv) {
            (None, None) => check.fail(
                "",
                "the measured curve has no values",
                "give `file = \"NAME.csv\"`, or the text of such a file as `csv`",
            ),
            (Some(_), Some(_)) => check.fail(
                "csv",
                "the measured curve has both a file and a text",
                "remove `file` or `csv`",
            ),
            _ => {}
        }
        if self
            .name
            .as_ref()
            .is_some_and(|name| name.trim().is_empty())
        {
            check.fail(
                "name",
                "the name is empty",
                "give it letters, or remove the key",
            );
        }
        check.quantity("correlation_time", self.correlation_time, CORRELATION_TIME);
        if let Some(SourceKeys(keys)) = &self.source
            && keys.iter().all(|key| key.trim().is_empty())
        {
            check.fail(
                "source",
                "the source is empty",
                "name where the curves were read, or remove the key",
            );
        }
        let Some(gauge) = self.gauge.as_ref().filter(|gauge| !gauges.contains(gauge)) else {
            return;
        };
        let help = match gauges {
            [] => "add `[[gauges]]` with its `name` and `position`".to_owned(),
            _ => format!("allowed: {}", gauges.join(", ")),
        };
        check.fail(
            "gauge",
            format!("the case has no gauge named `{gauge}`"),
            help,
        );
    }
}
