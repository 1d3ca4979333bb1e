//! Warnings of a comparison.

use percuss::{compare::Comparison, summary::ResultRecord};

use super::messages::grouped;
use crate::{
    by_models::by_models,
    terminal::{self, paragraph},
};

/// Warnings of the recommended models; where none is recommended, those of all.
pub fn text(comparison: &Comparison) -> String {
    let mut text: String = lines(comparison)
        .iter()
        .map(|line| format!("{}\n", terminal::warning(line)))
        .collect();
    if others(comparison) {
        let words = "`percuss run CASE.toml --model NAME` prints the warnings of the other models";
        text += &format!("{}\n", paragraph(words));
    }
    text
}

fn lines(comparison: &Comparison) -> Vec<String> {
    let speeds = comparison.velocities();
    let mut entries = Vec::new();
    for model in comparison.models() {
        let records = comparison.of_model(model).enumerate();
        let said = records
            .filter(|(speed, record)| is_shown(comparison, *speed, record))
            .flat_map(|(speed, record)| record.warnings.iter().map(move |w| (speed, w.as_str())));
        for message in grouped(said, speeds.len()) {
            let words = message.describe(&speeds);
            entries.push((
                model,
                match message.place(&speeds).trim_start() {
                    "" => words,
                    place => format!("{place}: {words}"),
                },
            ));
        }
    }
    by_models(entries)
}

fn is_shown(comparison: &Comparison, speed: usize, record: &ResultRecord) -> bool {
    let choices = &comparison.recommended[speed].models;
    record.is_result()
        && (choices.is_empty() || choices.iter().any(|choice| choice.model == record.model))
}

/// Whether a result has warnings that are not shown.
fn others(comparison: &Comparison) -> bool {
    (0..comparison.regime.len()).any(|speed| {
        comparison.at_impact_velocity(speed).iter().any(|record| {
            record.is_result()
                && !record.warnings.is_empty()
                && !is_shown(comparison, speed, record)
        })
    })
}
