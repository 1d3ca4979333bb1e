//! Main result of the other applicable models.

use std::ops::ControlFlow;

use percuss::{
    Scenario,
    compare::{self, Comparison, Observer},
    model,
    outcome::BandQuantity,
    summary::ResultRecord,
};
use percuss_report::result_rows::{Row, number};

use crate::{failure::Failure, progress::Progress};

/// One row per model with a result, except those that take minutes and the model `but`, with the heading.
pub fn rows(
    scenario: &Scenario,
    but: &str,
    progress: &mut Progress,
) -> Result<(String, Vec<Row>), Failure> {
    let mut models = model::fast_models();
    models.retain(|model| model.name() != but);
    let mut report = |now: compare::Progress| {
        progress.update(now.fraction, "other models");
        ControlFlow::Continue(())
    };
    let mut watch = Observer {
        progress: Some(&mut report),
    };
    let found = compare::compare(
        &models,
        None,
        scenario,
        &[scenario.impact_velocity],
        &mut watch,
    )?;
    Ok(shown(&found))
}

fn shown(found: &Comparison) -> (String, Vec<Row>) {
    let quantity = found.quantities[0];
    let given = found.results.iter().filter_map(|record| {
        let value = record.value(quantity)?;
        Some((record.model.to_owned(), words(record, quantity, value)))
    });
    let heading = format!(
        "{} by other models (`percuss compare` recommends one)",
        quantity.describe()
    );
    (heading, given.collect())
}

fn words(record: &ResultRecord, quantity: BandQuantity, value: f64) -> String {
    let value = number(value, quantity.unit());
    match (&record.expected_error, quantity) {
        (Some(error), BandQuantity::DepthOfPenetration) => {
            format!("{value}, model error {}", error.describe())
        }
        _ => value,
    }
}
