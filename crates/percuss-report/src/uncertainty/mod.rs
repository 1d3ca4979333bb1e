//! Figures and tables of an uncertainty analysis.

mod bands;
mod figures;
mod files;

use percuss::{Scenario, uncertainty::Uncertainty};

pub use files::{uncertainty_files, write_uncertainty};

use crate::{Chart, Figure};

/// Draws `axisymmetric-…` where mean and spread are corrected; of each quantity, `histogram-…`, `tornado-…` and, where there are indices, `indices-…`; and over a range of speeds
/// `bands-…` and, where perforation is decided, `perforation`.
pub fn uncertainty_figures(scenario: &Scenario, found: &Uncertainty) -> Vec<Figure> {
    let charts = uncertainty_charts(scenario, found);
    charts.iter().map(Chart::draw).collect()
}

/// The charts that [`uncertainty_figures`] draws.
pub fn uncertainty_charts(scenario: &Scenario, found: &Uncertainty) -> Vec<Chart> {
    let mut charts: Vec<Chart> = Vec::new();
    for quantity in &found.quantities {
        charts.push(figures::histogram(scenario, found, quantity).into());
        charts.push(figures::tornado(scenario, found, quantity).into());
        charts.extend(figures::indices(scenario, quantity).map(Chart::from));
        charts.extend(bands::bands(scenario, found, quantity).map(Chart::from));
    }
    charts.extend(figures::axisymmetric(scenario, found).map(Chart::from));
    charts.extend(bands::perforation(scenario, found).map(Chart::from));
    charts
}

/// Name of a quantity in file names: without its unit.
fn stem(quantity: &str) -> String {
    let units = ["_mm", "_m_s", "_us", "_kn", "_g"];
    let bare = units.iter().find_map(|unit| quantity.strip_suffix(unit));
    bare.unwrap_or(quantity).replace('_', "-")
}
