//! Kernels: computation of blocks of runs.

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicBool, Ordering},
};

use super::{Axis, panic_guard::catch_panic};
use crate::{
    Error, Scenario,
    case::Template,
    check::Diagnostic,
    model::{self, Control, Model},
    regime::Regime,
    summary::ResultRecord,
};

/// A run of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRun {
    /// Its number, counted from 0.
    pub index: u64,
    /// Its values, in the order and the units of the axes.
    pub inputs: Vec<f64>,
    /// The case with these values, or why they make none.
    pub scenario: Result<Scenario, String>,
}

impl SweepRun {
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
        let made = catch_panic(|| template.scenario(&changes));
        let scenario = made.and_then(|made| {
            made.map_err(|diagnostics| {
                let words = |diagnostic: &Diagnostic| {
                    let mut text = format!("{}: {}", diagnostic.key, diagnostic.message);
                    if !diagnostic.help.is_empty() {
                        text += &format!(" ({})", diagnostic.help);
                    }
                    text.trim_start_matches(": ").to_owned()
                };
                diagnostics.iter().map(words).collect::<Vec<_>>().join("; ")
            })
        });
        Self {
            index,
            inputs,
            scenario,
        }
    }

    /// The same, ended when its depth is known ([`Scenario::ended_at_rest`]).
    pub(crate) fn ended_at_rest(self) -> Self {
        Self {
            scenario: self.scenario.map(Scenario::ended_at_rest),
            ..self
        }
    }
}

/// A run and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRow {
    /// Number of the run, counted from 0.
    pub index: u64,
    /// Its values, in the order and the units of the axes.
    pub inputs: Vec<f64>,
    /// The results, those of a model that refused or failed included; or why there is no case to compute.
    pub record: Result<ResultRecord, String>,
}

/// The caller stopped the sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stopped;

/// A way to compute a block of runs: the place for one that advances many runs at once.
pub trait Kernel: Sync {
    /// A row for each run, in their order. Rows depend on their own run only. Ends early when `stop` becomes true.
    ///
    /// # Errors
    /// [`Stopped`].
    fn rows(&self, runs: Vec<SweepRun>, stop: &AtomicBool) -> Result<Vec<SweepRow>, Stopped>;
}

/// Computes runs one after the other by a model.
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
        // A formula has no steps at which it is asked.
        if stop.load(Ordering::Relaxed) {
            return Err(Stopped);
        }
        let mut observer = |_: model::Progress| match stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let mut control = Control {
            progress: Some(&mut observer),
            ..Control::default()
        };
        // One run is what a panic may cost: the other runs of the block, the block and the sweep go on.
        let result = catch_panic(|| {
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
    fn rows(&self, runs: Vec<SweepRun>, stop: &AtomicBool) -> Result<Vec<SweepRow>, Stopped> {
        let row = |run: SweepRun| {
            let record = match run.scenario {
                Ok(scenario) => Ok(self.record(&scenario, stop)?),
                Err(reason) => Err(reason),
            };
            Ok(SweepRow {
                index: run.index,
                inputs: run.inputs,
                record,
            })
        };
        runs.into_iter().map(row).collect()
    }
}
