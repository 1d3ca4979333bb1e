//! Runs of a case with several packings of particles.

use std::sync::atomic::AtomicBool;

use percuss::{
    Error, Scenario,
    model::{self, Control, Model},
    outcome::RunResult,
    particles::with_seed,
    summary::{SeedNumber, SeedStudy, result_number},
    units::significant,
};
use percuss_report::table::Table;

use crate::{
    failure::Failure, response::ProgressCallback, table::blocks, terminal::bold,
    workers::unless_stopped,
};

/// Runs the packings after the first one, whose result is there. A study that is stopped has those that are complete, and says so.
pub(super) fn study(
    model: &dyn Model,
    scenario: &Scenario,
    first: &RunResult,
    count: u16,
    stop: &AtomicBool,
    on_progress: ProgressCallback<'_>,
) -> Result<(SeedStudy, bool), Failure> {
    let start = scenario.options.particles.seed();
    let mut others = Vec::new();
    let mut is_stopped = false;
    for number in 1..u64::from(count) {
        let mut report = |now: model::Progress| {
            let part = (number as f64 + now.fraction) / f64::from(count);
            let words = format!(
                "packing {} of {count}, {:.1} us",
                number + 1,
                now.time * 1e6
            );
            unless_stopped(stop, on_progress(part, &words))
        };
        let mut control = Control {
            progress: Some(&mut report),
            ..Control::default()
        };
        let other = with_seed(scenario, start.saturating_add(number));
        match model::run(model, &other, &mut control) {
            Ok(result) => others.push(result),
            Err(Error::Cancelled { .. }) => {
                is_stopped = true;
                break;
            }
            Err(error) => return Err(error.into()),
        }
    }
    let results: Vec<&RunResult> = std::iter::once(first).chain(&others).collect();
    Ok((SeedStudy::new(scenario, start, &results), is_stopped))
}

/// Means and standard deviations as NAME=VALUE pairs, each with a space before it.
pub(super) fn pairs(study: &SeedStudy) -> String {
    let is_result = |of: &&SeedNumber| result_number(of.name).is_some_and(|it| it.role.is_result());
    let numbers = study.numbers.iter().filter(is_result).map(|of| {
        let (name, mean, deviation) = (of.name, of.mean, of.standard_deviation);
        format!(" {name}_mean={mean} {name}_standard_deviation={deviation}")
    });
    format!(
        " packings={}{}",
        study.seeds.len(),
        numbers.collect::<String>()
    )
}

/// Table of a study.
pub(super) fn text(study: &SeedStudy) -> String {
    let number = |value: f64| significant(value, 4);
    // What is the same for every packing is in the first table.
    let varied = study
        .numbers
        .iter()
        .filter(|of| of.standard_deviation > 0.0);
    let varied: Vec<_> = varied.collect();
    let table = Table::of(&varied)
        .words("result", |number| number.label.to_owned())
        .words("unit", |number| number.unit.to_owned())
        .numbers("mean", "", |of| number(of.mean))
        .numbers("deviation", "", |of| number(of.standard_deviation))
        .numbers("smallest", "", |of| number(of.smallest))
        .numbers("largest", "", |of| number(of.largest))
        .table();
    let heading = format!(
        "{} packings, standard deviation of one run",
        study.seeds.len()
    );
    format!("\n{}\n{}", bold(heading), blocks(&table))
}
