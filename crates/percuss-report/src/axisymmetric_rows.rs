//! Axisymmetric answer as rows of a label and a value, for the terminal and the page.

use percuss::{
    axisymmetric::{AxisymmetricAnswer, HIGHEST_ORDER, MODEL},
    outcome::BandQuantity,
    summary::ResultRecord,
    units::significant,
};

use crate::result_rows::{Row, number, with_uncertainty};

/// Name of the main number and its value with its uncertainty; `None` without an answer.
pub fn headline(answer: &AxisymmetricAnswer) -> Option<[String; 2]> {
    let (quantity, value) = answer.quantity.zip(answer.value)?;
    let unit = quantity.unit();
    let shown = match answer.uncertainty {
        Some(uncertainty) => with_uncertainty(value, uncertainty, unit),
        None => format!("{} {unit}", significant(value, 3)),
    };
    Some([format!("Axisymmetric {}", in_headline(quantity)), shown])
}

/// `3, 4 and 6`.
pub fn listed(cells: &[u32]) -> String {
    let words: Vec<String> = cells.iter().map(u32::to_string).collect();
    match words.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => words.concat(),
    }
}

/// `+12`, `−4` or `0`.
fn signed_percent(part: f64) -> String {
    match (100.0 * part).round() {
        0.0 => "0".to_owned(),
        percent => format!("{percent:+.0}").replace('-', "−"),
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

/// What stands under the headline: the result of another model `beside` it, outcome, other numbers, meshes and limit.
pub fn rows(answer: &AxisymmetricAnswer, beside: Option<&ResultRecord>) -> Vec<Row> {
    let mut rows = Vec::new();
    let Some((quantity, value)) = answer.quantity.zip(answer.value) else {
        return rows;
    };
    let unit = quantity.unit();
    let mut add = |label: &str, value: String| rows.push((label.to_owned(), value));
    // The same model on the mesh of the case is one of the meshes.
    let beside = beside.filter(|record| record.model != MODEL);
    if let Some((record, own)) = beside.and_then(|record| Some((record, record.value(quantity)?))) {
        let difference = match value {
            0.0 => String::new(),
            // A part of a number that may as well be zero says nothing.
            _ if answer.uncertainty.is_some_and(|error| error >= value.abs()) => String::new(),
            _ => format!(", {} %", signed_percent(own / value - 1.0)),
        };
        let kind = match record.model {
            "chain" | "fdm" => "one-dimensional",
            _ => "model",
        };
        let label = format!("{kind} ({})", record.model);
        add(&label, format!("{}{difference}", number(own, unit)));
    }
    if let Some(outcome) = answer.outcome {
        let own = outcome.describe();
        let other = beside.filter(|record| record.outcome != outcome);
        add(
            "outcome",
            match other {
                Some(record) => format!(
                    "{own}; {} gives: {}",
                    record.model,
                    record.outcome.describe()
                ),
                None => own.to_owned(),
            },
        );
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
        (Some(_), Some(order)) if order > HIGHEST_ORDER => format!(
            "extrapolated at order {HIGHEST_ORDER}, observed {order:.1}; ± is the error of the mesh alone"
        ),
        (Some(_), Some(order)) => format!(
            "extrapolated at the observed order {order:.1}; ± is the error of the mesh alone"
        ),
        (Some(_), None) => {
            "finest mesh, not extrapolated; ± is the error of the mesh alone".to_owned()
        }
        // Why it has no uncertainty is its doubt.
        (None, _) => "finest mesh".to_owned(),
    }
}
