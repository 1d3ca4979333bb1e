//! Axisymmetric answer of a run, computed after the result of its model.

use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicBool, Ordering},
};

use percuss::{
    Error, Refusal, Scenario,
    axisymmetric::{self, AxisymmetricAnswer, BUDGET, Plan, ReferenceMeshes},
    model::DEFAULT_MODEL,
    outcome::BandQuantity,
    summary::ResultRecord,
};
use percuss_report::result_rows::{Row, expected_error, number, with_uncertainty};

use super::Run;
use crate::{
    response::ProgressCallback,
    result_table,
    terminal::{bold, paragraph},
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

    /// Computes the answer, until `stop` becomes true or the callback breaks.
    pub fn compute(
        &self,
        scenario: &Scenario,
        stop: &AtomicBool,
        on_progress: ProgressCallback<'_>,
    ) -> Result<AxisymmetricAnswer, Error> {
        let plan = match &self.plan {
            Ok(plan) => plan,
            Err(refusal) => return Ok(self.without(refusal)),
        };
        let words = format!(
            "axisymmetric runs on {} cells per radius",
            listed(&plan.cells)
        );
        let mut report = |fraction: f64| match stop.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => on_progress(fraction, &words),
        };
        axisymmetric::answer(scenario, plan, &mut report)
    }

    /// The answer of a computation that the user stopped.
    pub fn stopped(&self) -> AxisymmetricAnswer {
        self.without("the runs were stopped")
    }

    fn without(&self, reason: impl ToString) -> AxisymmetricAnswer {
        AxisymmetricAnswer::without(self.reference, reason.to_string())
    }
}

/// `3, 4 and 6`.
fn listed(cells: &[u32]) -> String {
    let words: Vec<String> = cells.iter().map(u32::to_string).collect();
    match words.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => words.concat(),
    }
}

/// The answer in the terminal: the headline of the output, with the result of the model beside it. Where there is none, the reason, and
/// the estimated model error where `record`, which was shown, lacks it.
pub(super) fn text(
    answer: &AxisymmetricAnswer,
    record: &ResultRecord,
    lacks_estimate: bool,
) -> String {
    let Some((quantity, value)) = answer.quantity.zip(answer.value) else {
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
    let unit = quantity.unit();
    let shown = match answer.uncertainty {
        Some(uncertainty) => with_uncertainty(value, uncertainty, unit),
        None => number(value, unit),
    };
    let headline = format!(
        "Axisymmetric {} {shown} ({})",
        in_headline(quantity),
        meshes(answer.meshes.len()),
    );
    let mut text = format!(
        "\n{}\n{}",
        bold(headline),
        result_table::rows(&rows(answer, quantity, value, record))
    );
    if let Some(note) = &answer.note {
        text += &paragraph(note);
    }
    text
}

fn meshes(count: usize) -> String {
    match count {
        1 => "1 mesh".to_owned(),
        _ => format!("{count} meshes"),
    }
}

/// Name of a main number in the headline.
fn in_headline(quantity: BandQuantity) -> &'static str {
    match quantity {
        BandQuantity::DepthOfPenetration => "depth of penetration",
        BandQuantity::ProjectileFinalLength => "final projectile length",
        other => other.describe(),
    }
}

fn rows(
    answer: &AxisymmetricAnswer,
    quantity: BandQuantity,
    value: f64,
    record: &ResultRecord,
) -> Vec<Row> {
    let mut rows = Vec::new();
    let unit = quantity.unit();
    let mut add = |label: &str, value: String| rows.push((label.to_owned(), value));
    if let Some(own) = record.value(quantity) {
        let difference = match value {
            0.0 => String::new(),
            _ => format!(", {:+.0} %", 100.0 * (own / value - 1.0)).replace('-', "−"),
        };
        let label = format!("one-dimensional ({})", record.model);
        add(&label, format!("{}{difference}", number(own, unit)));
    }
    if let Some(outcome) = answer.outcome {
        add("outcome", outcome.describe().to_owned());
    }
    for (label, other) in [
        ("residual velocity", BandQuantity::ResidualVelocity),
        (
            "final projectile length",
            BandQuantity::ProjectileFinalLength,
        ),
    ] {
        if let Some(other_value) = finest(answer, other).filter(|_| other != quantity) {
            add(label, number(other_value, other.unit()));
        }
    }
    let cells: Vec<u32> = answer.meshes.iter().map(|m| m.cells_per_radius).collect();
    let on_meshes: Vec<String> = answer
        .meshes
        .iter()
        .map(|mesh| {
            mesh.value(quantity)
                .map_or("none".to_owned(), |value| number(value, ""))
        })
        .collect();
    add(
        "meshes",
        format!(
            "{} {unit} on {} cells per radius",
            on_meshes.join(", "),
            listed(&cells)
        ),
    );
    add("limit", basis(answer));
    rows
}

/// A number on the finest mesh.
fn finest(answer: &AxisymmetricAnswer, quantity: BandQuantity) -> Option<f64> {
    answer.meshes.last()?.value(quantity)
}

/// What the value and its uncertainty are.
fn basis(answer: &AxisymmetricAnswer) -> String {
    match (answer.uncertainty, answer.order) {
        (Some(_), Some(order)) => format!(
            "extrapolated at the observed order {order:.1}; ± is the error of the mesh alone"
        ),
        (Some(_), None) => {
            "finest mesh, not extrapolated; ± is the error of the mesh alone".to_owned()
        }
        (None, _) => "finest mesh; the meshes differ in their outcome".to_owned(),
    }
}
