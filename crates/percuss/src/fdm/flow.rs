//! Return of a trial stress to the yield surface.

use crate::material::{FlowState, PreparedStrength};

/// Excess of stress, as a part of the trial stress, from which one more Newton step is exact to rounding.
const TOLERANCE: f64 = 1e-7;
/// A bracket halved as often as this is a point.
const MOST_ITERATIONS: u32 = 100;

/// What a return to the yield surface gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Return {
    /// Increment of the equivalent plastic strain.
    pub(crate) increment: f64,
    /// Flow stress there, rate effect included [Pa].
    pub(crate) stress: f64,
}

/// Solves `q − M Δ = Y(ε_p + Δ, Δ/Δt)` for Δ, where `q` is the trial equivalent stress and `M` its fall per plastic strain.
///
/// `known` is the slow flow stress at the start, below `q`; `elapsed` the time in which the strain came about [s], `None`
/// leaves the strain rate out. The root is bracketed by 0 and q/M and found by Newton's method from the increment of a
/// material that does not harden; a step that leaves the bracket is replaced by its middle.
pub(crate) fn plastic_return(
    strength: &dyn PreparedStrength,
    start: &FlowState,
    known: f64,
    trial: f64,
    modulus: f64,
    elapsed: Option<f64>,
) -> Return {
    let rate_of_strain = match elapsed {
        Some(time) if time > 0.0 => 1.0 / time,
        _ => 0.0,
    };
    let (mut low, mut high) = (0.0, trial / modulus);
    let mut increment = ((trial - known) / modulus).clamp(0.0, high);
    for _ in 0..MOST_ITERATIONS {
        let flow = strength.flow_stress(&FlowState {
            plastic_strain: start.plastic_strain + increment,
            strain_rate: increment * rate_of_strain,
            ..*start
        });
        let excess = trial - modulus * increment - flow.stress;
        let slope = modulus + flow.strain_slope + flow.rate_slope * rate_of_strain;
        let next = increment + excess / slope;
        if excess.abs() <= TOLERANCE * trial && next >= 0.0 {
            increment = next;
            break;
        }
        if excess > 0.0 {
            low = increment;
        } else {
            high = increment;
        }
        let inside = next > low && next < high;
        increment = if inside { next } else { 0.5 * (low + high) };
    }
    Return {
        increment,
        stress: trial - modulus * increment,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;

    fn material(strength: &str) -> Material {
        toml::from_str(&format!(
            "name = 'a'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\nstrength.{strength}"
        ))
        .unwrap()
    }

    fn start() -> FlowState {
        FlowState {
            plastic_strain: 0.02,
            strain_rate: 0.0,
            temperature: 293.0,
            pressure: 0.0,
        }
    }

    #[test]
    fn the_stress_ends_on_the_yield_surface() {
        for text in [
            "perfectly_plastic = { flow_stress = '400 MPa' }",
            "power_law = { coefficient = '800 MPa', exponent = 0.1 }",
            "johnson_cook = { a = '300 MPa', b = '500 MPa', n = 0.3, c = 0.02, m = 1.0, reference_rate = '1 1/s' }",
        ] {
            let metal = material(text);
            let strength = metal.strength.law().prepare(&metal, 1.0);
            let known = strength.flow_stress(&start()).stress;
            for trial in [0.9e9, 2e9, 20e9] {
                let found = plastic_return(&*strength, &start(), known, trial, 200e9, Some(1e-8));
                let flow = strength.flow_stress(&FlowState {
                    plastic_strain: 0.02 + found.increment,
                    strain_rate: found.increment / 1e-8,
                    ..start()
                });
                assert!(
                    (found.stress / flow.stress - 1.0).abs() < 1e-9,
                    "{text} {trial}"
                );
                assert!((trial - 200e9 * found.increment - found.stress).abs() < 1e-3);
            }
        }
    }
}
