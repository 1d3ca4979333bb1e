//! Figures and files of a calibration.

mod corner;
mod curves;
mod files;
mod panel;
mod predictive;
mod trace;

use percuss::calibrate::{Calibration, ParameterRecord};

use crate::{Chart, Figure, names};

pub use files::{tables, write};

/// Figures of a calibration: measured values and curves with predictions, and traces and projections of the sample.
pub fn figures(calibration: &Calibration) -> Vec<Figure> {
    let charts = charts(calibration);
    let mut figures: Vec<Figure> = charts.iter().map(Chart::draw).collect();
    figures.extend(sample_figures(calibration));
    figures
}

/// Charts of measured values and of each measured curve with predictions.
pub fn charts(calibration: &Calibration) -> Vec<Chart> {
    let values = (!calibration.predictions.is_empty()).then(|| predictive::chart(calibration));
    let curves = calibration.curves.iter().enumerate();
    let curves = curves.map(|(index, curve)| curves::chart(calibration, index, curve));
    values.into_iter().chain(curves).map(Chart::from).collect()
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

/// Parameter of the sample, or the scatter.
struct ParameterColumn {
    /// Index in a state.
    index: usize,
    /// Name with unit.
    label: String,
    /// The best value.
    best: f64,
    /// Whether the state holds the logarithm.
    logarithm: bool,
}

impl ParameterColumn {
    fn value(&self, stored: f64) -> f64 {
        match self.logarithm {
            true => 100.0 * stored.exp(),
            false => stored,
        }
    }
}

fn columns(calibration: &Calibration) -> Vec<ParameterColumn> {
    let parameters = &calibration.parameters;
    let mut columns: Vec<ParameterColumn> = parameters
        .iter()
        .enumerate()
        .map(|(index, parameter)| ParameterColumn {
            index,
            label: label(parameter),
            best: parameter.best,
            logarithm: false,
        })
        .collect();
    if calibration.scatter.estimated {
        columns.push(ParameterColumn {
            index: parameters.len(),
            label: "Scatter (%)".to_owned(),
            best: 100.0 * calibration.scatter.best,
            logarithm: true,
        });
    }
    columns
}

fn label(parameter: &ParameterRecord) -> String {
    let name = names::parameter(&parameter.key);
    // The material is the same in all panels, and its id makes the label too long.
    let name = name.split(", ").next().unwrap_or(&name);
    names::with_unit(name, &parameter.unit)
}
