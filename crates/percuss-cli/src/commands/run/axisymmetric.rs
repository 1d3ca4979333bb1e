//! Axisymmetric answer of a run, computed after the result of its model.

use std::sync::atomic::AtomicBool;

use percuss::{
    Error, Refusal, Scenario,
    axisymmetric::{self, AxisymmetricAnswer, BUDGET, Plan, ReferenceMeshes},
    frames::Frame,
    model::DEFAULT_MODEL,
    summary::ResultRecord,
};
use percuss_report::{
    axisymmetric_rows::{self, listed},
    result_rows::expected_error,
};

use super::Run;
use crate::{
    response::ProgressCallback,
    result_table,
    terminal::{bold, paragraph, warning},
    workers::unless_stopped,
};

/// Whether a run by this model, or by the default, gets the answer.
pub(super) fn is_added_to(model: Option<&str>) -> bool {
    model.is_none_or(|name| name == DEFAULT_MODEL)
}

/// Axisymmetric answer that a run gets, before it is computed.
pub(super) struct Wanted {
    reference: ReferenceMeshes,
    plan: Result<Plan, Refusal>,
}

impl Wanted {
    /// What a command line asks for; `None` without an answer. Meshes that it names are run whatever they cost.
    pub fn of(options: &Run, scenario: &Scenario) -> Option<Self> {
        if options.fast || !is_added_to(options.model.as_deref()) {
            return None;
        }
        let named = options.reference.as_deref();
        let reference = named.and_then(ReferenceMeshes::named).unwrap_or_default();
        let budget = named.is_none().then_some(BUDGET);
        Some(Self {
            reference,
            plan: axisymmetric::plan(scenario, reference, budget),
        })
    }

    /// Whether anything is to be run.
    pub fn is_planned(&self) -> bool {
        self.plan.is_ok()
    }

    /// Computes the answer, until `stop` becomes true or the callback breaks; `frames` gets the fields of the finest mesh.
    pub fn compute(
        &self,
        scenario: &Scenario,
        stop: &AtomicBool,
        on_progress: ProgressCallback<'_>,
        frames: &mut (dyn FnMut(&Frame<'_>) + Send),
    ) -> Result<AxisymmetricAnswer, Error> {
        let plan = match &self.plan {
            Ok(plan) => plan,
            Err(refusal) => return Ok(self.without(refusal)),
        };
        let words = format!(
            "axisymmetric runs on {} cells per radius",
            listed(&plan.cells)
        );
        let mut report = |fraction: f64| unless_stopped(stop, on_progress(fraction, &words));
        axisymmetric::answer_with_frames(scenario, plan, &mut report, frames)
    }

    /// The answer of a computation that the user stopped.
    pub fn stopped(&self) -> AxisymmetricAnswer {
        self.without("the runs were stopped")
    }

    fn without(&self, reason: impl ToString) -> AxisymmetricAnswer {
        AxisymmetricAnswer::without(self.reference, reason.to_string())
    }
}

/// The answer in the terminal: the headline of the output, with the result of the model beside it. Where there is none, the reason, and
/// the estimated model error where `record`, which was shown, lacks it.
pub(super) fn text(
    answer: &AxisymmetricAnswer,
    record: &ResultRecord,
    lacks_estimate: bool,
) -> String {
    let Some(headline) = axisymmetric_rows::headline(answer) else {
        let reason = answer.reason.as_deref().unwrap_or_default();
        let mut text = format!(
            "\n{}",
            paragraph(&format!("no axisymmetric answer: {reason}"))
        );
        if lacks_estimate {
            text += &result_table::rows(&Vec::from_iter(expected_error(record)));
        }
        return text;
    };
    let (standing, advice) = match &answer.doubt {
        None => ("the number to use", String::new()),
        Some(doubt) => ("not to be relied on", paragraph(doubt)),
    };
    let mut text = format!(
        "\n{}\n{advice}{}",
        bold(format!("{}: {standing}", headline.join(" "))),
        result_table::rows(&axisymmetric_rows::rows(answer, Some(record)))
    );
    if let Some(note) = &answer.note {
        text += &paragraph(note);
    }
    // The model beside it has said the same of the case.
    let own = answer.warnings.iter();
    for said in own.filter(|said| !record.warnings.contains(said)) {
        text += &format!("\n{}", warning(said));
    }
    text
}
