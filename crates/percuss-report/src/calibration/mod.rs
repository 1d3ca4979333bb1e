//! Figures and files of a calibration.

mod corner;
mod files;
mod panel;
mod predictive;
mod trace;

use percuss::calibrate::{Calibration, ParameterRecord};

use crate::{Chart, Figure};

pub use files::{tables, write};

/// The figures of a calibration: measured values and predictions; of a sample its traces and its projections on pairs as well.
pub fn figures(calibration: &Calibration) -> Vec<Figure> {
    let mut figures = vec![predictive::chart(calibration).draw()];
    figures.extend(sample_figures(calibration));
    figures
}

/// The chart among them: measured values and predictions.
pub fn chart(calibration: &Calibration) -> Chart {
    predictive::chart(calibration).into()
}

/// The figures of the sample, if there is one.
pub fn sample_figures(calibration: &Calibration) -> Vec<Figure> {
    let Some(sample) = &calibration.sample else {
        return Vec::new();
    };
    let columns = columns(calibration);
    vec![
        trace::figure(sample, &columns),
        corner::figure(sample, &columns),
    ]
}

/// A parameter of the sample, or the scatter.
struct Column {
    /// Its place in a state.
    index: usize,
    /// Name without the tables that it stands in, with its unit.
    label: String,
    /// The best value.
    best: f64,
    /// Whether the state holds the logarithm.
    logarithm: bool,
}

impl Column {
    fn value(&self, stored: f64) -> f64 {
        match self.logarithm {
            true => 100.0 * stored.exp(),
            false => stored,
        }
    }
}

fn columns(calibration: &Calibration) -> Vec<Column> {
    let parameters = &calibration.parameters;
    let mut columns: Vec<Column> = parameters
        .iter()
        .enumerate()
        .map(|(index, parameter)| Column {
            index,
            label: label(parameter),
            best: parameter.best,
            logarithm: false,
        })
        .collect();
    if calibration.scatter.estimated {
        columns.push(Column {
            index: parameters.len(),
            label: "scatter [%]".to_owned(),
            best: 100.0 * calibration.scatter.best,
            logarithm: true,
        });
    }
    columns
}

fn label(parameter: &ParameterRecord) -> String {
    let name = parameter.key.rsplit('.').next().unwrap_or(&parameter.key);
    let name = name.replace('_', " ");
    match parameter.unit.as_str() {
        "" => name,
        unit => format!("{name} [{unit}]"),
    }
}
