//! What computes blocks of shots.

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicBool, Ordering},
};

use super::{Axis, caught::caught};
use crate::{
    Error, Scenario,
    case::Template,
    check::Finding,
    model::{self, Control, Model},
    regime::Regime,
    summary::ResultRecord,
};

/// A shot of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// Its number, counted from 0.
    pub index: u64,
    /// Its values, in the order and the units of the axes.
    pub inputs: Vec<f64>,
    /// The case with these values, or why they make none.
    pub scenario: Result<Scenario, String>,
}

impl Shot {
    /// A case with some of its numbers changed: those of the axes, then `more` under their keys.
    pub(crate) fn new(
        template: &Template,
        axes: &[Axis],
        index: u64,
        inputs: Vec<f64>,
        more: &[(&str, toml::Value)],
    ) -> Self {
        let of_axes = axes.iter().zip(&inputs);
        let changes: Vec<(&str, toml::Value)> = of_axes
            .map(|(axis, value)| (axis.key.as_str(), axis.written(*value)))
            .chain(more.iter().cloned())
            .collect();
        let made = caught(|| template.scenario(&changes));
        let scenario = made.and_then(|made| {
            made.map_err(|findings| {
                let words = |finding: &Finding| {
                    let mut text = format!("{}: {}", finding.key, finding.message);
                    if !finding.help.is_empty() {
                        text += &format!(" ({})", finding.help);
                    }
                    text.trim_start_matches(": ").to_owned()
                };
                findings.iter().map(words).collect::<Vec<_>>().join("; ")
            })
        });
        Self {
            index,
            inputs,
            scenario,
        }
    }
}

/// A shot and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Number of the shot, counted from 0.
    pub index: u64,
    /// Its values, in the order and the units of the axes.
    pub inputs: Vec<f64>,
    /// The results, those of a model that refused or failed included; or why there is no case to compute.
    pub record: Result<ResultRecord, String>,
}

/// The caller stopped the sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stopped;

/// A way to compute a block of shots: the place for one that advances many shots at once.
pub trait Kernel: Sync {
    /// A row for each shot, in their order. Rows depend on their own shot only. Ends early when `stop` becomes true.
    ///
    /// # Errors
    /// [`Stopped`].
    fn rows(&self, shots: Vec<Shot>, stop: &AtomicBool) -> Result<Vec<Row>, Stopped>;
}

/// Computes shots one after the other by a model.
#[derive(Clone, Copy)]
pub struct ScalarKernel {
    model: &'static dyn Model,
}

impl ScalarKernel {
    /// The kernel of a model.
    pub fn new(model: &'static dyn Model) -> Self {
        Self { model }
    }

    pub(super) fn record(
        &self,
        scenario: &Scenario,
        stop: &AtomicBool,
    ) -> Result<ResultRecord, Stopped> {
        let mut watch = |_: model::Progress| match stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let mut control = Control {
            progress: Some(&mut watch),
            ..Control::default()
        };
        // One shot is what a panic may cost: the other shots of the block, the block and the sweep go on.
        let result = caught(|| {
            let regime = Regime::of(scenario);
            let result = model::run_in(self.model, scenario, &regime, &mut control)?;
            Ok(ResultRecord::in_regime(scenario, &regime, &result))
        });
        let result = result.unwrap_or_else(|said| Err(Error::Fault(said)));
        match result {
            Ok(record) => Ok(record),
            Err(Error::Cancelled { .. }) => Err(Stopped),
            Err(error) => Ok(ResultRecord::without_result(
                scenario,
                self.model.name(),
                &error,
            )),
        }
    }
}

impl Kernel for ScalarKernel {
    fn rows(&self, shots: Vec<Shot>, stop: &AtomicBool) -> Result<Vec<Row>, Stopped> {
        let row = |shot: Shot| {
            if stop.load(Ordering::Relaxed) {
                return Err(Stopped);
            }
            let record = match shot.scenario {
                Ok(scenario) => Ok(self.record(&scenario, stop)?),
                Err(reason) => Err(reason),
            };
            Ok(Row {
                index: shot.index,
                inputs: shot.inputs,
                record,
            })
        };
        shots.into_iter().map(row).collect()
    }
}
