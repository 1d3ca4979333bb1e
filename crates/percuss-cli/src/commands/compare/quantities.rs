//! Selection of the printed quantities.

use percuss::{compare::Comparison, outcome::BandQuantity};

use crate::terminal::counted;

/// Printed quantities: the main ones, those of a recommended model, those measured at these velocities, and for one velocity the
/// depth besides the residual velocity of a plate.
pub fn quantities(comparison: &Comparison) -> Vec<BandQuantity> {
    let all = BandQuantity::ALL.iter().copied();
    all.filter(|quantity| is_shown(comparison, *quantity))
        .collect()
}

fn is_shown(comparison: &Comparison, quantity: BandQuantity) -> bool {
    let speeds = comparison.velocities();
    let single = speeds.len() == 1;
    let measured_here = speeds
        .iter()
        .any(|&speed| comparison.measured(quantity, speed).is_some());
    let measured = comparison
        .experiments
        .iter()
        .any(|measured| measured.quantity == quantity);
    let beside = single
        && quantity == BandQuantity::DepthOfPenetration
        && comparison
            .quantities
            .contains(&BandQuantity::ResidualVelocity);
    let wanted = comparison.quantities.contains(&quantity)
        || recommended_gives(comparison, quantity)
        || beside
        || (measured && !single);
    measured_here || (wanted && is_given(comparison, quantity))
}

/// Whether any model gives a quantity.
pub fn is_given(comparison: &Comparison, quantity: BandQuantity) -> bool {
    let mut results = comparison.results.iter();
    results.any(|record| record.value(quantity).is_some())
}

fn recommended_gives(comparison: &Comparison, quantity: BandQuantity) -> bool {
    comparison.recommended.iter().enumerate().any(|(i, at)| {
        comparison.at_impact_velocity(i).iter().any(|record| {
            record.value(quantity).is_some()
                && at.models.iter().any(|choice| choice.model == record.model)
        })
    })
}

/// Note with the number of experiments at other velocities; empty when there are none.
pub fn elsewhere(comparison: &Comparison) -> String {
    match comparison.experiments_elsewhere() {
        0 => String::new(),
        1 => "1 experiment at another velocity: `--velocity experiments`\n\n".to_owned(),
        count => format!(
            "{} at other velocities: `--velocity experiments`\n\n",
            counted(count, "experiment")
        ),
    }
}
