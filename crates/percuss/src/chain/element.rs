//! Constitutive update of one element.

use super::part::Part;
use crate::material::FlowState;

/// Flow stress without rate effect [Pa].
pub(super) fn static_flow_stress(
    part: &Part,
    plastic_strain: f64,
    temperature: f64,
    pressure: f64,
) -> f64 {
    let state = FlowState {
        plastic_strain,
        strain_rate: 0.0,
        temperature,
        pressure,
    };
    part.strength.flow_stress(&state).stress
}

/// Plastic strain of this step that brings a trial stress back to the yield surface.
///
/// Solves `|σ_trial| − E Δ = Y(ε_p + Δ, Δ/Δt, T)` for Δ by Newton's method, held inside a bracket.
pub(super) fn plastic_increment(
    part: &Part,
    trial: f64,
    plastic_strain: f64,
    temperature: f64,
    time_step: f64,
) -> f64 {
    let trial = trial.abs();
    let (mut low, mut high) = (0.0, trial / part.modulus);
    let mut increment = 0.0;
    for _ in 0..100 {
        let rate = if part.rate_effects {
            increment / time_step
        } else {
            0.0
        };
        let flow = part.strength.flow_stress(&FlowState {
            plastic_strain: plastic_strain + increment,
            strain_rate: rate,
            temperature,
            pressure: trial / 3.0,
        });
        let excess = trial - part.modulus * increment - flow.stress;
        if excess.abs() <= 1e-13 * trial {
            return increment;
        }
        if excess > 0.0 {
            low = increment;
        } else {
            high = increment;
        }
        let rate_slope = if part.rate_effects {
            flow.rate_slope / time_step
        } else {
            0.0
        };
        let newton = increment + excess / (part.modulus + flow.strain_slope + rate_slope);
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if next == increment || high - low <= 1e-15 * high {
            return next;
        }
        increment = next;
    }
    increment
}
