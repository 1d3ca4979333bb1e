//! Comparison of models at one or several impact velocities.

use percuss::{
    compare::{self, Comparison},
    model,
    outcome::BandQuantity,
    statistics::evenly,
};
use percuss_report::{compare_chart, comparison_files};
use serde_json::{Value, json};

use super::{Job, Study, csv_files};
use crate::{events::pretty, problem::Problem};

/// Most speeds of a comparison.
const SPEEDS: usize = 60;

pub(super) fn compared(job: &Job<'_>) -> Result<Study, Problem> {
    let scenario = job.scenario()?;
    let speeds = match job.asked.speeds {
        None => vec![scenario.impact_velocity],
        Some((from, to, count)) => speeds(from, to, count)?,
    };
    let mut report = |now: compare::Progress| {
        let words = format!("{} of {} runs", now.finished, now.total);
        job.go_on(now.fraction, &words)
    };
    let mut watch = compare::Observer {
        progress: Some(&mut report),
    };
    let comparison = compare::compare(&model::fast_models(), None, &scenario, &speeds, &mut watch)
        .map_err(|error| job.stop.problem(error))?;
    let regimes: Vec<String> = comparison
        .regime
        .iter()
        .map(|at| at.regime.describe(&scenario))
        .collect();
    let quantities: Vec<Value> = comparison
        .quantities
        .iter()
        .map(|quantity| quantity_record(&comparison, *quantity, speeds[0]))
        .collect();
    let chart = compare_chart(&scenario, &comparison);
    let files: Vec<_> = csv_files(comparison_files(&comparison, None)?)
        .chain([("compare.json".to_owned(), pretty(&comparison))])
        .collect();
    let record = json!({ "comparison": comparison, "regimes": regimes, "quantities": quantities });
    Ok(Study::new(record, chart.as_slice(), files))
}

fn speeds(from: f64, to: f64, count: usize) -> Result<Vec<f64>, Problem> {
    let inside = |speed: f64| (0.0..=10_000.0).contains(&speed);
    if !inside(from) || !inside(to) || !(2..=SPEEDS).contains(&count) {
        return Err(Problem::refused(
            format!("{count} velocities from {from} to {to} m/s"),
            format!("allowed: 2 to {SPEEDS} velocities from 0 to 10000 m/s"),
        ));
    }
    Ok(evenly(from, to, count as u64 - 1).collect())
}

/// A quantity in words, with what was measured of it.
fn quantity_record(comparison: &Comparison, quantity: BandQuantity, speed: f64) -> Value {
    let measured = comparison.measured(quantity, speed);
    json!({
        "key": quantity,
        "words": quantity.describe(),
        "unit": quantity.unit(),
        "measured": measured.map(|(value, _)| value),
    })
}
