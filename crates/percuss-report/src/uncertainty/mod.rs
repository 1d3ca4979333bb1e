//! Figures and tables of an analysis of uncertainty.

mod bands;
mod figures;
mod files;

use percuss::{Scenario, uncertainty::Uncertainty};

pub use files::write_uncertainty;

use crate::Figure;

/// Draws, of each quantity, `histogram-…`, `tornado-…` and, where there are indices, `indices-…`; and over a range of speeds
/// `bands-…` and, where perforation is decided, `perforation`.
pub fn uncertainty_figures(scenario: &Scenario, found: &Uncertainty) -> Vec<Figure> {
    let mut drawn = Vec::new();
    for quantity in &found.quantities {
        drawn.push(figures::histogram(scenario, found, quantity));
        drawn.push(figures::tornado(scenario, found, quantity));
        drawn.extend(figures::indices(scenario, found, quantity));
        drawn.extend(bands::bands(scenario, found, quantity));
    }
    drawn.extend(bands::perforation(scenario, found));
    drawn
}

/// Name of a quantity in file names: without its unit.
fn stem(quantity: &str) -> String {
    let units = ["_mm", "_m_s", "_us", "_kn", "_g"];
    let bare = units.iter().find_map(|unit| quantity.strip_suffix(unit));
    bare.unwrap_or(quantity).replace('_', "-")
}
