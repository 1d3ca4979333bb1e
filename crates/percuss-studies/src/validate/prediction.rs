//! Prediction of one test by one model.

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicBool, Ordering},
};

use crate::{
    Error, Scenario,
    experiments::{Experiment, Kind, Split},
    model::{self, Control, Model},
    outcome::Outcome,
    regime::Regime,
};

/// What one model said of one test with one material record. Values are in the unit of the test's kind, see [`Kind::unit`].
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Index of the test.
    pub test: usize,
    /// Name of the model.
    pub model: &'static str,
    /// The material record that stood for the projectile; empty where there is none.
    pub record: String,
    /// Whether that record is the test's main one.
    pub main_record: bool,
    /// What was measured.
    pub measured: f64,
    /// What the model gives.
    pub predicted: Option<f64>,
    /// `(predicted − measured)/measured`, where nothing is divided by zero.
    pub relative_error: Option<f64>,
    /// What kind of test it is: the projectile and the target; empty where no case could be made.
    pub regime: String,
    /// How the test ended in the model.
    pub outcome: Outcome,
    /// Why there is no prediction.
    pub reason: Option<String>,
    /// Warnings that came with the prediction.
    pub warnings: usize,
    /// Whether the prediction is blind: neither the program's constants nor the model were fitted to the test's source or chosen on it,
    /// nor were the constants of its materials calibrated on it.
    pub split: Split,
    /// Whether statistics count it, and if not, why.
    pub standing: Standing,
}

/// Whether statistics count a prediction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// They do.
    Counted,
    /// The row is suspect.
    Flagged,
    /// The row repeats another one.
    Repeated,
    /// Nothing was measured that an error could be relative to: a projectile that was stopped.
    MeasuredZero,
    /// No case can be made of the row.
    NoCase,
    /// The model does not predict what was measured.
    NotGiven,
    /// The model does not apply.
    NotApplicable,
    /// The model failed.
    Failed,
}

impl Standing {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Counted,
        Self::Flagged,
        Self::Repeated,
        Self::MeasuredZero,
        Self::NoCase,
        Self::NotGiven,
        Self::NotApplicable,
        Self::Failed,
    ];

    /// A stable name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Counted => "counted",
            Self::Flagged => "flagged",
            Self::Repeated => "repeated",
            Self::MeasuredZero => "measured_zero",
            Self::NoCase => "no_case",
            Self::NotGiven => "not_given",
            Self::NotApplicable => "not_applicable",
            Self::Failed => "failed",
        }
    }
}

/// A test as a case, with one of its material records.
pub(super) struct Computed<'a> {
    pub(super) test: &'a Experiment,
    pub(super) index: usize,
    pub(super) record: usize,
    pub(super) scenario: &'a Result<Scenario, String>,
    pub(super) regime: &'a str,
}

impl Computed<'_> {
    /// What a model says of it; `stop` ends a long run.
    pub(super) fn predict(&self, model: &dyn Model, stop: &AtomicBool) -> Prediction {
        let test = self.test;
        let answer = match self.scenario {
            Err(reason) => Answer::none(Standing::NoCase, Outcome::NotApplicable, reason.clone()),
            Ok(_) if !model.validity().predicts.contains(&test.kind.quantity()) => Answer::none(
                Standing::NotGiven,
                Outcome::NotApplicable,
                gives_no(test.kind),
            ),
            Ok(scenario) => compute(test.kind, scenario, model, stop),
        };
        let measured = test.kind.shown(test.measured);
        let relative_error = answer
            .predicted
            .filter(|_| measured != 0.0)
            .map(|predicted| (predicted - measured) / measured);
        let standing = match answer.standing {
            Standing::Counted if test.flag.is_some() => Standing::Flagged,
            Standing::Counted if test.duplicate_of.is_some() => Standing::Repeated,
            Standing::Counted if relative_error.is_none() => Standing::MeasuredZero,
            other => other,
        };
        let calibrated = |scenario: &Scenario| scenario.is_calibrated_on(&test.source);
        let split = if model.validity().is_fitted_to(&test.source)
            || self.scenario.as_ref().is_ok_and(calibrated)
        {
            Split::Calibration
        } else {
            test.split
        };
        Prediction {
            test: self.index,
            model: model.name(),
            record: test
                .projectile_materials
                .get(self.record)
                .cloned()
                .unwrap_or_default(),
            main_record: self.record == 0,
            measured,
            predicted: answer.predicted,
            relative_error,
            regime: self.regime.to_owned(),
            outcome: answer.outcome,
            reason: answer.reason,
            warnings: answer.warnings,
            split,
            standing,
        }
    }
}

/// The regime of a case in a few words, for grouping.
pub(super) fn regime_of(scenario: &Scenario) -> String {
    let regime = Regime::of(scenario);
    format!(
        "{} on {}",
        regime.projectile.describe(),
        regime.target.describe()
    )
}

struct Answer {
    predicted: Option<f64>,
    outcome: Outcome,
    reason: Option<String>,
    warnings: usize,
    standing: Standing,
}

impl Answer {
    fn none(standing: Standing, outcome: Outcome, reason: String) -> Self {
        Self {
            predicted: None,
            outcome,
            reason: Some(reason),
            warnings: 0,
            standing,
        }
    }
}

fn gives_no(kind: Kind) -> String {
    format!("gives no {}", kind.quantity().describe())
}

fn compute(kind: Kind, scenario: &Scenario, model: &dyn Model, stop: &AtomicBool) -> Answer {
    let mut observer = |_| {
        if stop.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let mut control = Control {
        record: false,
        progress: Some(&mut observer),
        ..Control::default()
    };
    let failed = |outcome, reason| Answer::none(Standing::Failed, outcome, reason);
    let result = match model::run(model, scenario, &mut control) {
        Ok(result) => result,
        Err(Error::NotApplicable { refusal, .. }) => {
            let reason = refusal.to_string();
            return Answer::none(Standing::NotApplicable, Outcome::NotApplicable, reason);
        }
        Err(error) => return failed(Outcome::Failed, error.to_string()),
    };
    match result.measurable(kind.quantity()) {
        _ if result.outcome == Outcome::OutOfTime => failed(
            Outcome::OutOfTime,
            "the run ended before the test did".to_owned(),
        ),
        None => Answer::none(Standing::NotGiven, result.outcome, gives_no(kind)),
        Some(value) if !value.is_finite() => failed(Outcome::Failed, format!("it gives {value}")),
        Some(value) => Answer {
            predicted: Some(kind.shown(value)),
            outcome: result.outcome,
            reason: None,
            warnings: result.warnings.len(),
            standing: Standing::Counted,
        },
    }
}
